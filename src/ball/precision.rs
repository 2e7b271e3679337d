//! The one loop that raises precision until an answer is good enough.
//!
//! An enclosure shrinks as its precision grows, but nobody knows beforehand how many bits it takes.
//! [`Precisions`] says where to start and where to stop, and [`Precisions::raise`] tries one after the
//! other. Where the cost of an attempt grows at least linearly, all of them together cost less than about three
//! times as much as the last one.

use crate::limits::pause;

/// Ascending precisions, in bits or digits, each twice the one before or half as much again; the last one is the
/// limit.
#[derive(Clone, Copy, Debug)]
pub struct Precisions {
    first: u64,
    limit: u64,
    /// Precision grows by the factor `halves/2`.
    halves: u64,
}

/// The outcome of one precision.
#[derive(PartialEq, Debug)]
pub enum Attempt<T, B = T> {
    /// The answer.
    Done(T),
    /// More bits are needed; this is the best so far.
    NotYet(B),
}

impl Precisions {
    /// From `first` up to and including `limit`; the limit alone where `first` is not below it.
    pub fn doubling(first: u64, limit: u64) -> Precisions {
        Precisions { first: first.min(limit), limit, halves: 4 }
    }

    /// From `first` on, each half as much again as the one before: where an attempt takes much time and memory, one
    /// with far more bits than it needs is the worse waste. The last is the highest that is not above `most`, or
    /// `first` itself.
    pub fn growing_by_half(first: u64, most: u64) -> Precisions {
        assert!(first > 1, "half of one bit is none");
        let all = std::iter::successors(Some(first), |bits| Some(bits * 3 / 2));
        let limit = all.take_while(|bits| *bits <= most).last().unwrap_or(first);
        Precisions { first, limit, halves: 3 }
    }

    /// The lowest.
    pub fn first(self) -> u64 {
        self.first
    }

    /// The precision to try after another one.
    pub fn after(self, bits: u64) -> Option<u64> {
        (bits < self.limit).then(|| (bits.saturating_mul(self.halves) / 2).min(self.limit))
    }

    /// All of them.
    pub fn iter(self) -> impl Iterator<Item = u64> {
        std::iter::successors(Some(self.first), move |bits| self.after(*bits))
    }

    /// Makes attempts with rising precision until one is done, which is returned, or else the last one.
    ///
    /// An error of an attempt ends the loop. Where more bits may help, an attempt returns
    /// [`Attempt::NotYet`] instead, if need be with the error in it.
    pub fn raise<T, B, E>(
        self,
        mut attempt: impl FnMut(u64) -> Result<Attempt<T, B>, E>,
    ) -> Result<Attempt<T, B>, E> {
        let mut bits = self.first;
        loop {
            pause();
            match (attempt(bits)?, self.after(bits)) {
                (Attempt::NotYet(_), Some(more)) => bits = more,
                (last, _) => return Ok(last),
            }
        }
    }
}

impl<T, B> Attempt<T, B> {
    /// The answer, or else the best so far.
    pub fn done(self) -> Result<T, B> {
        match self {
            Attempt::Done(answer) => Ok(answer),
            Attempt::NotYet(best) => Err(best),
        }
    }
}

impl<T> Attempt<T> {
    /// A value that is good enough, or not.
    pub fn of(value: T, is_good: bool) -> Attempt<T> {
        if is_good { Attempt::Done(value) } else { Attempt::NotYet(value) }
    }

    /// The answer or the best so far, whichever there is.
    pub fn best(self) -> T {
        match self {
            Attempt::Done(value) | Attempt::NotYet(value) => value,
        }
    }
}

//! A scene that is followed once for all signals that are seen of it, with more bits where these are asked for.

use crate::ball::{Attempt, Precisions};
use crate::history::engine::Engine;
use crate::history::error::{HistoryError, Outcome};
use crate::history::history::undecided;
use crate::history::memory::Asked;
use crate::history::moment::Moment;
use crate::limits::MAX_HISTORY_BITS;
use crate::network::{Contacts, Network, Observed};
use crate::signal::Scale;
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// The precision in bits that is begun with.
const FIRST_BITS: u64 = 192;

/// Beside a local contact, the precision in bits that is begun with: up to this many digits, and for more.
const FEW_DIGITS: usize = 15;
const LOCAL_BITS: [u64; 2] = [96, 128];

/// Precisions are multiples of so many bits.
const STEP_BITS: u64 = 64;

/// A scene whose contacts open, followed until an instant: once for all signals that are seen of it.
pub(crate) struct Follower<'a> {
    pub network: &'a Network,
    asked: Asked,
    until: Moment,
    pub known: RefCell<Rc<Engine>>,
    /// The scene is not followed to the end of the window with so many bits.
    too_many_bits: Cell<u64>,
    /// Why.
    pub refusal: RefCell<Option<HistoryError>>,
    /// Tells times that rest on no event, to any precision.
    pub scale: Rc<Scale<'a>>,
}

impl<'a> Follower<'a> {
    /// Follows the scene until the end of a window of the user's time, and forgets what is not asked for to see these
    /// observables on it, if only some are. With the number of digits, where that is known, it takes no more bits than it
    /// needs.
    pub fn new(
        network: &'a Network,
        observed: Option<&[&Observed]>,
        [from, to]: [&Rational; 2],
        digits: Option<usize>,
    ) -> Outcome<Rc<Follower<'a>>> {
        let asked = Asked::of(network, observed, from);
        let until = Moment::at(network.scaled_time(to));
        let attempt = |bits| match Follower::follow(network, &asked, &until, bits) {
            Ok(known) => Ok(Attempt::Done(Ok(known))),
            Err(error) => undecided(error),
        };
        let first = match network.local_contact() {
            None => FIRST_BITS,
            Some(_) if digits.is_some_and(|digits| digits <= FEW_DIGITS) => LOCAL_BITS[0],
            Some(_) => LOCAL_BITS[1],
        };
        let known = Precisions::growing_by_half(first, MAX_HISTORY_BITS).raise(attempt)?.best()?;
        let (known, too_many_bits) = (RefCell::new(known), Cell::new(u64::MAX));
        let (scale, refusal) = (Scale::of(network), RefCell::default());
        Ok(Rc::new(Follower { network, asked, until, known, too_many_bits, refusal, scale }))
    }

    fn follow(network: &Network, asked: &Asked, until: &Moment, bits: u64) -> Outcome<Rc<Engine>> {
        let mut engine = Engine::new(network, Contacts::of(network.scene()), bits)?;
        engine.ask_for(network, asked)?;
        engine.follow_asked(network, until, &asked.parted)?;
        Ok(Rc::new(engine))
    }

    /// How many cells of nodes were worked out, and how many are kept with those of waves.
    pub fn cells(&self) -> [usize; 2] {
        let known = self.known.borrow();
        [known.count(), known.kept()]
    }

    /// The highest precision of stretches. Those of a scene with a local contact keep the one that they have first.
    pub fn most_bits(&self, known: &Engine) -> u64 {
        match self.network.local_contact() {
            None => MAX_HISTORY_BITS,
            Some(_) => known.cut.bits,
        }
    }

    /// What is known at a precision; where more is known, that, and less where following with it takes too much.
    pub fn engine(&self, bits: u64) -> Rc<Engine> {
        let known = Rc::clone(&self.known.borrow());
        if known.cut.bits >= bits {
            return known;
        }
        let bits = bits.next_multiple_of(STEP_BITS);
        if bits >= self.too_many_bits.get() {
            return known;
        }
        match Follower::follow(self.network, &self.asked, &self.until, bits) {
            Ok(finer) => {
                *self.known.borrow_mut() = Rc::clone(&finer);
                finer
            }
            Err(error) => {
                self.too_many_bits.set(bits);
                self.refusal.replace(Some(error));
                known
            }
        }
    }
}

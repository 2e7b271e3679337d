//! Names of indeterminates.

use std::fmt;
use std::sync::Arc;

/// The name of an indeterminate: a letter, then letters, digits and `_`; or a square root.
///
/// Symbols with equal names are equal; they are ordered by name, byte by byte.
/// Cloning is O(1).
///
/// A square root ([`Symbol::square_root`]) stands for one number and obeys `x² = n`. Its name,
/// `sqrt(n)`, is none that [`Symbol::new`] accepts.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbol(Arc<str>);

impl Symbol {
    /// The symbol called `name`, or `None` where `name` is no name. O(length).
    pub fn new(name: &str) -> Option<Symbol> {
        let mut characters = name.chars();
        let starts = characters.next().is_some_and(char::is_alphabetic);
        let goes_on = characters.all(|c| c.is_alphanumeric() || c == '_');
        (starts && goes_on).then(|| Symbol(name.into()))
    }

    /// The square root of `n`, where `n` is −1 or a prime below 10¹²; else `None`. The root of a
    /// prime is the positive one, the root of −1 the imaginary unit. O(√n).
    ///
    /// Products of different such roots are linearly independent over the rationals, so that a
    /// polynomial with exponents at most 1 in them is zero only where its coefficients are.
    pub fn square_root(n: i64) -> Option<Symbol> {
        let is_prime = |n: u64| (2..=n.isqrt()).all(|d| !n.is_multiple_of(d));
        let known = n == -1 || (2..1_000_000_000_000).contains(&n) && is_prime(n.unsigned_abs());
        known.then(|| Symbol(format!("sqrt({n})").into()))
    }

    /// The integer whose square root this is; `None` for a symbol that may have any value. O(1).
    pub fn square(&self) -> Option<i64> {
        // No other name ends so: for most symbols one byte settles it.
        self.0.strip_suffix(')')?.strip_prefix("sqrt(")?.parse().ok()
    }

    /// Whether this is a square root. O(1).
    pub(crate) fn is_root(&self) -> bool {
        self.0.ends_with(')')
    }

    /// The name. O(1).
    pub fn name(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

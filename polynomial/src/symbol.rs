//! Names of indeterminates.

use std::fmt;
use std::sync::Arc;

/// The name of an indeterminate: a letter, then letters, digits and `_`.
///
/// Symbols with equal names are equal; they are ordered by name, byte by byte.
/// Cloning is O(1).
///
/// ```
/// use wavestep_polynomial::Symbol;
/// assert!(Symbol::new("mu").unwrap() < Symbol::new("s").unwrap());
/// assert!(Symbol::new("2x").is_none());
/// assert_eq!(Symbol::new("x_1").unwrap().name(), "x_1");
/// ```
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

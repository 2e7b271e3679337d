//! The differences between two locks: which piece or event, which term, old and new.

use crate::lock::{Contents, Lock};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use wavestep_polynomial::Rational;

/// The most terms that are shown of one piece.
const MAX_SHOWN: usize = 10;

/// One difference between a lock and what is derived now.
///
/// It is shown in lines: its subject, and for a piece every term with the locked and the present
/// coefficient.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Difference {
    what: String,
    lines: Vec<String>,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.what)?;
        self.lines.iter().take(MAX_SHOWN).try_for_each(|line| writeln!(f, "  {line}"))?;
        match self.lines.len().saturating_sub(MAX_SHOWN) {
            0 => Ok(()),
            more => writeln!(f, "  … and {more} more terms"),
        }
    }
}

impl Lock {
    /// How `now` differs from this lock, entry by entry. An entry that only one of them has is a
    /// difference as well.
    pub fn differences(&self, now: &Lock) -> Vec<Difference> {
        let mut differences = compared(&self.stated, &now.stated, String::clone, both);
        match (&self.contents, &now.contents) {
            (Contents::Pieces(old), Contents::Pieces(new)) => {
                differences.extend(old.differences(new))
            }
            (Contents::Events(old), Contents::Events(new)) => {
                differences.extend(old.differences(new))
            }
            _ => differences.push(Difference {
                what: "one has pieces, and the other events".to_owned(),
                lines: Vec::new(),
            }),
        }
        let name = |(quantity, time): &(String, Rational)| format!("{quantity}({time})");
        differences.extend(compared(&self.values, &now.values, name, both));
        differences
    }
}

/// Two texts that differ, one below the other.
pub(super) fn both(old: &String, new: &String) -> Vec<String> {
    vec![format!("locked {old}"), format!("now    {new}")]
}

/// The differences between entries of the same key, and the keys that only one side has.
pub(super) fn compared<K: Ord, V: PartialEq>(
    old: &BTreeMap<K, V>,
    new: &BTreeMap<K, V>,
    name: impl Fn(&K) -> String,
    lines: impl Fn(&V, &V) -> Vec<String>,
) -> Vec<Difference> {
    let keys: BTreeSet<&K> = old.keys().chain(new.keys()).collect();
    let difference = |key: &K| {
        let (what, lines) = match (old.get(key), new.get(key)) {
            (Some(old), Some(new)) if old == new => return None,
            (Some(old), Some(new)) => ("differs", lines(old, new)),
            (Some(_), None) => ("is locked, and is not derived now", Vec::new()),
            (None, _) => ("is derived now, and is not locked", Vec::new()),
        };
        Some(Difference { what: format!("{} {what}", name(key)), lines })
    };
    keys.into_iter().filter_map(difference).collect()
}

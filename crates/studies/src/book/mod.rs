//! The numbered equations 6.29 to 6.100 of the source, sections 6.6 to 6.11, as data, each held against
//! what the engine derives from the scene that it is about.
//!
//! The equations stand in `sections/`, one file a section, as they are read from the page and in the
//! language of this library. A section names a scene of bars and elements and says what the source calls
//! the waves in it; from there on the scene is derived by its parts, and nothing of the source's own
//! derivation is used. What stands in no file is the verdict: [`examine`] computes it.

#[doc(hidden)]
pub mod checks;
mod entry;
mod examine;
mod judge;
#[doc(hidden)]
pub mod latex;
mod meaning;
mod refusal;
#[doc(hidden)]
pub mod sequence;
mod show;
mod stage;
mod table;
mod verdict;

use std::sync::LazyLock;

use wavestep::language::closest;

pub use entry::{Content, Entry, Equation, Relation, Section};
pub use examine::{Examination, examine, examine_all};
pub use refusal::Refusal;
pub use stage::Stage;
pub use table::{table, table_json, table_latex, table_markdown};
pub use verdict::{Finding, Ground, Verdict, Witness};

/// The texts of the sections, in the order of the source.
const TEXTS: [&str; 6] = [
    include_str!("sections/6.6.txt"),
    include_str!("sections/6.7.txt"),
    include_str!("sections/6.8.txt"),
    include_str!("sections/6.9.txt"),
    include_str!("sections/6.10.txt"),
    include_str!("sections/6.11.txt"),
];

static SECTIONS: LazyLock<Vec<Section>> = LazyLock::new(|| {
    let read = |text: &&str| Section::read(text).unwrap_or_else(|error| panic!("{error}"));
    TEXTS.iter().map(read).collect()
});

pub fn sections() -> &'static [Section] {
    &SECTIONS
}

#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("there is no equation `{number}`")]
pub struct UnknownNumber {
    pub number: String,
}

/// The place of a number in the source: `6.91a` is 91.
fn place(number: &str) -> Option<u32> {
    let digits = number.trim().strip_prefix("6.")?;
    let digits: String = digits.chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok()
}

impl UnknownNumber {
    /// Which numbers there are, and the nearest one.
    pub fn remedy(&self) -> String {
        let all = || sections().iter().flat_map(|section| &section.entries);
        let plain = |number: &&str| !number.contains('-');
        let numbers: Vec<&str> = all().map(|entry| entry.number.as_str()).collect();
        let near = place(&self.number).filter(|_| plain(&self.number.as_str())).and_then(|own| {
            let plain = numbers.iter().copied().filter(plain);
            plain.min_by_key(|number| place(number).map_or(u32::MAX, |other| other.abs_diff(own)))
        });
        let near = near.or_else(|| closest(self.number.trim(), numbers.iter().copied()));
        let known = "equations 6.29 to 6.100 are known";
        match near {
            Some(near) => format!("{known}; did you mean `{near}`?"),
            None => format!("{known}, as `6.80`, and limits such as `6.7-acceleration`"),
        }
    }
}

pub fn find(number: &str) -> Result<(&'static Section, &'static Entry), UnknownNumber> {
    let wanted = number.trim();
    let all = sections().iter().flat_map(|s| s.entries.iter().map(move |entry| (s, entry)));
    let mut found = all.filter(|(_, entry)| entry.number == wanted);
    found.next().ok_or_else(|| UnknownNumber { number: wanted.to_owned() })
}

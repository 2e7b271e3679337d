//! The equations of the source: each has its verdict, each verdict could have been another one, and what
//! is shown is what a person should read.
//!
//! With `UPDATE_DOCUMENTS=1` the page `docs/equations.md` is written anew; read it before you keep it.

mod parts;
mod perturb;
mod shown;
mod verdicts;

use std::sync::LazyLock;

use wavestep_studies::book::{
    Content, Entry, Equation, Examination, Section, examine_all, sections,
};

/// All equations, examined once.
static ALL: LazyLock<Vec<Examination>> = LazyLock::new(examine_all);

/// One of them.
fn examined(number: &str) -> &'static Examination {
    let found = ALL.iter().find(|found| found.entry.number == number);
    found.unwrap_or_else(|| panic!("there is no {number}"))
}

/// All equations with their sections.
fn entries() -> impl Iterator<Item = (&'static Section, &'static Entry)> {
    sections().iter().flat_map(|section| section.entries.iter().map(move |entry| (section, entry)))
}

/// The equations of an entry that are held against its scene.
fn judged(entry: &Entry) -> &[Equation] {
    match &entry.content {
        Content::Claim(equations) | Content::Readings(equations) => equations,
        _ => &[],
    }
}

//! All examined equations in a table: as text, LaTeX, JSON and Markdown.

use crate::book::entry::Section;
use crate::book::examine::Examination;
use crate::book::latex::escaped;
use crate::book::sections;
use crate::book::verdict::Verdict;
use serde_json::Value;

/// How many equations have each verdict, in words.
fn counted(all: &[Examination]) -> String {
    let count = |kind| all.iter().filter(|found| found.verdict.kind() == kind).count();
    let counts = Verdict::KINDS.iter().enumerate().map(|(kind, (_, name))| (count(kind), name));
    let told = counts.filter(|(count, _)| *count > 0);
    let told: Vec<String> = told.map(|(count, name)| format!("{count} {name}")).collect();
    let s = if all.len() == 1 { "" } else { "s" };
    format!("{} equation{s}: {}", all.len(), told.join(", "))
}

/// The sections of which some equations are examined, with these.
fn by_section(all: &[Examination]) -> impl Iterator<Item = (&Section, Vec<&Examination>)> {
    let of = |section: &'static Section| {
        let own = all.iter().filter(|found| found.section.number == section.number);
        (section, own.collect::<Vec<_>>())
    };
    sections().iter().map(of).filter(|(_, own)| !own.is_empty())
}

/// Number, statement and verdict, a line for each.
pub fn table(all: &[Examination]) -> String {
    let width = all.iter().map(|found| found.entry.number.len()).max().unwrap_or_default();
    let mut out = String::new();
    for (section, rows) in by_section(all) {
        out.push_str(&format!("{}  {}\n", section.number, section.title));
        for found in rows {
            let indent = " ".repeat(width + 4);
            out.push_str(&format!(
                "  {:<width$}  {}\n{indent}{}\n",
                found.entry.number,
                found.entry.states,
                found.summary()
            ));
        }
        out.push('\n');
    }
    out + &counted(all) + "\n"
}

/// Number, statement and verdict as a table of LaTeX.
pub fn table_latex(all: &[Examination]) -> String {
    let row = |found: &Examination| {
        let summary = escaped(&found.summary());
        format!("{} & {} & {summary} \\\\\n", found.entry.number, escaped(&found.entry.states))
    };
    let rows: String = all.iter().map(row).collect();
    format!("\\begin{{tabular}}{{lp{{8cm}}p{{6cm}}}}\n{rows}\\end{{tabular}}\n")
}

/// All that [`Examination::to_json`] says of each.
pub fn table_json(all: &[Examination]) -> Value {
    all.iter().map(Examination::to_json).collect()
}

/// The page `docs/equations.md`: a table for each section, with formulas.
pub fn table_markdown(all: &[Examination]) -> String {
    let mut out = String::from(
        "# The equations of the source\n\n\
         Equations 6.29 to 6.100 of Harrison and Nettleton, *Advanced Engineering Dynamics*, sections 6.6 \
         to 6.11, and the limits that they state in words. Each is held against what is derived from the \
         scene it is about. This page is written by `wavestep book --format markdown`, and a test fails \
         where it is stale; `wavestep book 6.80` shows one equation with its derivation.\n\n\
         *Proved*: equal to the derived form, exactly; about every n where the equation is. *Refuted as \
         read*: the derived form is another, and values of both are certain to differ. *Reading unsure*: \
         the print can be read in more than one way, and the derivation says which it supports. *Checked \
         numerically*: an estimate, with its measured error. *Definition*: nothing is claimed.\n\n",
    );
    out.push_str(&format!("{}.\n", counted(all)));
    for (section, rows) in by_section(all) {
        out.push_str(&format!("\n## {} {}\n\n", section.number, section.title));
        if let Some(scene) = section.scene() {
            out.push_str(&format!(
                "The scene is `{scene}`, with `{}`.\n\n",
                section.dictionary().join("`, `")
            ));
        }
        out.push_str("| number | states | as read | verdict |\n|---|---|---|---|\n");
        for found in rows {
            let entry = found.entry;
            let read: Vec<String> = match &entry.latex {
                Some(latex) => vec![format!("$`{latex}`$")],
                None => found.read().iter().map(|read| format!("`{read}`")).collect(),
            };
            let read = if read.is_empty() { vec!["in words".to_owned()] } else { read };
            let mut verdict = found.verdict_markdown();
            if let Verdict::Refuted(slip) = &found.verdict {
                verdict.push_str(&format!(": derived against read {}; it should be ", slip.1));
                let derived = found.derived.iter().map(|own| format!("`{}`", own.to_line()));
                verdict.push_str(&derived.collect::<Vec<_>>().join(", "));
            }
            out.push_str(&format!(
                "| {} | {} | {} | {verdict} |\n",
                entry.number,
                entry.states,
                read.join(if matches!(found.verdict, Verdict::Unsure(_)) { " or " } else { ", " })
            ));
        }
    }
    out
}

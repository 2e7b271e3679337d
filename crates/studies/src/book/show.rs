//! One examined equation for reading: as text, LaTeX and JSON.

use crate::book::entry::{Content, Entry, Equation};
use crate::book::examine::Examination;
use crate::book::latex::{escaped, of_equation};
use crate::book::verdict::{Finding, Verdict};
use serde_json::{Value, json};
use wavestep::export::{self, Formula, LATEX_WIDTH, capitalised, wrapped};

/// The equations that are read, whatever is done with them.
fn equations(entry: &Entry) -> &[Equation] {
    match &entry.content {
        Content::Claim(equations) | Content::Readings(equations) => equations,
        Content::Definition(equations) => equations,
        Content::Check(_) => &[],
    }
}

/// The heading for what no formula states.
const IN_WORDS: &str = "Stated in words";

fn heading(entry: &Entry) -> &'static str {
    match (&entry.content, &entry.latex) {
        (Content::Check(_), None) => IN_WORDS,
        (Content::Readings(readings), _) if readings.len() > 1 => "As it may be read",
        (Content::Claim(_), Some(_)) => "As read, and what of it is compared",
        _ => "As read",
    }
}

/// A step as a sentence, unless it begins with a formula.
fn told(step: &str) -> String {
    match step.split(' ').next() {
        Some(word)
            if word.trim_end_matches(':').chars().all(char::is_alphabetic) && word.len() > 1 =>
        {
            capitalised(step)
        }
        _ => step.to_owned(),
    }
}

fn indented(text: &str) -> String {
    text.lines().map(|line| format!("    {line}\n")).collect()
}

/// The reading that the derivation supports.
fn supported(readings: &[(Equation, Finding)]) -> Option<&Equation> {
    readings.iter().find(|(_, finding)| finding.holds()).map(|(reading, _)| reading)
}

impl Examination {
    /// The verdict in a line: with the value that was found wrong, or the reading that is supported.
    pub fn summary(&self) -> String {
        match &self.verdict {
            Verdict::Unsure(readings) => {
                let supported = supported(readings).map(|one| format!(": {one} is supported"));
                format!("{}{}", self.verdict, supported.unwrap_or_default())
            }
            Verdict::Refuted(slip) => {
                format!("{}: derived against read {}", self.verdict, slip.1)
            }
            verdict => verdict.to_string(),
        }
    }

    pub(super) fn read(&self) -> Vec<String> {
        equations(self.entry).iter().map(ToString::to_string).collect()
    }

    /// The verdict for a cell of a table.
    pub(super) fn verdict_markdown(&self) -> String {
        match &self.verdict {
            Verdict::Refuted(_) => "**refuted as read**".to_owned(),
            Verdict::Unsure(readings) => {
                let supported = supported(readings).map(|one| format!("; `{one}` is supported"));
                let why = self.entry.unsure.as_ref().map(|why| format!(" ({why})"));
                let [why, supported] = [why, supported].map(Option::unwrap_or_default);
                format!("reading unsure{why}{supported}")
            }
            verdict => verdict.to_string(),
        }
    }

    /// For reading in a terminal: as read, derived, verdict with its steps.
    pub fn to_text(&self, width: usize) -> String {
        let Examination { section, entry, derived, .. } = self;
        let mut out = wrapped(&format!("{}  {}", entry.number, entry.states), width, "");
        out.push_str(&format!("Section {}, {}\n\n", section.number, section.title));
        out.push_str(&format!("{}\n", heading(entry)));
        if let Some(latex) = &entry.latex {
            out.push_str(&wrapped(latex, width, "    "));
        }
        for equation in equations(entry) {
            out.push_str(&wrapped(&equation.to_string(), width, "    "));
        }
        if let Some(why) = &entry.unsure {
            out.push_str(&wrapped(&format!("The reading is not sure: {why}."), width, "    "));
        }
        if !derived.is_empty() {
            let heading = self.derived_heading(|scene| format!("`{scene}`"));
            out.push_str(&format!("\n{heading}\n"));
            out.push_str(&indented(&export::text(derived, width.saturating_sub(4))));
        }
        let dictionary = section.dictionary_of(equations(entry));
        if !dictionary.is_empty() {
            let names: Vec<String> =
                dictionary.iter().map(|line| line.replacen(" = ", " is ", 1)).collect();
            let here = format!("In the scene the source's {}.", names.join(", its "));
            out.push_str(&wrapped(&here, width, "    "));
        }
        out.push('\n');
        out.push_str(&wrapped(&format!("Verdict: {}", self.verdict), width, ""));
        for step in &self.steps {
            let stop =
                if step.ends_with(['.', ':', ')']) || step.contains(" = ") { "" } else { "." };
            out.push_str(&wrapped(&format!("{}{stop}", told(step)), width, "    "));
        }
        if let Some(note) = &entry.note {
            out.push('\n');
            out.push_str(&wrapped(note, width, ""));
        }
        out
    }

    /// Names the scene that was derived; a check of its own needs none.
    fn derived_heading(&self, quoted: impl Fn(&str) -> String) -> String {
        match (&self.entry.content, self.section.scene()) {
            (Content::Check(_), _) | (_, None) => "Derived".to_owned(),
            (_, Some(scene)) => format!("Derived from the parts of the scene {}", quoted(scene)),
        }
    }

    /// For a page of LaTeX with amsmath.
    pub fn to_latex(&self) -> String {
        let Examination { section, entry, derived, .. } = self;
        let mut out = format!(
            "\\paragraph{{{}}} {} (Section {}, {}.)\n\n{}{}\n",
            entry.number,
            escaped(&entry.states),
            section.number,
            escaped(&section.title),
            heading(entry),
            if heading(entry) == IN_WORDS { "." } else { ":" },
        );
        let mut rows: Vec<String> = entry.latex.iter().cloned().collect();
        rows.extend(equations(entry).iter().map(of_equation));
        for row in rows {
            out.push_str(&format!("\\[ {row} \\]\n"));
        }
        if let Some(why) = &entry.unsure {
            out.push_str(&format!("The reading is not sure: {}.\n", escaped(why)));
        }
        if !derived.is_empty() {
            let heading = self.derived_heading(|scene| format!("\\texttt{{{scene}}}"));
            out.push_str(&format!("\n{heading}:\n{}", export::latex(derived, LATEX_WIDTH)));
        }
        let dictionary = section.dictionary_of(equations(entry));
        if !dictionary.is_empty() {
            let rows = dictionary.iter().filter_map(|line| Equation::read(line).ok());
            let rows: Vec<String> = rows.map(|row| of_equation(&row)).collect();
            out.push_str(&format!(
                "Names of the source on the left, of the scene on the right:\n\\[ {} \\]\n",
                rows.join(", \\quad ")
            ));
        }
        out.push_str(&format!("\n\\emph{{Verdict: {}.}}\n", escaped(&self.verdict.to_string())));
        for step in &self.steps {
            let stop = if step.ends_with(['.', ':']) { "" } else { "." };
            out.push_str(&format!("{}{stop}\n", escaped(&told(step))));
        }
        if let Some(note) = &entry.note {
            out.push_str(&format!("\n{}\n", escaped(note)));
        }
        out
    }

    pub fn to_json(&self) -> Value {
        let Examination { section, entry, derived, .. } = self;
        let read: Vec<Value> = equations(entry)
            .iter()
            .map(|equation| json!({"text": equation.to_string(), "latex": of_equation(equation)}))
            .collect();
        let formula = |formula: &Formula| {
            let latex = export::latex(std::slice::from_ref(formula), LATEX_WIDTH);
            json!({"text": formula.to_line(), "latex": latex})
        };
        let mut document = json!({
            "number": entry.number,
            "section": section.number,
            "states": entry.states,
            "reading": if entry.unsure.is_some() { "unsure" } else { "clear" },
            "read": read,
            "verdict": Verdict::KINDS[self.verdict.kind()].0,
            "derived": derived.iter().map(formula).collect::<Vec<_>>(),
            "steps": self.steps,
        });
        for (name, text) in
            [("latex", &entry.latex), ("unsure", &entry.unsure), ("note", &entry.note)]
        {
            if let Some(text) = text {
                document[name] = json!(text);
            }
        }
        match &self.verdict {
            Verdict::Refuted(slip) => {
                let (equation, witness) = (slip.0.to_string(), slip.1.to_string());
                document["refuted"] = json!({"equation": equation, "witness": witness});
            }
            Verdict::Unsure(readings) => {
                let supported = |(reading, finding): &(Equation, Finding)| json!({"reading": reading.to_string(), "supported": finding.holds()});
                document["readings"] = readings.iter().map(supported).collect();
            }
            Verdict::Checked(bound) => document["bound"] = json!(bound),
            Verdict::Proved(_) | Verdict::Definition => {}
        }
        document
    }
}

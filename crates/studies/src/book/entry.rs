//! Numbered equations as data: what is read, how surely, and what it is about.

use crate::book::refusal::Refusal;
use std::fmt;
use wavestep::language::syntax::Expression as Tree;
use wavestep::language::{Source, normalise_name, parse_expression};
use wavestep_polynomial::Rational;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Relation {
    /// Both sides are equal, on every period that they name.
    Equals,
    /// The left side is continuous from period to period, and starts at the right side.
    Starts,
}

/// An equation of the source, as trees of the language.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Equation {
    pub left: Tree,
    pub right: Tree,
    pub relation: Relation,
    /// The symbol that has a value, where the equation holds only then.
    pub condition: Option<(String, Tree)>,
}

fn tree(text: &str) -> Result<Tree, Refusal> {
    Ok(parse_expression(&Source::new("formula", text)?)?)
}

/// The parts of a text before and after a mark.
fn split<'a>(text: &'a str, mark: &str) -> Result<(&'a str, &'a str), Refusal> {
    let lacks = || Refusal::NoMark { text: text.to_owned(), mark: mark.trim().to_owned() };
    text.split_once(mark).map(|(left, right)| (left.trim(), right.trim())).ok_or_else(lacks)
}

impl Equation {
    /// Reads `left = right`, `left = right when name = value`, or `form starts at value`.
    pub fn read(text: &str) -> Result<Equation, Refusal> {
        if let Ok((form, start)) = split(text, " starts at ") {
            let (left, right) = (tree(form)?, tree(start)?);
            return Ok(Equation { left, right, relation: Relation::Starts, condition: None });
        }
        let (text, condition) = match split(text, " when ") {
            Err(_) => (text, None),
            Ok((text, condition)) => {
                let (name, value) = split(condition, "=")?;
                (text, Some((normalise_name(name), tree(value)?)))
            }
        };
        let (left, right) = split(text, "=")?;
        let (left, right) = (tree(left)?, tree(right)?);
        Ok(Equation { left, right, relation: Relation::Equals, condition })
    }
}

impl fmt::Display for Equation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.relation {
            Relation::Equals => write!(f, "{} = {}", self.left, self.right)?,
            Relation::Starts => write!(f, "{} starts at {}", self.left, self.right)?,
        }
        match &self.condition {
            Some((name, value)) => write!(f, " when {name} = {value}"),
            None => Ok(()),
        }
    }
}

/// What is to be done with an equation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Content {
    /// Equations that the source derives.
    Claim(Vec<Equation>),
    /// Different readings of one equation, of which the derivation supports one at most.
    Readings(Vec<Equation>),
    /// Names that are introduced, where the language has a formula for them.
    Definition(Vec<Equation>),
    /// What has a check of its own, by its name.
    Check(String),
}

impl Default for Content {
    fn default() -> Content {
        Content::Claim(Vec::new())
    }
}

/// A numbered equation of the source, or a limit that it states in words.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Entry {
    /// Its number, or that of its section with a word: `6.7-acceleration`.
    pub number: String,
    pub states: String,
    pub content: Content,
    /// Why the reading is not sure, where it is not.
    pub unsure: Option<String>,
    /// How it looks on the page, where the language has no way to say it.
    pub latex: Option<String>,
    pub note: Option<String>,
}

/// The scene of a section and the source's names for what is in it, not yet derived.
#[derive(Clone, Debug, Default)]
pub(super) struct Setting {
    pub(super) scene: String,
    pub(super) observed: Vec<String>,
    pub(super) like: Option<(String, Vec<(String, String)>)>,
    pub(super) quantities: Vec<(String, Tree, Option<Tree>)>,
    pub(super) definitions: Vec<(String, Tree)>,
    pub(super) values: Vec<(String, Rational)>,
}

#[derive(Clone, Debug, Default)]
pub struct Section {
    pub number: String,
    pub title: String,
    pub entries: Vec<Entry>,
    pub(super) setting: Setting,
}

impl Section {
    /// The name of the scene, where there is one.
    pub fn scene(&self) -> Option<&str> {
        Some(self.setting.scene.as_str()).filter(|scene| !scene.is_empty())
    }

    /// How the source's names are tied to the scene, as lines of text.
    pub fn dictionary(&self) -> Vec<String> {
        let quantities = self.setting.quantities.iter().map(|(name, tree, _)| (name, tree));
        let definitions = self.setting.definitions.iter().map(|(name, tree)| (name, tree));
        quantities.chain(definitions).map(|(name, tree)| format!("{name} = {tree}")).collect()
    }

    /// The lines of the [`dictionary`](Section::dictionary) that an equation makes use of, itself or by
    /// other lines.
    pub fn dictionary_of(&self, equations: &[Equation]) -> Vec<String> {
        let sides = equations.iter().flat_map(|equation| [&equation.left, &equation.right]);
        let mut words: Vec<String> = sides.flat_map(|side| names(&side.to_string())).collect();
        let definitions = &self.setting.definitions;
        for (name, tree) in definitions.iter().rev().chain(definitions) {
            if words.contains(name) {
                words.extend(names(&tree.to_string()));
            }
        }
        let used = |line: &String| words.iter().any(|word| line.starts_with(&format!("{word} = ")));
        self.dictionary().into_iter().filter(used).collect()
    }

    /// Reads a section; the first line that is not of the form of `sections/` is refused.
    pub fn read(text: &str) -> Result<Section, Refusal> {
        let mut section = Section::default();
        for line in logical_lines(text) {
            match line.strip_prefix("  ") {
                Some(item) => {
                    let entry = section.entries.last_mut();
                    let stray = || Refusal::StrayItem(item.to_owned());
                    entry.ok_or_else(stray)?.read_item(item)?;
                }
                None if line.starts_with(|c: char| c.is_ascii_digit()) => {
                    let (number, states) = split(&line, " ")?;
                    let (number, states) = (number.to_owned(), states.to_owned());
                    section.entries.push(Entry { number, states, ..Entry::default() });
                }
                None => section.read_setting(&line)?,
            }
        }
        Ok(section)
    }

    fn read_setting(&mut self, line: &str) -> Result<(), Refusal> {
        let (word, rest) = split(line, " ")?;
        let setting = &mut self.setting;
        match word {
            "section" => {
                let (number, title) = split(rest, " ")?;
                (self.number, self.title) = (number.to_owned(), title.to_owned());
            }
            "scene" => setting.scene = rest.to_owned(),
            "observe" => setting.observed = listed(rest).map(str::to_owned).collect(),
            "like" => {
                let (like, waves) = split(rest, ":")?;
                let pair = |text| split(text, "=").map(|(a, b)| (a.to_owned(), b.to_owned()));
                let waves = listed(waves).map(pair).collect::<Result<_, _>>()?;
                setting.like = Some((like.to_owned(), waves));
            }
            "wave" => {
                let (name, value) = split(rest, "=")?;
                let (value, rate) = match split(value, " prime ") {
                    Ok((value, rate)) => (value, Some(tree(rate)?)),
                    Err(_) => (value, None),
                };
                setting.quantities.push((name.to_owned(), tree(value)?, rate));
            }
            "let" => {
                let (name, value) = split(rest, "=")?;
                setting.definitions.push((normalise_name(name), tree(value)?));
            }
            "values" => {
                for value in listed(rest) {
                    let (name, value) = split(value, "=")?;
                    let value = wavestep::language::parse_number(value)?;
                    setting.values.push((normalise_name(name), value));
                }
            }
            _ => return Err(Refusal::UnknownLine(word.to_owned())),
        }
        Ok(())
    }
}

impl Entry {
    fn read_item(&mut self, item: &str) -> Result<(), Refusal> {
        let (word, rest) = item.split_once(' ').unwrap_or((item, ""));
        let rest = rest.trim();
        match (word, &mut self.content) {
            ("reads", Content::Claim(equations)) => equations.push(Equation::read(rest)?),
            ("either", content) => *content = Content::Readings(vec![Equation::read(rest)?]),
            ("or", Content::Readings(readings)) => readings.push(Equation::read(rest)?),
            ("defines", content @ Content::Claim(_)) => {
                *content = Content::Definition(Vec::new());
                return if rest.is_empty() { Ok(()) } else { self.read_item(item) };
            }
            ("defines", Content::Definition(equations)) => equations.push(Equation::read(rest)?),
            ("check", content) => *content = Content::Check(rest.to_owned()),
            ("unsure", _) => self.unsure = Some(rest.to_owned()),
            ("latex", _) => self.latex = Some(rest.to_owned()),
            ("note", _) => self.note = Some(rest.to_owned()),
            _ => return Err(Refusal::UnknownItem(word.to_owned())),
        }
        Ok(())
    }
}

/// The names in a formula; `f_2` may be a name, or the wave f on period 2.
fn names(text: &str) -> Vec<String> {
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    let wave = |word: &str| {
        let (wave, n) = word.rsplit_once('_')?;
        n.chars().all(|c| c.is_ascii_digit()).then(|| wave.to_owned())
    };
    words.flat_map(|word| std::iter::once(word.to_owned()).chain(wave(word))).collect()
}

fn listed(text: &str) -> impl Iterator<Item = &str> {
    text.split(',').map(str::trim)
}

/// Lines with what goes on in deeper lines joined to them, without comments and empty lines.
fn logical_lines(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for line in text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#')) {
        match (line.starts_with("    "), lines.last_mut()) {
            (true, Some(last)) => {
                last.push(' ');
                last.push_str(line.trim());
            }
            _ => lines.push(line.trim_end().to_owned()),
        }
    }
    lines
}

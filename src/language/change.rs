//! Changes of a scene that leave something out, made in its text: what the author wrote stays, with its units.

use super::diagnostic::Diagnostic;
use super::name::normalise;
use super::syntax::{
    Declaration, Declared, Line, ObservedTerm, Property, Scene, SceneStatementKind, Section, Span,
};
use super::{Source, parse_scene};
use crate::scene::{End, Joint, Measure};
use std::fmt;
use std::str::FromStr;

/// What gives a bar a finite length.
const LENGTHS: [&str; 2] = ["length", "travel"];

/// The side of a bar on which it goes on for ever.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Beyond {
    Left,
    Right,
}

/// Something that is left out of a scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Change {
    /// An element: what stands beside it is joined.
    Without(String),
    /// That a bar yields; of all bars of finite length where none is named.
    Rigid(Option<String>),
    /// The waves in a bar: it becomes a spring with a share of its mass, the usual one where none is given. In all bars
    /// of finite length where none is named.
    Spring(Option<String>, Option<String>),
    /// What lies beyond a bar, which goes on for ever instead.
    Endless(String, Beyond),
    /// That contacts open.
    Closed,
}

/// Why a scene is not changed.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum ChangeError {
    #[error("`{0}` is not a simplification of a scene")]
    Unknown(String),
    #[error("`{0}` leaves nothing: the number must be 1 or larger")]
    Nothing(String),
    #[error("there is no element `{name}` in this scene")]
    NoElement { name: String, elements: Vec<String> },
    #[error("`{0}` is not a bar")]
    NotABar(String),
    #[error("the bar `{0}` is already rigid or a spring")]
    Ideal(String),
    #[error("there is no bar in this scene")]
    NoBar,
    #[error("there is no bar of finite length in this scene")]
    NoFiniteBar,
    #[error("the bar `{0}` is already endless")]
    Endless(String),
    #[error("contacts stay closed in this scene")]
    NoContacts,
    #[error("`{change}` does not suit this scene: {why}")]
    Refused { change: String, why: String },
    #[error(transparent)]
    Text(#[from] Diagnostic),
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Change::Without(name) => write!(f, "without:{name}"),
            Change::Rigid(None) => f.write_str("rigid"),
            Change::Rigid(Some(name)) => write!(f, "rigid:{name}"),
            Change::Spring(None, _) => f.write_str("third"),
            Change::Spring(Some(name), None) => write!(f, "spring:{name}"),
            Change::Spring(Some(name), Some(share)) => write!(f, "spring:{name},{share}"),
            Change::Endless(name, Beyond::Left) => write!(f, "endless:{name}.left"),
            Change::Endless(name, Beyond::Right) => write!(f, "endless:{name}.right"),
            Change::Closed => f.write_str("closed"),
        }
    }
}

impl FromStr for Change {
    type Err = ChangeError;

    fn from_str(text: &str) -> Result<Change, ChangeError> {
        let unknown = || ChangeError::Unknown(text.to_owned());
        let (word, of) = text.split_once(':').map_or((text, None), |(word, of)| (word, Some(of)));
        let name = || of.filter(|name| !name.is_empty()).map(normalise).ok_or_else(unknown);
        Ok(match (word, of) {
            ("rigid", None) => Change::Rigid(None),
            ("third", None) => Change::Spring(None, None),
            ("closed", None) => Change::Closed,
            ("rigid", _) => Change::Rigid(Some(name()?)),
            ("without", _) => Change::Without(name()?),
            ("spring", Some(of)) => match of.split_once(',') {
                Some((name, share)) if !name.is_empty() => {
                    Change::Spring(Some(normalise(name)), Some(share.to_owned()))
                }
                Some(_) => return Err(unknown()),
                None => Change::Spring(Some(name()?), None),
            },
            ("endless", Some(of)) => match of.rsplit_once('.') {
                Some(("", _)) => return Err(unknown()),
                Some((name, "left")) => Change::Endless(normalise(name), Beyond::Left),
                Some((name, "right")) => Change::Endless(normalise(name), Beyond::Right),
                _ => return Err(unknown()),
            },
            _ => return Err(unknown()),
        })
    }
}

/// The text of a scene after these changes, one after the other.
///
/// # Errors
/// A text that is no scene; elements that are not there, or that a change does not suit. Whether the new scene makes
/// sense is told when it is read.
pub fn changed(source: &Source, changes: &[Change]) -> Result<Source, ChangeError> {
    let mut source = source.clone();
    for change in changes {
        let tree = parse_scene(&source)?;
        let mut edits = Edits { tree: &tree, all: Vec::new() };
        edits.make(change)?;
        source = Source::new(source.name(), edits.applied())?;
    }
    Ok(source)
}

/// The names of the elements of a scene in the order of its line, each with what it is.
pub fn elements(source: &Source) -> Result<Vec<(String, Declared)>, Diagnostic> {
    let tree = parse_scene(source)?;
    let edits = Edits { tree: &tree, all: Vec::new() };
    let names = edits.tree.line().map_or(&[][..], |(line, _)| &line.elements);
    let kind = |name: &str| Some((name.to_owned(), edits.declaration(name).ok()?.0.kind));
    Ok(names.iter().filter_map(|name| kind(&name.value)).collect())
}

/// Places of a text with what is put there.
struct Edits<'a> {
    tree: &'a Scene,
    all: Vec<(Span, String)>,
}

impl<'a> Edits<'a> {
    fn make(&mut self, change: &Change) -> Result<(), ChangeError> {
        match change {
            Change::Without(name) => {
                let (_, span) = self.declaration(name)?;
                self.remove(span);
                self.rewrite_line(|line| leave_out(line, name));
                self.remove_observables(|term| term.place.value.element.value == *name);
            }
            Change::Rigid(name) => {
                let bars = self.idealise(name.as_deref(), "rigid")?;
                self.remove_observables(|term| {
                    let is_force = matches!(
                        term.measure.value,
                        Measure::Force | Measure::Strain | Measure::Stress | Measure::Work
                    );
                    is_force && bars.contains(&&*term.place.value.element.value)
                });
            }
            Change::Spring(name, share) => {
                let share = share.as_ref().map(|share| format!(", share = {share}"));
                let spring = format!("spring{}", share.unwrap_or_default());
                let bars = self.idealise(name.as_deref(), &spring)?;
                self.remove_observables(|term| {
                    let is_bar = bars.contains(&&*term.place.value.element.value);
                    term.measure.value == Measure::Work && is_bar
                });
            }
            Change::Endless(name, beyond) => self.cut(name, *beyond)?,
            Change::Closed => {
                let open = |kind: &SceneStatementKind| *kind == SceneStatementKind::ContactsOpen;
                let statements = self.tree.statements.iter();
                let spans = statements.filter(|own| open(&own.value)).map(|own| own.span);
                let spans: Vec<Span> = spans.collect();
                let touches = |(line, _): (&Line, Span)| {
                    line.joints.iter().any(|own| own.value == Joint::Contact)
                };
                if spans.is_empty() || !self.tree.line().is_some_and(touches) {
                    return Err(ChangeError::NoContacts);
                }
                spans.into_iter().for_each(|span| self.remove(span));
            }
        }
        Ok(())
    }

    fn declaration(&self, name: &str) -> Result<(&'a Declaration, Span), ChangeError> {
        let is_named = |own: &Declaration| own.name.value == name && own.kind != Declared::Material;
        let found = self.tree.declarations().find(|(own, _)| is_named(own));
        found.ok_or_else(|| self.no_element(name))
    }

    fn no_element(&self, name: &str) -> ChangeError {
        let elements = self.tree.line().map_or(&[][..], |(line, _)| &line.elements);
        let elements = elements.iter().map(|own| own.value.clone()).collect();
        ChangeError::NoElement { name: name.to_owned(), elements }
    }

    fn bar(&self, name: &str) -> Result<&'a Declaration, ChangeError> {
        let (bar, _) = self.declaration(name)?;
        match bar.kind {
            Declared::Bar => Ok(bar),
            _ => Err(ChangeError::NotABar(name.to_owned())),
        }
    }

    /// The bars of finite length that are neither rigid nor springs; all of finite length where none is left.
    fn bars_with_waves(&self) -> Result<Vec<&'a Declaration>, ChangeError> {
        let elements = self.tree.declarations().map(|(own, _)| own);
        let bars: Vec<&Declaration> = elements.filter(|own| own.kind == Declared::Bar).collect();
        let finite = bars.iter().copied().filter(|bar| has_property(bar, &LENGTHS));
        let finite: Vec<&Declaration> = finite.collect();
        let left = finite.iter().copied().filter(|bar| !has_property(bar, &["as"]));
        let left: Vec<&Declaration> = left.collect();
        match (bars.is_empty(), finite.is_empty(), left.is_empty()) {
            (true, ..) => Err(ChangeError::NoBar),
            (_, true, _) => Err(ChangeError::NoFiniteBar),
            (.., true) => Ok(finite),
            _ => Ok(left),
        }
    }

    /// Gives a bar, or each bar of finite length, the property `as`; the names of these bars.
    fn idealise(&mut self, name: Option<&str>, ideal: &str) -> Result<Vec<&'a str>, ChangeError> {
        let bars: Vec<&Declaration> = match name {
            Some(name) => vec![self.bar(name)?],
            None => self.bars_with_waves()?,
        };
        if let Some(bar) = bars.iter().find(|bar| has_property(bar, &["as"])) {
            return Err(ChangeError::Ideal(bar.name.value.clone()));
        }
        for bar in &bars {
            let Some(last) = bar.properties.last() else { continue };
            let end = last.unit.as_ref().map_or(last.value.span.end, |unit| unit.span.end);
            self.all.push((Span::new(end, end), format!(", as = {ideal}")));
        }
        Ok(bars.into_iter().map(|bar| &*bar.name.value).collect())
    }

    /// Lets a bar go on for ever on one side, and leaves out what lies beyond.
    fn cut(&mut self, name: &str, beyond: Beyond) -> Result<(), ChangeError> {
        let bar = self.bar(name)?;
        let Some((line, _)) = self.tree.line() else { return Ok(()) };
        let place = line.elements.iter().position(|own| own.value == name);
        let place = place.ok_or_else(|| self.no_element(name))?;
        let gone = match beyond {
            Beyond::Left => &line.elements[..place],
            Beyond::Right => &line.elements[place + 1..],
        };
        let gone: Vec<String> = gone.iter().map(|own| own.value.clone()).collect();
        for name in &gone {
            let (_, span) = self.declaration(name)?;
            self.remove(span);
        }
        let end = if beyond == Beyond::Left { line.left.value } else { line.right.value };
        if gone.is_empty() && end == End::Endless {
            return Err(ChangeError::Endless(name.to_owned()));
        }
        let is_length = |own: &Property| LENGTHS.contains(&&*own.name.value);
        if let Some(at) = bar.properties.iter().position(is_length) {
            let own = &bar.properties[at];
            let end = |at: usize| {
                let own = &bar.properties[at];
                own.unit.as_ref().map_or(own.value.span.end, |unit| unit.span.end)
            };
            // With the comma before it, or the one behind.
            let span = match (at.checked_sub(1), bar.properties.get(at + 1)) {
                (Some(before), _) => Span::new(end(before), end(at)),
                (None, Some(next)) => Span::new(own.name.span.start, next.name.span.start),
                (None, None) => Span::new(own.name.span.start, end(at)),
            };
            self.all.push((span, String::new()));
        }
        self.rewrite_line(|line| match beyond {
            Beyond::Left => {
                line.elements.drain(..place);
                line.joints.drain(..=place);
                line.joints.insert(0, "-");
                line.ends[0] = End::Endless;
            }
            Beyond::Right => {
                line.elements.truncate(place + 1);
                line.joints.truncate(place + 1);
                line.joints.push("-");
                line.ends[1] = End::Endless;
            }
        });
        self.remove_observables(|term| {
            let place = &term.place.value;
            let has_gone = match &place.section {
                Some(Section::Left) => beyond == Beyond::Left,
                Some(Section::Right) => beyond == Beyond::Right,
                // A share of its length.
                Some(Section::At { unit, .. }) => unit.is_none(),
                None => false,
            };
            gone.contains(&place.element.value) || place.element.value == name && has_gone
        });
        Ok(())
    }

    fn rewrite_line(&mut self, change: impl FnOnce(&mut Written<'_>)) {
        let Some((line, span)) = self.tree.line() else { return };
        let mut written = Written {
            ends: [line.left.value, line.right.value],
            elements: line.elements.iter().map(|own| own.value.clone()).collect(),
            joints: line.joints.iter().map(|joint| self.tree.source.slice(joint.span)).collect(),
        };
        change(&mut written);
        self.all.push((span, written.to_string()));
    }

    /// Removes the observables with a term that is not told any more.
    fn remove_observables(&mut self, is_gone: impl Fn(&ObservedTerm) -> bool) {
        let tree = self.tree;
        for statement in &tree.statements {
            let SceneStatementKind::Observe { terms, .. } = &statement.value else { continue };
            if terms.iter().any(|term| is_gone(&term.value)) {
                self.remove(statement.span);
            }
        }
    }

    /// Removes a statement, with its line where nothing but a comment stands beside it.
    fn remove(&mut self, span: Span) {
        let text = self.tree.source.text();
        let start = text[..span.start].rfind('\n').map_or(0, |at| at + 1);
        let end = text[span.end..].find('\n').map_or(text.len(), |at| span.end + at + 1);
        let rest = text[span.end..end].trim_start();
        let is_alone =
            text[start..span.start].trim().is_empty() && (rest.is_empty() || rest.starts_with('#'));
        let span = if is_alone { Span::new(start, end) } else { span };
        self.all.push((span, String::new()));
    }

    fn applied(mut self) -> String {
        self.all.sort_by_key(|(span, _)| *span);
        let mut text = self.tree.source.text().to_owned();
        for (span, new) in self.all.iter().rev() {
            text.replace_range(span.start..span.end, new);
        }
        text
    }
}

fn has_property(bar: &Declaration, names: &[&str]) -> bool {
    bar.properties.iter().any(|own| names.contains(&&*own.name.value))
}

/// A line as it is written anew.
struct Written<'a> {
    ends: [End; 2],
    elements: Vec<String>,
    /// Their signs, of contacts that begin apart with the width.
    joints: Vec<&'a str>,
}

/// Takes an element out of a line. Where it touched a neighbour, what is joined now touches.
fn leave_out(line: &mut Written<'_>, name: &str) {
    let Some(place) = line.elements.iter().position(|own| own == name) else { return };
    line.elements.remove(place);
    let before = line.joints.remove(place);
    if before.starts_with('|') {
        line.joints[place] = before;
    }
    let last = line.elements.len();
    for (side, joint) in [(0, 0), (1, last)] {
        if joint == place && line.ends[side] != End::Fixed {
            line.joints[joint] = "-";
        }
    }
}

impl fmt::Display for Written<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}", self.ends[0].word())?;
        let names = self.elements.iter().map(String::as_str).chain([self.ends[1].word()]);
        for (joint, name) in self.joints.iter().zip(names) {
            write!(f, " {joint} {name}")?;
        }
        Ok(())
    }
}

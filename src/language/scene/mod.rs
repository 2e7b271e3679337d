//! From syntax tree to scene.
//!
//! Mistakes are gathered, not thrown: what depends on a part that is wrong is left out, so that one
//! mistake is reported once.

mod element;
mod hertz;
mod observe;
mod refusal;
pub(super) mod units;
mod value;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use wavestep_polynomial::Rational;

use super::diagnostic::Diagnostic;
use super::parameters;
use super::scope::{Scope, symbol, with_likely};
use super::syntax::{self, Declaration, Declared, Name, SceneStatementKind, Section, Span};
use crate::expression::{Fraction, PI};
use crate::limits::MAX_MISTAKES;
use crate::scene::{self, Dimension, ElementIndex, Kind};
use element::Material;
use value::NEEDS_UNIT;

type Outcome<T> = Result<T, Diagnostic>;

/// The name of time in loads.
const TIME: &str = "t";

/// Names with a meaning of their own in scenes, and what they mean.
const TAKEN: [(&str, &str); 7] = [
    (PI, "is the number π"),
    (TIME, "is the time in loads"),
    ("n", "counts periods"),
    ("line", "is the whole line"),
    ("free", "is an end of the line"),
    ("fixed", "is an end of the line"),
    ("endless", "is an end of the line"),
];

/// Lowers a scene, with `values` in place of symbols from the start.
pub(super) fn scene(
    tree: &syntax::Scene,
    values: &BTreeMap<String, Rational>,
) -> Result<scene::Scene, Vec<Diagnostic>> {
    let mut lowering = Lowering::new(tree, values);
    lowering.parameters();
    lowering.names();
    lowering.properties();
    let line = lowering.line();
    let observables = lowering.observables();
    if !lowering.errors.is_empty() {
        return Err(lowering.into_errors());
    }
    let line = line.expect("a line, or an error");
    let elements = lowering.elements.iter().map(|known| scene::Element {
        name: known.declaration.name.value.clone(),
        kind: known.kind.clone().expect("an element, or an error"),
    });
    let scene = scene::Scene {
        title: tree.title.value.clone(),
        assumptions: lowering.scope.assumptions.clone(),
        dimensional: lowering.unit.is_some(),
        elements: elements.collect(),
        line,
        contacts_open: tree
            .statements
            .iter()
            .any(|statement| statement.value == SceneStatementKind::ContactsOpen),
        observables,
        time: symbol(TIME),
    };
    let faults = scene.faults();
    if faults.is_empty() {
        return Ok(scene.expanded().expect("lengths are positive"));
    }
    let refusals: Vec<Diagnostic> =
        faults.iter().take(MAX_MISTAKES).map(|fault| lowering.refusal(&scene, fault)).collect();
    lowering.errors.extend(refusals);
    Err(lowering.into_errors())
}

/// An element of the text.
struct Known<'a> {
    declaration: &'a Declaration,
    /// What it is; `None` if its properties are wrong.
    kind: Option<Kind>,
}

/// What a name of the text stands for, besides symbols.
#[derive(Clone, Copy)]
enum Meaning {
    Symbol,
    Material,
    Element(ElementIndex),
    Observable,
}

struct Lowering<'a> {
    tree: &'a syntax::Scene,
    values: &'a BTreeMap<String, Rational>,
    /// Symbols, `pi` and the time.
    scope: Scope,
    /// The first unit of the text, which makes the scene dimensional.
    unit: Option<Span>,
    /// Where each name was declared, and as what.
    declared: BTreeMap<String, (Span, Meaning)>,
    /// Materials; `None` if their properties are wrong.
    materials: BTreeMap<String, Option<Material>>,
    elements: Vec<Known<'a>>,
    errors: Vec<Diagnostic>,
}

impl<'a> Lowering<'a> {
    fn new(tree: &'a syntax::Scene, values: &'a BTreeMap<String, Rational>) -> Self {
        let mut scope = Scope::new(&tree.source);
        scope.time = Some(symbol(TIME));
        Lowering {
            tree,
            values,
            scope,
            unit: first_unit(tree),
            declared: BTreeMap::new(),
            materials: BTreeMap::new(),
            elements: Vec::new(),
            errors: Vec::new(),
        }
    }

    fn statements(&self) -> impl Iterator<Item = &'a SceneStatementKind> + use<'a> {
        self.tree.statements.iter().map(|statement| &statement.value)
    }

    fn error(
        &self,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Diagnostic {
        self.scope.error(message, span, label)
    }

    /// Notes what is wrong.
    fn refuse<T>(&mut self, error: Diagnostic) -> Option<T> {
        self.errors.push(error);
        None
    }

    /// Keeps what was found, or what is wrong.
    fn keep<T>(&mut self, outcome: Outcome<T>) -> Option<T> {
        outcome.map_or_else(|error| self.refuse(error), Some)
    }

    /// The errors in the order of the text, each mistake once.
    fn into_errors(mut self) -> Vec<Diagnostic> {
        self.errors.sort_by_key(|error| (error.span().start, error.span().end));
        self.errors.truncate(10 * MAX_MISTAKES);
        let mut kept: Vec<Diagnostic> = Vec::new();
        for error in self.errors {
            let same = kept.iter().position(|first| first.message() == error.message());
            let unit = kept.iter().position(|first| first.message().ends_with(NEEDS_UNIT));
            match (same, unit) {
                // An unknown name is unknown wherever it stands.
                (Some(_), _) if error.message().starts_with("unknown ") => {}
                (Some(first), _) if kept[first].span() == error.span() => {}
                (_, Some(first)) if error.message().ends_with(NEEDS_UNIT) => {
                    let known = kept[first].clone();
                    kept[first] = known.with_secondary(error.span(), "and this");
                }
                _ => kept.push(error),
            }
        }
        kept.truncate(MAX_MISTAKES);
        kept
    }

    /// Whether enough is wrong: one after the other, too many would take too long.
    fn is_hopeless(&self) -> bool {
        self.errors.len() >= MAX_MISTAKES
    }

    fn declare(&mut self, name: &Name, meaning: Meaning) {
        let taken = TAKEN.iter().find(|(taken, _)| *taken == name.value);
        if let Some((taken, why)) = taken {
            let error = self
                .error(format!("`{taken}` {why}"), name.span, "cannot be declared")
                .with_remedy("choose another name");
            self.errors.push(error);
        }
        match self.declared.entry(name.value.clone()) {
            Entry::Vacant(place) => drop(place.insert((name.span, meaning))),
            Entry::Occupied(place) => {
                self.errors.push(self.scope.declared_twice(name, place.get().0));
            }
        }
    }

    /// Symbols, `pi`, and factors that are not zero.
    fn parameters(&mut self) {
        for statement in self.statements() {
            let SceneStatementKind::Symbols(symbols) = statement else { continue };
            for symbol in symbols {
                self.declare(&symbol.name, Meaning::Symbol);
                let outcome = parameters::declare(&mut self.scope, symbol, self.values);
                self.keep(outcome);
            }
        }
        let title = self.tree.title.span;
        let outcome = parameters::all_known(&self.scope, self.values, "scene", title);
        self.keep(outcome);
        self.scope.symbols.insert(PI.to_owned(), None);
        for statement in self.statements() {
            let SceneStatementKind::Nonzero(tree) = statement else { continue };
            let outcome = parameters::nonzero(&self.scope, tree, self.values);
            if let Some(Some(unit)) = self.keep(outcome) {
                self.scope.assumptions.declare_factors(&unit);
            }
        }
    }

    /// Names of materials and elements.
    fn names(&mut self) {
        for statement in self.statements() {
            match statement {
                SceneStatementKind::Declaration(declaration) => {
                    let meaning = match declaration.kind {
                        Declared::Material => Meaning::Material,
                        _ => Meaning::Element(self.elements.len()),
                    };
                    self.declare(&declaration.name, meaning);
                    if declaration.kind != Declared::Material {
                        self.elements.push(Known { declaration, kind: None });
                    }
                }
                SceneStatementKind::Observe { name, .. } => self.declare(name, Meaning::Observable),
                _ => {}
            }
        }
    }

    /// The one line of the scene.
    fn line(&mut self) -> Option<scene::Line> {
        let mut found: Option<(&'a syntax::Line, Span)> = None;
        for statement in &self.tree.statements {
            let SceneStatementKind::Line(line) = &statement.value else { continue };
            match found {
                None => found = Some((line, statement.span)),
                Some((_, first)) => {
                    let error = self
                        .error("a scene has one line", statement.span, "a second line")
                        .with_secondary(first, "the first line")
                        .with_remedy("remove one of the two, or put it in a separate file");
                    self.errors.push(error);
                }
            }
        }
        let Some((line, _)) = found else {
            let error = self
                .error("no line is stated", self.tree.title.span, "of this scene")
                .with_remedy("state how the elements are joined, as in `line free - rod - fixed`");
            return self.refuse(error);
        };
        let mut elements = Vec::new();
        for name in &line.elements {
            if self.is_hopeless() {
                return None;
            }
            let outcome = self.element(name);
            elements.push(self.keep(outcome));
        }
        let gaps = self.gaps(line);
        Some(scene::Line {
            left: line.left.value,
            elements: elements.into_iter().collect::<Option<_>>()?,
            joints: line.joints.iter().map(|joint| joint.value).collect(),
            gaps: gaps?,
            right: line.right.value,
        })
    }

    /// How far apart contacts begin.
    fn gaps(&mut self, line: &syntax::Line) -> Option<BTreeMap<usize, Fraction>> {
        let mut gaps = Some(BTreeMap::new());
        for (joint, width, unit) in &line.gaps {
            let outcome = self.quantity(width, unit.as_ref(), Dimension::LENGTH, "a gap");
            match (self.keep(outcome), &mut gaps) {
                (Some(width), Some(gaps)) => drop(gaps.insert(*joint, width)),
                (None, _) => gaps = None,
                (_, None) => {}
            }
        }
        gaps
    }

    /// The element of a name.
    fn element(&self, name: &Name) -> Outcome<ElementIndex> {
        let found = self.declared.get(&name.value);
        if let Some((_, Meaning::Element(element))) = found {
            return Ok(*element);
        }
        let Some((first, meaning)) = found else {
            let Name { value: name, span } = name;
            let error = self.error(format!("unknown element `{name}`"), *span, "not declared");
            let names = self.elements.iter().map(|known| known.declaration.name.value.as_str());
            let declared = names.clone().collect::<Vec<_>>().join(", ");
            let declaration = format!("`bar {name} {{ impedance = 1, travel = 1 }}`");
            return Err(with_likely(error, name, names).or_remedy(match &declared[..] {
                "" => format!("declare it, as in {declaration}"),
                _ => format!("declared are {declared}; declare another as in {declaration}"),
            }));
        };
        let message = format!("`{}` is {}", name.value, self.described(*meaning));
        Err(self
            .error(message, name.span, "not an element")
            .with_secondary(*first, "declared here")
            .with_remedy("name a bar, a mass, a spring, a local contact, a support or a load"))
    }

    /// What a name stands for, with an article.
    fn described(&self, meaning: Meaning) -> String {
        match meaning {
            Meaning::Symbol => "a symbol".to_owned(),
            Meaning::Material => "a material".to_owned(),
            Meaning::Element(element) => {
                format!("a {}", self.elements[element].declaration.kind.noun())
            }
            Meaning::Observable => "an observable".to_owned(),
        }
    }
}

/// The first unit of a text.
fn first_unit(tree: &syntax::Scene) -> Option<Span> {
    tree.statements.iter().find_map(|statement| match &statement.value {
        SceneStatementKind::Declaration(declaration) => {
            let mut units = declaration.properties.iter().filter_map(|p| p.unit.as_ref());
            units.next().map(|unit| unit.span)
        }
        SceneStatementKind::Observe { terms, .. } => {
            terms.iter().find_map(|term| match &term.value.place.value.section {
                Some(Section::At { unit, .. }) => unit.as_ref().map(|unit| unit.span),
                _ => None,
            })
        }
        SceneStatementKind::Line(line) => {
            let mut units = line.gaps.iter().filter_map(|(_, _, unit)| unit.as_ref());
            units.next().map(|unit| unit.span)
        }
        _ => None,
    })
}

//! What is impossible about a scene, at its places in the text.

use super::Lowering;
use super::element::Least;
use crate::language::diagnostic::Diagnostic;
use crate::language::syntax::{Declaration, Node, ObservedTerm, SceneStatementKind, Span, Spanned};
use crate::scene::{
    Body, Element, ElementIndex, Fault, Kind, Measure, Mistake, Part, Place, Property, Scene,
};

impl Lowering<'_> {
    /// What the scene refuses, with the places of all parts and a remedy.
    pub(super) fn refusal(&self, scene: &Scene, fault: &Fault) -> Diagnostic {
        let spans: Vec<Span> = fault.parts.iter().map(|part| self.span(*part)).collect();
        if let Some(value) = &fault.value {
            let least = match fault.mistake {
                Mistake::Negative => Least::Zero,
                _ => Least::Positive,
            };
            return self.not_positive(fault.to_string(), spans[0], value, least);
        }
        let (message, labels, remedy) = self.explained(scene, fault);
        let mut labels = labels.into_iter();
        let label = labels.next().unwrap_or_default();
        let error = self.error(message, spans[0], label).with_remedy(remedy);
        let others = spans[1..].iter().zip(labels).filter(|(_, label)| !label.is_empty());
        others.fold(error, |error, (span, label)| error.with_secondary(*span, label))
    }

    fn declaration(&self, element: ElementIndex) -> &Declaration {
        self.elements[element].declaration
    }

    fn name_at(&self, part: Part) -> &str {
        match part {
            Part::Element(element) | Part::Property(element, _) => {
                &self.declaration(element).name.value
            }
            Part::Position(position) => {
                self.tree.line().map_or("", |(line, _)| &line.elements[position].value)
            }
            _ => "",
        }
    }

    fn term(&self, observable: usize, term: usize) -> Option<&Spanned<ObservedTerm>> {
        let mut observables =
            self.tree.statements.iter().filter_map(|statement| match &statement.value {
                SceneStatementKind::Observe { terms, .. } => Some(terms),
                _ => None,
            });
        observables.nth(observable)?.get(term)
    }

    fn span(&self, part: Part) -> Span {
        let title = self.tree.title.span;
        let line = self.tree.line();
        match part {
            Part::Element(element) => self.declaration(element).name.span,
            Part::Property(element, property) => self.property(element, property),
            Part::Position(position) => {
                line.map_or(title, |(line, _)| line.elements[position].span)
            }
            Part::Joint(joint) => line.map_or(title, |(line, _)| line.joints[joint].span),
            Part::Left => line.map_or(title, |(line, _)| line.left.span),
            Part::Right => line.map_or(title, |(line, _)| line.right.span),
            Part::Line => line.map_or(title, |(_, span)| span),
            Part::Term { observable, term } => {
                self.term(observable, term).map_or(title, |term| term.span)
            }
        }
    }

    /// The value that a property was read from, perhaps in the material of a bar.
    fn property(&self, element: ElementIndex, property: Property) -> Span {
        let own = self.declaration(element);
        let materials = self.tree.declarations().map(|(material, _)| material);
        let material = own.properties.iter().find(|own| own.name.value == "material");
        let material = material.map(|material| &material.value.value);
        let named = |declaration: &&Declaration| match material {
            Some(Node::Name(name)) => *name == declaration.name.value,
            _ => false,
        };
        let declarations = std::iter::once(own).chain(materials.filter(named));
        let mut given = declarations.flat_map(|declaration| &declaration.properties);
        let (_, names) = property.words();
        given
            .find(|given| names.contains(&given.name.value.as_str()))
            .map_or(own.name.span, |given| given.value.span)
    }

    /// Message, labels of the parts, remedy.
    fn explained(&self, scene: &Scene, fault: &Fault) -> (String, Vec<String>, String) {
        let name_of = |part: usize| fault.parts.get(part).map_or("", |part| self.name_at(*part));
        let (name, second) = (name_of(0), name_of(1));
        let noun = || match fault.parts.first() {
            Some(Part::Position(position)) => {
                self.declaration(scene.line.elements[*position]).kind.noun()
            }
            _ => "spring",
        };
        let (message, labels, remedy): (_, &[&str], _) = match fault.mistake {
            Mistake::NotMeasurable => return self.not_measurable(scene, fault),
            Mistake::NoLength => {
                let (labels, remedy) = self.without_length(scene, fault, name);
                return (fault.to_string(), labels, remedy);
            }
            Mistake::MixedDimensions => {
                let labels = self.units_of_terms(scene, fault);
                return (fault.to_string(), labels, "observe them by a statement each".to_owned());
            }
            Mistake::Unused => (
                format!("`{name}` is not in the line"),
                &["declared here", "not in this line"],
                format!("add `{name}` to the line, or remove it"),
            ),
            Mistake::Held => (
                format!("the {} `{name}` has no effect at a fixed end", noun()),
                &["cannot move", "fixed here"],
                format!("remove `{name}`, or put a bar or a spring between it and the fixed end"),
            ),
            Mistake::MovesAtWall => (
                format!("the mass `{name}` touches a wall, and has to begin at rest"),
                &["moves at the start", "fixed here"],
                format!(
                    "let `{name}` begin at rest, or put a spring or a bar between it and the wall"
                ),
            ),
            Mistake::Idle => (
                format!("this {} has nothing to press against", noun()),
                &["can do nothing", "nothing to press against"],
                format!("put a mass, a support or a load at the free end, or remove `{name}`"),
            ),
            Mistake::EndlessWithoutBar => (
                fault.to_string(),
                &["`endless` here", "not a bar"],
                format!("put a bar without length between `{second}` and `endless`"),
            ),
            Mistake::EndlessWithLength => {
                let property = match fault.parts.get(2) {
                    Some(Part::Property(_, Property::Travel)) => "travel",
                    _ => "length",
                };
                let remedy = format!(
                    "remove the `{property}` of `{second}`, or end the line with `free` or `fixed`"
                );
                (fault.to_string(), &["`endless` here", "this bar", "has a length"], remedy)
            }
            mistake => {
                let (labels, remedy) = plain(mistake);
                let message = match mistake {
                    Mistake::Repeated => format!("`{name}` is in the line twice"),
                    _ => fault.to_string(),
                };
                (message, labels, remedy.to_owned())
            }
        };
        (message, labels.iter().map(|label| (*label).to_owned()).collect(), remedy)
    }

    fn without_length(&self, scene: &Scene, fault: &Fault, name: &str) -> (Vec<String>, String) {
        let named = |element: &&Element| element.name == name;
        let property = match scene.elements.iter().find(named).map(|element| &element.kind) {
            Some(Kind::Bar(bar)) if matches!(bar.body, Body::Impedance { .. }) => "travel",
            _ => "length",
        };
        let end = match fault.parts.get(2) {
            Some(Part::Left) => Some(scene.line.left),
            Some(Part::Right) => Some(scene.line.right),
            _ => None,
        };
        let mut labels = vec!["there is more beyond it".to_owned(), format!("no `{property}`")];
        let mut remedy = format!("give `{name}` a `{property}`");
        if let Some(end) = end {
            labels[0] = "without length".to_owned();
            labels.push(format!("ends at `{}`", end.word()));
            remedy.push_str(", or end the line with `endless`");
        } else if scene.line.elements.len() == 1 {
            labels[0] = "without length".to_owned();
            remedy.push_str(", or end the line with `endless`");
        }
        (labels, remedy)
    }

    fn units_of_terms(&self, scene: &Scene, fault: &Fault) -> Vec<String> {
        let described = fault.parts.iter().filter_map(|part| match part {
            Part::Term { observable, term } => {
                let seen = &scene.observables[*observable].terms[*term];
                Some(seen.dimension().described())
            }
            _ => None,
        });
        described.take(2).collect()
    }

    /// A measure at a place that does not have it.
    fn not_measurable(&self, scene: &Scene, fault: &Fault) -> (String, Vec<String>, String) {
        let Some(Part::Term { observable, term }) = fault.parts.first() else {
            return (fault.to_string(), Vec::new(), String::new());
        };
        let seen = &scene.observables[*observable].terms[*term];
        let word = seen.measure.word();
        let Some(element) = seen.place.element() else {
            return (
                format!("the line as a whole has no {word}"),
                vec!["of the whole line".to_owned()],
                "observe `energy(line)` or `momentum(line)`, or name an element".to_owned(),
            );
        };
        let Declaration { name, kind, .. } = self.declaration(element);
        let name = &name.value;
        let is_section = !matches!(seen.place, Place::Element(_));
        let what = match is_section {
            true => "a section of a bar".to_owned(),
            false
                if seen.measure == Measure::Work
                    && matches!(scene.elements[element].kind, Kind::Load(_)) =>
            {
                "an imposed velocity".to_owned()
            }
            false => format!("a {}", kind.noun()),
        };
        let instead = match (&scene.elements[element].kind, seen.measure) {
            (Kind::Bar(_), Measure::Compression) => {
                format!("`displacement({name}.left) - displacement({name}.right)`")
            }
            (Kind::Bar(_), _) if is_section => format!("`{word}({name})`"),
            (Kind::Bar(_), _) => format!("`{word}({name}.left)` or `{word}({name}.at(1/2))`"),
            (Kind::Mass(_) | Kind::Load(_), _) => {
                format!("`velocity({name})` or `displacement({name})`")
            }
            (Kind::Spring(_) | Kind::Hertz(_), Measure::Displacement) => {
                format!("`compression({name})`")
            }
            (Kind::Spring(_) | Kind::Hertz(_), _) => {
                format!("`compression({name})` or `force({name})`")
            }
            (Kind::Support(_), _) => format!("`force({name})` or `energy({name})`"),
        };
        let beside = match (&scene.elements[element].kind, seen.measure) {
            (Kind::Bar(_), _) => "",
            (_, Measure::Velocity | Measure::Displacement) => {
                ", or the end of a bar or a mass next to it"
            }
            (Kind::Mass(_), Measure::Force) => ", or the force at the end of a bar next to it",
            (_, Measure::Work) => ", or the work at the end of a bar next to it",
            _ => "",
        };
        (
            format!("{what} has no {word}"),
            vec![format!("`{name}` is a {}", kind.noun())],
            format!("observe {instead}{beside}"),
        )
    }
}

/// What the parts of a mistake are, in their order, and the remedy, where it needs no names.
fn plain(mistake: Mistake) -> (&'static [&'static str], &'static str) {
    match mistake {
        Mistake::Repeated => (
            &["again here", "first here"],
            "declare another element with the same properties, or remove one of the two",
        ),
        Mistake::NoStiffness => {
            (&["both are zero"], "give a positive `stiffness` or a positive `damping`")
        }
        Mistake::EndsBeforeBegin => {
            (&["ends here", "begins here"], "`until` must be later than `from` (default 0)")
        }
        Mistake::ExponentTooSmall => {
            (&["smaller"], "give a larger `exponent`; a ball on a flat body has 3/2")
        }
        Mistake::ExponentTooLarge => {
            (&["larger"], "give a smaller `exponent`; a ball on a flat body has 3/2")
        }
        Mistake::NothingMoves => (
            &["at rest, and without load"],
            "give an element a `velocity` or a `strain`, or add a load",
        ),
        Mistake::EndlessBothSides => (
            &["this bar", "endless here", "and here"],
            "end the line with `free` or `fixed` on one side, or join something to the bar",
        ),
        Mistake::GapStaysClosed => (
            &["apart at the start"],
            "add the statement `contacts open`, or write `|` for bodies that touch",
        ),
        Mistake::ContactAtEnd => {
            (&["a contact", "with this end"], "write `-` beside `free` and `endless`")
        }
        Mistake::TwoVelocities => (
            &["imposes a velocity", "imposes one too"],
            "impose one velocity, such as the sum of both",
        ),
        Mistake::NoArea => (
            &["given by impedance, without an area"],
            "observe the force, or give the bar an area, a modulus and a density",
        ),
        Mistake::NoWaveSpeed => (
            &["given by impedance, without a wave speed", "this bar"],
            "define the bar by an area, a modulus and a density",
        ),
        Mistake::NoSuchEnd => {
            (&["no such end"], "observe the other end, or `at` a distance from it")
        }
        Mistake::ShareOfEndless => (&["a fraction"], "give a distance from the end of the bar"),
        Mistake::OutsideBar => (
            &["not certainly inside"],
            "give a fraction from 0 to 1, or a distance from 0 to the length",
        ),
        Mistake::IdealEndless => {
            (&["has no end"], "leave out `as`: what enters an endless bar does not return")
        }
        Mistake::IdealStrained => {
            (&["strained"], "remove the strain, or `as`: only waves can release it")
        }
        Mistake::IdealHeld => (
            &["fixed to the end of the line"],
            "remove `as`, or remove the rigid bar; `as = spring` needs one end that can move",
        ),
        Mistake::IdealAtWall => (
            &["in contact with the end of the line"],
            "remove `as`, join the bar to the end with `-`, or remove `contacts open`",
        ),
        Mistake::NoForceInRigid => (
            &["of a rigid bar"],
            "observe its velocity, or the force in a spring or bar next to it",
        ),
        Mistake::NoWorkInIdeal => (
            &["of a bar without waves"],
            "observe the work at a bar with waves or on a spring, or remove `as`",
        ),
        Mistake::Infinite => (
            &["of an endless bar", "in motion or strained from the start"],
            "observe a finite bar, or start the endless one at rest",
        ),
        _ => (&["not possible"], "check the values"),
    }
}

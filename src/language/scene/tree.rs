//! The tree of a text that states a scene. It re-uses names, symbols and expressions of
//! [`syntax`](crate::language::syntax), and the words of [`crate::scene`].

use crate::language::source::Source;
use crate::language::syntax::{Expression, Factor, Name, Operator, Sign, Spanned, Symbol};
use crate::scene::{End, Joint, Measure};

/// A text of statements: what bars and lumped elements there are, how they are joined, and what is
/// observed.
///
/// ```
/// use wavestep::language::{Source, parse_scene, syntax::Scene};
///
/// let text = "scene \"A rod\"\nbar rod { impedance = 1, travel = 1 }\nline free - rod - fixed";
/// let Scene { source, title, statements } = parse_scene(&Source::new("rod.wave", text)?)?;
/// assert_eq!((source.name(), title.value.as_str()), ("rod.wave", "A rod"));
/// assert_eq!(statements[1].to_string(), "line free - rod - fixed");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scene {
    /// The text all spans refer to.
    pub source: Source,
    /// What the text calls itself.
    pub title: Spanned<String>,
    /// Everything after the title, in the order of the text.
    pub statements: Vec<SceneStatement>,
}

/// A statement of a scene, with the place from its first word to its last.
///
/// ```
/// use wavestep::language::{Source, parse_scene, syntax::SceneStatement};
///
/// let source = Source::new("text", "scene \"A\"\nmass ram {\n  mass = 2\n}  # heavy\n")?;
/// let scene = parse_scene(&source)?;
/// let statement: &SceneStatement = &scene.statements[0];
/// assert_eq!(source.slice(statement.span), "mass ram {\n  mass = 2\n}");
/// assert_eq!(statement.to_string(), "mass ram { mass = 2 }");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub type SceneStatement = Spanned<SceneStatementKind>;

/// What a [`SceneStatement`] says.
///
/// ```
/// use wavestep::language::{Source, parse_scene, syntax::SceneStatementKind};
///
/// let source = Source::new("text", "scene \"A\"\nsymbol a > 0\nobserve v = velocity(ram)")?;
/// let scene = parse_scene(&source)?;
/// assert!(matches!(&scene.statements[0].value, SceneStatementKind::Symbols(all) if all.len() == 1));
/// assert!(matches!(&scene.statements[1].value, SceneStatementKind::Observe { .. }));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneStatementKind {
    /// `symbol mu > 0, q`: parameters.
    Symbols(Vec<Symbol>),
    /// `nonzero a - b`: an assumption.
    Nonzero(Expression),
    /// `bar rod { impedance = 1 }`: a material or an element.
    Declaration(Declaration),
    /// `line free - rod - fixed`: how the elements are joined.
    Line(Line),
    /// `contacts open`: contacts open where they would pull, and close where they meet again.
    ContactsOpen,
    /// `observe v = velocity(ram)`: a quantity of interest.
    Observe {
        /// What it is called.
        name: Name,
        /// Its terms, at least one.
        terms: Vec<Spanned<ObservedTerm>>,
    },
}

/// A material or an element with its properties.
///
/// ```
/// use wavestep::language::syntax::{Declaration, Declared, SceneStatementKind};
/// use wavestep::language::{Source, parse_scene};
///
/// let source = Source::new("text", "scene \"A\"\nmass ram { mass = 2 kg }")?;
/// let scene = parse_scene(&source)?;
/// let SceneStatementKind::Declaration(mass) = &scene.statements[0].value else { panic!() };
/// let Declaration { kind, name, properties } = mass;
/// assert_eq!((kind, name.value.as_str(), properties.len()), (&Declared::Mass, "ram", 1));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declaration {
    /// What is declared.
    pub kind: Declared,
    /// Its name.
    pub name: Name,
    /// Its properties, in the order of the text.
    pub properties: Vec<Property>,
}

/// What a [`Declaration`] declares. `Display` gives its word.
///
/// ```
/// use wavestep::language::syntax::Declared;
///
/// assert_eq!(Declared::Support.to_string(), "support");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Declared {
    /// `material`
    Material,
    /// `bar`
    Bar,
    /// `mass`
    Mass,
    /// `spring`
    Spring,
    /// `hertz`
    Hertz,
    /// `support`
    Support,
    /// `load`
    Load,
}

/// A property: `length = 3/2 m`.
///
/// ```
/// use wavestep::language::syntax::{Property, SceneStatementKind};
/// use wavestep::language::{Source, parse_scene};
///
/// let source = Source::new("text", "scene \"A\"\nbar rod { length = 3/2 m }")?;
/// let scene = parse_scene(&source)?;
/// let SceneStatementKind::Declaration(bar) = &scene.statements[0].value else { panic!() };
/// let Property { name, value, unit } = &bar.properties[0];
/// assert_eq!((name.value.as_str(), value.to_string().as_str()), ("length", "3/2"));
/// assert!(unit.is_some());
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its name.
    pub name: Name,
    /// Its value in the unit; for `material` a name.
    pub value: Expression,
    /// The unit of the whole value.
    pub unit: Option<Unit>,
}

/// A unit: a product of powers of named units, at least one. It begins with a multiplication.
///
/// ```
/// use wavestep::language::syntax::{SceneStatementKind, Unit};
/// use wavestep::language::{Source, parse_scene};
///
/// let source = Source::new("text", "scene \"A\"\nspring s { damping = 1 kN·s/m }")?;
/// let scene = parse_scene(&source)?;
/// let SceneStatementKind::Declaration(spring) = &scene.statements[0].value else { panic!() };
/// let unit: &Unit = spring.properties[0].unit.as_ref().unwrap();
/// assert_eq!((source.slice(unit.span), unit.value.len()), ("kN·s/m", 3));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub type Unit = Spanned<Vec<UnitFactor>>;

/// A factor of a unit: `/m^3`.
///
/// ```
/// use wavestep::language::syntax::{Operator, SceneStatementKind, UnitFactor};
/// use wavestep::language::{Source, parse_scene};
///
/// let source = Source::new("text", "scene \"A\"\nmaterial steel { density = 7850 kg/m³ }")?;
/// let scene = parse_scene(&source)?;
/// let SceneStatementKind::Declaration(steel) = &scene.statements[0].value else { panic!() };
/// let UnitFactor { operator, name, power } = &steel.properties[0].unit.as_ref().unwrap().value[1];
/// assert_eq!((*operator, name.value.as_str(), *power), (Operator::Divide, "m", 3));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFactor {
    /// Multiplied or divided by.
    pub operator: Operator,
    /// The unit with its prefix, `µ` as `u`.
    pub name: Name,
    /// The power it is raised to before it is multiplied or divided by.
    pub power: i8,
}

/// Elements from left to right between two ends, at least one.
///
/// ```
/// use wavestep::language::syntax::{Line, SceneStatementKind};
/// use wavestep::language::{Source, parse_scene};
/// use wavestep::scene::{End, Joint};
///
/// let source = Source::new("text", "scene \"A\"\nline free - ram | pile - endless")?;
/// let scene = parse_scene(&source)?;
/// let SceneStatementKind::Line(Line { left, elements, joints, right }) =
///     &scene.statements[0].value else { panic!() };
/// assert_eq!((left.value, elements[1].value.as_str(), right.value), (End::Free, "pile", End::Endless));
/// assert_eq!(joints[1].value, Joint::Contact);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// What is at the left.
    pub left: Spanned<End>,
    /// The names of the elements.
    pub elements: Vec<Name>,
    /// How they are joined, with the ends too: one more than there are elements.
    pub joints: Vec<Spanned<Joint>>,
    /// What is at the right.
    pub right: Spanned<End>,
}

/// A term of what is observed: `- 2*force(pile.right)`, `+ force(pile.left)/2`.
///
/// ```
/// use wavestep::language::syntax::{ObservedTerm, SceneStatementKind, Sign};
/// use wavestep::language::{Source, parse_scene};
/// use wavestep::scene::Measure;
///
/// let source = Source::new("text", "scene \"A\"\nobserve F = -2*force(pile.left)/3")?;
/// let scene = parse_scene(&source)?;
/// let SceneStatementKind::Observe { terms, .. } = &scene.statements[0].value else { panic!() };
/// let ObservedTerm { sign, factors, measure, place } = &terms[0].value;
/// assert_eq!((*sign, factors.len(), measure.value), (Sign::Minus, 2, Measure::Force));
/// assert_eq!(place.to_string(), "pile.left");
/// assert_eq!(terms[0].to_string(), "2/3*force(pile.left)");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObservedTerm {
    /// Added or subtracted.
    pub sign: Sign,
    /// What is multiplied and divided by, from left to right.
    pub factors: Vec<Factor>,
    /// What is measured.
    pub measure: Spanned<Measure>,
    /// Where.
    pub place: Spanned<ObservedPlace>,
}

/// Where something is measured: `pile.at(1/2)`, `ram`, `line`.
///
/// ```
/// use wavestep::language::syntax::{ObservedPlace, SceneStatementKind};
/// use wavestep::language::{Source, parse_scene};
///
/// let source = Source::new("text", "scene \"A\"\nobserve E = energy(line)")?;
/// let scene = parse_scene(&source)?;
/// let SceneStatementKind::Observe { terms, .. } = &scene.statements[0].value else { panic!() };
/// let ObservedPlace { element, section } = &terms[0].value.place.value;
/// assert_eq!((element.value.as_str(), section), ("line", &None));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObservedPlace {
    /// The name of an element, or `line`.
    pub element: Name,
    /// A section of it.
    pub section: Option<Section>,
}

/// A section of a bar.
///
/// ```
/// use wavestep::language::syntax::{SceneStatementKind, Section};
/// use wavestep::language::{Source, parse_scene};
///
/// let source = Source::new("text", "scene \"A\"\nobserve e = strain(rod.at(20 mm))")?;
/// let scene = parse_scene(&source)?;
/// let SceneStatementKind::Observe { terms, .. } = &scene.statements[0].value else { panic!() };
/// let Some(Section::At { position, unit }) = &terms[0].value.place.value.section else { panic!() };
/// assert_eq!((position.to_string().as_str(), unit.is_some()), ("20", true));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Section {
    /// `left`
    Left,
    /// `right`
    Right,
    /// `at(1/2)`, `at(20 mm)`
    At {
        /// How far from the left end.
        position: Expression,
        /// The unit of a distance.
        unit: Option<Unit>,
    },
}

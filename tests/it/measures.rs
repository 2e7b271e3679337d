//! The table of measures: units, terms and refusals.

use wavestep::expression::Fraction;
use wavestep::language::{Source, read_scene};
use wavestep::network::{
    Elements, Energy, Face, Field, Lump, MeasuredValue, NetworkError, Reading, ScaledScene,
    Section, Term,
};
use wavestep::scene::{Dimension, Measure, Mistake, Place, Position, Seen};
use wavestep_polynomial::Rational;

fn scaled(text: &str) -> ScaledScene {
    let source = Source::new("scene", text).expect("a text");
    ScaledScene::of(&read_scene(&source, &Default::default()).expect("a scene")).expect("scales")
}

fn number(numerator: i64, denominator: i64) -> Fraction {
    Fraction::constant(&Rational::new(numerator.into(), denominator.into()))
}

fn at(bar: usize, delays: [Option<(i64, i64)>; 2]) -> Section {
    Section { bar, delays: delays.map(|delay| delay.map(|(p, q)| number(p, q))) }
}

/// An observable, its unit, and its terms by coefficient and reading.
type Row = (&'static str, Fraction, Vec<(Fraction, Reading)>);

fn assert_table(scene: &ScaledScene, rows: Vec<Row>) {
    assert_eq!(scene.measures.len(), rows.len());
    for (measured, (name, unit, terms)) in scene.measures.iter().zip(rows) {
        assert_eq!((measured.name.as_str(), &measured.unit), (name, &unit.into()));
        let MeasuredValue::Linear(found) = &measured.value else { panic!("{name}: linear") };
        let found: Vec<(Fraction, Reading)> =
            found.iter().map(|term| (term.coefficient.clone(), term.of.clone())).collect();
        assert_eq!(found, terms, "{name}");
    }
}

/// `c` is 5000 m/s: the units are 20000 kg/s of impedance, 1/5000 s, and 1/4 m/s, to which 5 kN push.
#[test]
fn measures_in_units_have_those_of_the_scene() {
    let scene = scaled(
        "scene \"A\"\nload push { force = 5 kN }\n\
         bar rod { modulus = 200 GPa, density = 8000 kg/m^3, area = 5 cm^2, length = 1 m }\n\
         spring end { stiffness = 20 MN/m }\nline free - push - rod - end - fixed\n\
         observe v = velocity(rod.at(1/4))\nobserve u = displacement(rod.right)\n\
         observe F = force(rod.left)\nobserve e = strain(rod.at(1/2))\n\
         observe s = stress(rod.at(250 mm))\nobserve c = compression(end)\n\
         observe P = momentum(rod)/2\nobserve X = force(end) + force(rod.at(1/4))\n",
    );
    let quarter = || at(0, [Some((1, 4)), Some((3, 4))]);
    let (left, right) = (at(0, [Some((0, 1)), Some((1, 1))]), at(0, [Some((1, 1)), Some((0, 1))]));
    let (middle, end) = (at(0, [Some((1, 2)); 2]), Lump { node: 1, place: 0 });
    let one = || number(1, 1);
    let rows = vec![
        ("v", number(1, 4), vec![(one(), Reading::InBar(Field::Velocity, quarter()))]),
        ("u", number(1, 20_000), vec![(one(), Reading::InBar(Field::Displacement, right))]),
        ("F", number(5000, 1), vec![(one(), Reading::InBar(Field::Force, left))]),
        ("e", number(1, 20_000), vec![(-&one(), Reading::InBar(Field::Force, middle))]),
        ("s", number(10_000_000, 1), vec![(-&one(), Reading::InBar(Field::Force, quarter()))]),
        ("c", number(1, 20_000), vec![(one(), Reading::Compression(end))]),
        ("P", number(1, 1), vec![(number(1, 2), Reading::Momentum(0))]),
        (
            "X",
            number(5000, 1),
            vec![(one(), Reading::Force(end)), (one(), Reading::InBar(Field::Force, quarter()))],
        ),
    ];
    assert_table(&scene, rows);
}

/// Endless bars are counted from their one end; a damper alone is as short as its ends tell.
#[test]
fn measures_without_units_are_plain_numbers() {
    let scene = scaled(
        "scene \"A\"\nbar a { impedance = 2 }\nmass m { mass = 3, velocity = 1 }\n\
         spring d { damping = 5 }\nsupport g { stiffness = 7, damping = 11 }\n\
         bar b { impedance = 4 }\nline endless - a - m - d - g - b - endless\n\
         observe F = force(a.right) - force(b.at(6))\nobserve e = strain(a.at(5))\n\
         observe v = 2*velocity(m)\nobserve u = displacement(m)\n\
         observe c = compression(d)\nobserve P = momentum(line)\n",
    );
    let lump = |place| Lump { node: 0, place };
    let (one, minus_one) = (number(1, 1), number(-1, 1));
    let in_bar = |bar, delays| Reading::InBar(Field::Force, at(bar, delays));
    let rows = vec![
        (
            "F",
            vec![
                (one.clone(), in_bar(0, [None, Some((0, 1))])),
                (minus_one.clone(), in_bar(1, [Some((6, 1)), None])),
            ],
        ),
        ("e", vec![(number(-1, 2), in_bar(0, [None, Some((5, 1))]))]),
        ("v", vec![(number(2, 1), Reading::Velocity(Face::Left(lump(0))))]),
        ("u", vec![(one.clone(), Reading::Displacement(Face::Left(lump(0))))]),
        (
            "c",
            vec![
                (one.clone(), Reading::Displacement(Face::Left(lump(1)))),
                (minus_one, Reading::Displacement(Face::Right(lump(1)))),
            ],
        ),
        (
            "P",
            vec![
                (one.clone(), Reading::Momentum(0)),
                (number(3, 1), Reading::Velocity(Face::Left(lump(0)))),
                (one.clone(), Reading::Momentum(1)),
            ],
        ),
    ];
    assert_table(
        &scene,
        rows.into_iter().map(|(name, terms)| (name, one.clone(), terms)).collect(),
    );
    let elements = Elements { model: scene.model(), layout: &scene.layout };
    let force = |place| {
        let terms = elements.force(lump(place)).expect("a linear law");
        terms.into_iter().map(|term| (term.coefficient, term.of)).collect::<Vec<_>>()
    };
    let closing = [Face::Left(lump(1)), Face::Right(lump(1))].map(Reading::Velocity);
    assert_eq!(
        force(1),
        [number(5, 1), number(-5, 1)].into_iter().zip(closing).collect::<Vec<_>>()
    );
    let moved = Reading::Velocity(Face::Left(lump(2)));
    assert_eq!(force(2), [(number(7, 1), Reading::Compression(lump(2))), (number(11, 1), moved)]);
    let energy = |name: &str| {
        let element = scene.scene().elements.iter().position(|element| element.name == name);
        elements.energy(element.expect("an element")).expect("an energy")
    };
    let square = |p, q, of| vec![Energy::Square(Box::new(Term { coefficient: number(p, q), of }))];
    assert_eq!(energy("m"), square(3, 2, Reading::Velocity(Face::Left(lump(0)))));
    assert_eq!((energy("d"), energy("a")), (Vec::new(), vec![Energy::InBar(0)]));
    assert_eq!(energy("g"), square(7, 2, Reading::Compression(lump(2))));
}

/// What cannot be measured is refused for the reason that the scene has.
#[test]
fn refusals_have_their_reasons() {
    let text = "scene \"A\"\nbar a { impedance = 2, velocity = 1 }\nline fixed - a - endless\n\
                observe v = velocity(a.left)\n";
    let source = Source::new("scene", text).expect("a text");
    let mut scene = read_scene(&source, &Default::default()).expect("a scene");
    for (measure, place, mistake) in [
        (Measure::Momentum, Place::Line, Mistake::Infinite),
        (Measure::Energy, Place::Element(0), Mistake::Infinite),
        (Measure::Stress, Place::Left(0), Mistake::NoArea),
        (Measure::Force, Place::Right(0), Mistake::NoSuchEnd),
        (Measure::Velocity, Place::At(0, Position::Share(number(1, 2))), Mistake::ShareOfEndless),
        (Measure::Compression, Place::Element(0), Mistake::NotMeasurable),
    ] {
        let (coefficient, dimension) = (number(1, 1), Dimension::NONE);
        scene.observables[0].terms[0] = Seen { coefficient, dimension, measure, place };
        let refused = ScaledScene::of(&scene);
        assert_eq!(
            refused,
            Err(NetworkError::Unobservable { name: "v".to_owned(), reason: mistake })
        );
    }
}

/// What a support or a load moves like is the end of the bar where it acts.
#[test]
fn supports_and_loads_move_as_the_places_they_act_at() {
    for joint in ["| m", "| m - free\ncontacts open\n#", "- m"] {
        let text = format!(
            "scene \"Blow\"\nload p {{ force = sin(pi*t), until = 1 }}\nbar b {{ impedance = 1, travel = 2/3 }}\n\
             support u {{ stiffness = 2, damping = 1/2 }}\nmass m {{ mass = 3 }}\nline free - p - b - u {joint} - free\n\
             observe vp = velocity(p)\nobserve vb = velocity(b.left)\nobserve vu = velocity(u)\nobserve ve = velocity(b.right)\n\
             observe xp = displacement(p)\nobserve xb = displacement(b.left)\nobserve xu = displacement(u)\n\
             observe xe = displacement(b.right)\nobserve e = energy(line)\n"
        );
        let problem = wavestep::Problem::read("text", &text).expect("a scene");
        let at = |name: &str, time: &str| {
            problem.signal(name).unwrap().at(time, 20).unwrap().to_text(20)
        };
        for time in ["1/2", "5/4", "2", "31/10"] {
            for [own, end] in [["vp", "vb"], ["vu", "ve"], ["xp", "xb"], ["xu", "xe"]] {
                assert_eq!(at(own, time), at(end, time), "{own} at {time}: {joint}");
            }
        }
    }
}

/// Forces on both sides of what has no mass, and velocities of one place, cancel; others do not.
#[test]
fn what_is_equal_by_the_laws_of_a_place_cancels() {
    let parts = [
        "bar a { impedance = 1, travel = 1, velocity = 1 }",
        "spring k { stiffness = 1, damping = 2 }",
        "spring l { stiffness = 3 }",
        "mass m { mass = 1 }",
        "support s { damping = 1 }",
        "bar b { impedance = 2, travel = 1 }",
    ];
    let count = |line: &str, observed: &str, rest: &str| {
        let is_there =
            |part: &&&str| line.contains(&format!(" {} ", part.split(' ').nth(1).unwrap()));
        let parts: Vec<&str> = parts.iter().filter(is_there).copied().collect();
        let parts = parts.join("\n");
        let text = format!("scene \"Equal\"\n{parts}\nline {line}\nobserve x = {observed}\n{rest}");
        let MeasuredValue::Linear(terms) = &scaled(&text).measures[0].value else { panic!() };
        terms.len()
    };
    let ends = "force(a.right) - force(b.left)";
    for (line, observed, rest, terms) in [
        ("free - a - k - b - free", ends, "", 0),
        ("free - a - k - l - b - free", ends, "", 0),
        ("free - a - b - free", ends, "", 0),
        ("free - a | b - free", ends, "contacts open", 0),
        ("free - a | k - b - free", "force(k) - force(a.right)", "contacts open", 0),
        ("free - a - k - b - free", "2*force(a.right) - force(k) - force(b.left)", "", 0),
        ("free - a - k - l - b - free", "force(k) - force(l)", "", 0),
        ("free - a - m - b - free", "velocity(a.right) - velocity(b.left)", "", 0),
        ("free - a - m - b - free", "displacement(a.right) - displacement(m)", "", 0),
        ("free - a - k - b - free", "force(a.right) + force(b.left)", "", 2),
        ("free - a - k - m - b - free", ends, "", 2),
        ("free - a - s - b - free", ends, "", 2),
        ("free - a - k - m - l - b - free", "force(k) - force(l)", "", 2),
        ("free - a - k - b - free", "force(a.left) - force(b.right)", "", 0),
        ("fixed - a - k - b - fixed", "force(a.left) - force(b.right)", "", 2),
        ("free - a - k - b - free", "velocity(a.right) - velocity(b.left)", "", 2),
        ("free - a | b - free", "velocity(a.right) - velocity(b.left)", "contacts open", 2),
    ] {
        assert_eq!(count(line, observed, rest), terms, "{line}: {observed}");
    }
}

//! Contacts that begin apart: what flies freely meets later, and then does what it would have done at once.

use wavestep::{EventKind, Method, Problem};
use wavestep_polynomial::Rational;

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn problem(text: &str) -> Problem {
    Problem::read("gap.wave", text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// A bar meets a wall after its gap, and leaves it after two travel times.
#[test]
fn a_gap_to_a_wall_closes() {
    let bar = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 2 }\n\
        line free - rod |1/3| fixed\ncontacts open\nobserve u = displacement(rod.right)\n\
        observe f = force(rod.right)";
    let problem = problem(bar);
    let history = problem.events(12).unwrap();
    let events: Vec<(EventKind, String)> =
        history.events.iter().map(|event| (event.kind, event.time.to_text(3))).collect();
    let closes = (EventKind::Closing, "0.167 = 1/6".to_owned());
    assert_eq!(events, [closes, (EventKind::Opening, "2.17 = 13/6".to_owned())]);
    assert_eq!(history.contacts[0].impulses[0].to_f64(), 4.0);
    let value =
        |name: &str, time: &str| problem.signal(name).unwrap().at(time, 12).unwrap().to_text(3);
    assert_eq!(value("u", "1/12"), "0.167 = 1/6");
    assert_eq!(value("u", "1"), "0.333 = 1/3");
    assert_eq!(value("f", "1/7"), "0");
    assert_eq!(value("f", "1"), "2");
}

/// What the bodies at the left do with one velocity before they meet what rests, the gap only delays: elements, and the
/// velocity of all that moves.
const STRUCK: [(&str, &str, i64); 5] = [
    (
        "bar a { impedance = 1, travel = 1, velocity = 2 }\nbar b { impedance = 3, travel = 3/2 }\n\
         mass m { mass = 1/2 }\nsupport s { stiffness = 1, damping = 1/3 }\n",
        "free - a GAP b - m - s - free",
        2,
    ),
    (
        "mass a { mass = 2, velocity = 3 }\nspring k { stiffness = 5 }\nbar b { impedance = 1 }\n",
        "free - a GAP k - b - endless",
        3,
    ),
    (
        "mass a { mass = 2, velocity = 3 }\nspring k { stiffness = 5, damping = 1 }\n\
         bar b { impedance = 1, travel = 2 }\n",
        "free - a - k GAP b - fixed",
        3,
    ),
    (
        "bar a { impedance = 2, velocity = 1 }\nsupport s { stiffness = 2 }\n\
         bar b { impedance = 1, travel = 2 }\n",
        "endless - a GAP s | b - free",
        1,
    ),
    (
        "mass a { mass = 1, velocity = 1 }\nspring k { stiffness = 3, damping = 1/2 }\n",
        "free - a - k GAP fixed",
        1,
    ),
];

#[test]
fn a_gap_delays_an_impact() {
    for (elements, line, velocity) in STRUCK {
        let observed = match line.contains("- b") || line.contains("| b") || line.contains("GAP b")
        {
            true => "observe v = velocity(b.left)\nobserve e = energy(b)\n",
            false => "observe v = velocity(a)\nobserve e = energy(k)\n",
        };
        let text = |gap: &str| {
            let line = line.replace("GAP", gap);
            format!("scene \"A\"\n{elements}line {line}\ncontacts open\n{observed}")
        };
        let [apart, touching] = ["|5/7|", "|"].map(|gap| problem(&text(gap)));
        let delay = rational(5, 7) / rational(velocity, 1);
        for n in 0..9 {
            let time = rational(4 * n + 1, 9);
            for name in ["v", "e"] {
                let at = |problem: &Problem, time: &Rational| {
                    problem.signal(name).unwrap().at(time.to_string().as_str(), 20).unwrap()
                };
                let (own, other) = (at(&apart, &(&time + &delay)), at(&touching, &time));
                let ([a, b], [c, d]) = (own.bounds(), other.bounds());
                let small = rational(1, 10_i64.pow(15));
                assert!(
                    a <= d && c <= b && b - a < small && d - c < small,
                    "{line}, {name}: {time}"
                );
            }
        }
    }
}

/// A pulse crosses a gap once it has closed it: the method of steps follows the same.
#[test]
fn the_method_of_steps_closes_gaps() {
    let text = "scene \"A\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
        bar b { impedance = 1, travel = 3 }\nbar c { impedance = 2, travel = 1 }\nmass m { mass = 1 }\n\
        spring k { stiffness = 2 }\nspring j { stiffness = 3 }\n\
        line free - a | b |1/4| k - c - m - j |1/9| fixed\ncontacts open\n\
        observe v = velocity(m)\nobserve f = force(k)\n";
    let problem = problem(text);
    let history = problem.events_until("12", 12).unwrap();
    assert!(history.events.iter().filter(|own| own.kind == EventKind::Closing).count() >= 2);
    for name in ["v", "f"] {
        let signal = problem.signal(name).unwrap();
        let times: Vec<Rational> = (1..24).map(|n| rational(n, 2) + rational(1, 97)).collect();
        let stepped = signal.values_by(&times, Method::Steps { tolerance: 1e-10 }).unwrap().values;
        for (time, found) in times.iter().zip(stepped) {
            let exact = signal.at(time.to_string().as_str(), 15).unwrap().to_f64();
            assert!((exact - found).abs() < 1e-8, "{name} at {time}: {exact} {found}");
        }
    }
}

/// What flies with one velocity that is no rational number flies on without a force between its parts.
#[test]
fn a_flight_at_an_irrational_velocity_ends() {
    let text = "scene \"A\"\nmass i { mass = 1, velocity = sqrt(15) }\nspring k { stiffness = 3 }\n\
        mass c { mass = 5, velocity = sqrt(15) }\nspring b { stiffness = 10 }\n\
        line free - i - k - c |1| b - fixed\ncontacts open\nobserve f = force(k)";
    let history = problem(text).events_until(1, 12).unwrap();
    let times: Vec<String> = history.events.iter().map(|event| event.time.to_text(12)).collect();
    assert_eq!(times, ["0.258198889747"]);
}

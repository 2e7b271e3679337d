//! A force that is a load alone: zero by a boundary condition while the load does not act, and the load while it does.

use wavestep::Problem;

/// Times at which the load begins and ends belong to what follows them; the limits before are those of what was.
#[test]
fn a_load_alone_is_silent_only_while_it_does_not_act() {
    let text = "scene \"A\"\nload push { force = 1 + exp(-t), from = 1, until = 3 }\n\
                bar a { impedance = 1, travel = 1 }\nmass m { mass = pi }\nLINE\nobserve force = force(a.left)";
    let closed = text.replace("LINE", "line free - push - a - m - free");
    let open = text.replace("LINE", "line free - push - a | m - free\ncontacts open");
    for text in [closed, open] {
        let problem = Problem::read("load.wave", &text).unwrap();
        let signal = problem.signal("force").unwrap();
        for time in ["1/2", "1", "2", "3", "7/2", "4"] {
            let exact: f64 = match time.split_once('/') {
                Some((top, bottom)) => top.parse::<f64>().unwrap() / bottom.parse::<f64>().unwrap(),
                None => time.parse().unwrap(),
            };
            let acts = [exact > 1.0 && exact <= 3.0, (1.0..3.0).contains(&exact)];
            let told = [signal.before(time, 15).unwrap(), signal.at(time, 15).unwrap()];
            for (acts, told) in acts.into_iter().zip(told) {
                match acts {
                    true => assert!(
                        (told.to_f64() - 1.0 - (-exact).exp()).abs() < 1e-14,
                        "{time}: {told}"
                    ),
                    false => assert_eq!(told.to_text(15), "0", "{time}"),
                }
            }
        }
    }
}

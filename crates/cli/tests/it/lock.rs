//! `wavestep lock` and `wavestep check`: what is written and compared, and what is refused.

use super::{ROOT, folder, run};
use std::fs;
use std::path::Path;
use wavestep::language::{Source, read_recurrence};
use wavestep::lock::{Derivable, Lock, Request};
use wavestep::scenes;
use wavestep::solution::Solution;

fn scene(name: &str) -> &'static str {
    scenes::find(name).expect("a scene of the library").text
}

#[test]
fn the_command_locks_and_checks() {
    let folder = folder("lock-command");
    fs::write(folder.join("my.wave"), scene("rigid-mass")).expect("a file");
    let lock = ["lock", "my.wave", "--through", "2", "-o", "my.lock"];
    let (code, out, err) = run(&folder, &lock);
    assert_eq!((code, &*out, &*err), (0, "my.lock: locked 6 pieces\n", ""));
    let check = ["check", "my.wave", "--locked", "my.lock"];
    let (code, out, err) = run(&folder, &check);
    assert_eq!((code, &*out, &*err), (0, "my.lock: 6 pieces as locked\n", ""));
    let changed = scene("rigid-mass").replace("starts at 1 ", "starts at 1/2 ");
    fs::write(folder.join("my.wave"), changed).expect("a file");
    let (code, out, err) = run(&folder, &check);
    assert_eq!(code, 1);
    assert!(out.starts_with("f[0] differs\n  exp(-s): locked 1, now 1/2\n"), "{out}");
    let message = "error: my.wave differs in 5 places from my.lock\nhelp: ";
    assert!(err.starts_with(message), "{err}");
    // Without a file, what would be in it; an old file stays whole when there is nothing to write.
    let (_, out, _) = run(&folder, &["lock", "two-bars", "--through", "2"]);
    let source = Source::new("two-bars", scene("two-bars")).unwrap();
    let solution = Solution::new(read_recurrence(&source, &Default::default()).unwrap());
    let lock =
        Lock::of_pieces(Derivable::Equations(&solution), Some(2), &Request::default()).unwrap();
    assert_eq!(out, lock.to_text());
    let before = fs::read_to_string(folder.join("my.lock")).expect("a file");
    let (code, _, err) =
        run(&folder, &["lock", "my.wave", "--through", "2", "--at", "1", "-o", "my.lock"]);
    assert_eq!((code, err.contains("mu has no value")), (2, true), "{err}");
    assert_eq!(fs::read_to_string(folder.join("my.lock")).expect("a file"), before);
    // What is no ordinary file is written to, and stays what it is.
    let (code, _, _) = run(&folder, &["lock", "two-bars", "--through", "0", "-o", "/dev/null"]);
    assert!(code == 0 && !fs::metadata("/dev/null").expect("a device").is_file());
    let files = fs::read_dir(&folder).expect("a folder").count();
    assert_eq!(files, 2, "no partial file is left");
}

/// Without a common measure echoes are locked, and the periods of their lattice.
#[test]
fn echoes_of_a_lattice_are_locked() {
    let folder = folder("lock-lattice");
    let text = include_str!("../questions/no-common-measure.wave");
    fs::write(folder.join("my.wave"), text).expect("a file");
    let (code, out, err) = run(&folder, &["lock", "my.wave", "--through", "2", "-o", "my.lock"]);
    assert_eq!((code, &*out, &*err), (0, "my.lock: locked 11 pieces\n", ""));
    for (old, new, told) in [
        (
            "impedance = 1/2",
            "impedance = 1/3",
            "phi_g_rod[1,0] differs\n  exp(-s): locked 1/3, now 1/2\n",
        ),
        (
            "sqrt(2)",
            "sqrt(3)",
            "period 2 differs\n  locked 2.8284271247461900976\n  now    3.4641016151377545871\n",
        ),
    ] {
        fs::write(folder.join("my.wave"), text.replace(old, new)).expect("a file");
        let (code, out, _) = run(&folder, &["check", "my.wave", "--locked", "my.lock"]);
        assert!(code == 1 && out.contains(told), "{out}");
    }
}

#[test]
fn bad_requests_are_refused() {
    let folder = folder("lock-refused");
    fs::write(folder.join("m.wave"), scene("rigid-mass")).expect("a file");
    let long = "recurrence \"long\"\nperiod 1, local s, time t\nwave f\n\
                equation f[n] = 1e100*f[n-1] + 1/3\n";
    fs::write(folder.join("long.wave"), long).expect("a file");
    let cases: [(&[&str], &str); 8] = [
        (&["lock", "rigid-mass", "--through", "500"], "terms"),
        (&["lock", "rigid-mass", "--through", "1", "-o", "nowhere/my.lock"], "cannot be written"),
        (&["lock", "rigid-mass", "--through", "1", "--digits", "0"], "cannot be certified"),
        (&["lock", "m.wave", "--through", "0", "-o", "m.wave"], "overwrite the scene"),
        (&["lock", "long.wave", "--through", "15"], "too long to be read back"),
        (&["lock", "rigid-mass", "--through", "1", "--at", "-1"], "before the start"),
        (&["check", "rigid-mass", "--locked", "nowhere.lock"], "cannot be read"),
        (&["check", "rigid-mass", "--locked", "x", "--set", "mu=1"], "cannot be used with"),
    ];
    for (arguments, expected) in cases {
        let (code, out, err) = run(&folder, arguments);
        assert_eq!((code, &*out), (2, ""), "{arguments:?}: {err}");
        assert!(err.contains(expected), "{arguments:?}: {err}");
    }
}

#[test]
fn the_command_locks_events_and_checks_them() {
    let folder = folder("lock-history");
    let scene = wavestep::scenes::find("bars-of-equal-length").unwrap().text;
    fs::write(folder.join("my.wave"), scene).unwrap();
    fs::write(folder.join("closed.wave"), scene.replace("contacts open\n", "")).unwrap();
    let (code, out, err) = run(&folder, &["lock", "my.wave", "--at", "5/2", "-o", "my.lock"]);
    assert_eq!((code, &*out, &*err), (0, "my.lock: locked 2 events and 5 values\n", ""));
    let check = ["check", "my.wave", "--locked", "my.lock"];
    let (code, out, err) = run(&folder, &check);
    assert_eq!((code, &*out, &*err), (0, "my.lock: 2 events and 5 values as locked\n", ""));
    fs::write(folder.join("my.wave"), scene.replace("velocity = 1", "velocity = 2")).unwrap();
    let (code, out, err) = run(&folder, &check);
    assert_eq!(code, 1);
    assert!(out.starts_with("event 1 differs\n  force after: locked 1/2, now 1\n"), "{out}");
    assert!(err.starts_with("error: my.wave differs in "), "{err}");
    fs::write(folder.join("my.wave"), scene).unwrap();
    // Values that were set are in the file.
    let set =
        ["lock", "saint-venant", "--set", "mu=1", "--at", "1/2", "--at", "5", "-o", "sv.lock"];
    assert_eq!(run(&folder, &set).1, "sv.lock: locked 4 events and 10 values\n");
    let (code, out, _) = run(&folder, &["check", "saint-venant", "--locked", "sv.lock"]);
    assert_eq!((code, &*out), (0, "sv.lock: 4 events and 10 values as locked\n"));
    let kept = fs::read(Path::new(ROOT).join("tests/locks/version-2.lock")).unwrap();
    assert_eq!(fs::read(folder.join("sv.lock")).unwrap(), kept);
    let closed = ["lock", "closed.wave", "--through", "1", "-o", "closed.lock"];
    assert_eq!(run(&folder, &closed).0, 0);
    let cases: [(&[&str], &str); 8] = [
        (&["lock", "saint-venant"], "events need numbers, and `mu` has no value"),
        (&["lock", "my.wave", "--through", "1"], "if contacts open, there are no periods"),
        (&["lock", "my.wave", "--to", "-1"], "before the start"),
        (&["lock", "my.wave", "-o", "my.wave"], "overwrite the scene"),
        (&["lock", "closed.wave"], "neither a last period"),
        (&["lock", "closed.wave", "--to", "3"], "there are no events"),
        (&["check", "closed.wave", "--locked", "my.lock"], "no contact opens in closed.wave now"),
        (&["check", "my.wave", "--locked", "closed.lock"], "contacts now open in my.wave"),
    ];
    for (arguments, expected) in cases {
        let (code, out, err) = run(&folder, arguments);
        assert_eq!((code, &*out), (2, ""), "{arguments:?}: {err}");
        assert!(err.contains(expected), "{arguments:?}: {err}");
    }
}

/// A section of a bar is told by metres, or by a travel time where the bar is.
#[test]
fn distances_are_locked_in_their_units() {
    let folder = folder("lock-units");
    let text = "scene \"Sections\"\nbar ram { impedance = 20 kN*s/m, travel = 100 us, velocity = 2 m/s }\n\
        bar rod { modulus = 210 GPa, density = 7850 kg/m^3, area = 2 cm^2 }\nline free - ram | rod - endless\n\
        contacts open\nobserve f = force(ram.at(30 us))\nobserve g = force(rod.at(2 m))\n";
    fs::write(folder.join("my.wave"), text).expect("a file");
    let (code, out, err) = run(&folder, &["lock", "my.wave", "--at", "50us"]);
    assert_eq!((code, &*err), (0, ""));
    assert!(out.contains("f = force(ram.at(3/100000 s))\n"), "{out}");
    assert!(out.contains("g = force(rod.at(2 m))\n"), "{out}");
}

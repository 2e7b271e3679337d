//! How long closed contacts are true, as commands say it.

use super::{anywhere, run, words};

/// The command says so on standard error; what it derives stays what it is.
#[test]
fn commands_say_how_long_closed_contacts_are_true() {
    let scene = wavestep::scenes::find("saint-venant").unwrap().text;
    std::fs::write(anywhere().join("validity.wave"), scene.replace("contacts open\n", "")).unwrap();
    let run = |line: &str| {
        let (_, out, err) = run(anywhere(), &words(line));
        (out, err)
    };
    let pulls = "from t = 3.06766764162 on, the contact between hammer and rod is in tension; add \
                 `contacts open` and it opens instead";
    for (line, told) in [
        (
            "derive validity.wave --through 0 --set mu=1",
            "valid until t = 3.06766764162, when the contact between hammer and rod goes into tension",
        ),
        (
            "derive validity.wave --through 0",
            "valid as long as force(rod.left) >= 0 at the contact between hammer and rod",
        ),
        ("find validity.wave --set mu=1 --zero velocity --from 0 --to 4", pulls),
    ] {
        let (out, err) = run(line);
        assert_eq!(err, format!("note: {told}\n"), "{line}");
        assert!(!out.is_empty() && !out.contains("note"), "{line}");
    }
    for line in [
        "eval validity.wave --set mu=1 --quantity velocity --at 3",
        "find validity.wave --set mu=1 --zero velocity --from 0 --to 3",
        "eval saint-venant --set mu=1 --quantity velocity --at 4",
        "derive mass-on-fixed-bar --through 0",
    ] {
        assert_eq!(run(line).1, "", "{line}");
    }
}

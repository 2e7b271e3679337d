//! Four scenes are there twice: as recurrences, taken from a book, and as parts joined in a line.

use std::collections::BTreeMap;

use wavestep::expression::{Expression, Fraction};
use wavestep::language::{Source, read_recurrence};
use wavestep::recurrence::Recurrence;
use wavestep::solution::Solution;
use wavestep_polynomial::{Rational, Symbol};

use crate::scenes::{built_in, network_of, scene_of};
use crate::support::violation;

/// Recurrence, scene, waves that are the same, observables that are the same, and how many units of the
/// recurrence are one of the scene for the last.
type Twin =
    (&'static str, &'static str, &'static [[&'static str; 2]], &'static [&'static str], i64);

const TWINS: [Twin; 4] = [
    (
        "rigid-mass",
        "mass-on-fixed-bar",
        &[["f", "f"], ["g", "g"]],
        &["velocity", "strain_impact", "strain_fixed"],
        1,
    ),
    // There the force is in EA V/(2c).
    ("pulse-shape", "cushioned-impact", &[["a", "cushion"]], &["force"], 2),
    (
        "two-bars",
        "striker-on-long-bar",
        &[["f", "f_striker"], ["g", "g_striker"], ["F", "f_long"]],
        &["interface_velocity", "force"],
        1,
    ),
    ("constant-force", "pushed-bar", &[["f", "f"]], &["velocity"], 1),
];

const LAST: usize = 30;

fn stated(name: &str) -> Recurrence {
    let source = Source::new(name, built_in(name)).expect("a text");
    read_recurrence(&source, &BTreeMap::new()).unwrap_or_else(|error| panic!("{error}"))
}

/// The recurrence of a scene for the observables named.
fn derived(name: &str, observables: &[&str]) -> Recurrence {
    let mut scene = scene_of(built_in(name), &[]);
    scene.observables.retain(|seen| observables.contains(&seen.name.as_str()));
    network_of(&scene).recurrence().unwrap_or_else(|error| panic!("{error}"))
}

fn renamed(pieces: &[Expression], from: &Symbol, to: &Symbol) -> Vec<Expression> {
    let rename =
        |piece: &Expression| piece.substitute(from, &Fraction::symbol(to)).expect("a name");
    pieces.iter().map(rename).collect()
}

#[test]
fn twins_have_the_same_closed_forms() {
    for (book, parts, waves, observables, units) in TWINS {
        let (book, parts) =
            (Solution::new(stated(book)), Solution::new(derived(parts, observables)));
        let [one, two] = [&book, &parts].map(|solution| solution.recurrence().statement());
        assert_eq!(one.period, two.period);
        for [own, other] in waves {
            let own = book.recurrence().wave(own).expect("a wave");
            let other = parts.recurrence().wave(other).expect("a wave");
            let expected = book.pieces(own, 0, LAST).expect("pieces");
            let found = parts.pieces(other, 0, LAST).expect("pieces");
            assert!(renamed(&found, &two.local, &one.local) == expected, "{}", one.title);
        }
        for name in observables {
            let of = |solution: &Solution| {
                let seen = solution.recurrence().observation(name).expect("an observable");
                solution.observed(&seen, 0, LAST).expect("pieces")
            };
            let (expected, found) = (of(&book), of(&parts));
            assert_eq!(found.offset, expected.offset, "{}: {name}", one.title);
            let units = Rational::from_integer(units.into());
            let found = renamed(&found.pieces, &two.local, &one.local).into_iter();
            let found: Vec<Expression> = found.map(|piece| piece.scale(&units)).collect();
            assert!(found == expected.pieces, "{}: {name}", one.title);
        }
    }
}

/// The solution of each put into the equations of the other, as far as these know all of its waves.
#[test]
fn twins_satisfy_the_equations_of_each_other() {
    let through = 12;
    for (book, parts, waves, observables, _) in TWINS {
        let (book, parts) = (stated(book), derived(parts, observables));
        let (own, other) = (Solution::new(book.clone()), Solution::new(parts.clone()));
        let locals = [&book, &parts].map(|recurrence| recurrence.statement().local.clone());
        let into_book: Vec<Vec<Expression>> = (book.statement().waves.iter())
            .map(|name| {
                let [_, wave] = waves.iter().find(|pair| pair[0] == name).expect("in both");
                let pieces = other.pieces(parts.wave(wave).expect("a wave"), 0, through);
                renamed(&pieces.expect("pieces"), &locals[1], &locals[0])
            })
            .collect();
        assert_eq!(violation(&book, &into_book), None, "{}", book.statement().title);
        let into_parts = parts.statement().waves.iter().map(|name| {
            let [wave, _] = waves.iter().find(|pair| pair[1] == name)?;
            let pieces = own.pieces(book.wave(wave).expect("a wave"), 0, through);
            Some(renamed(&pieces.expect("pieces"), &locals[0], &locals[1]))
        });
        if let Some(pieces) = into_parts.collect::<Option<Vec<_>>>() {
            assert_eq!(violation(&parts, &pieces), None, "{}", book.statement().title);
        }
    }
}

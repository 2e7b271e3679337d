//! The parts of which sections are made: formulas, entries, checks, sequences.

use wavestep::expression::Expression;
use wavestep_polynomial::{Rational, Symbol};
use wavestep_studies::book::checks::{CHECKS, identity, run};
use wavestep_studies::book::latex::of_equation;
use wavestep_studies::book::sequence::Sequence;
use wavestep_studies::book::{Equation, Section};

#[test]
fn formulas_keep_the_order_in_which_they_were_read() {
    for (text, latex) in [
        ("f[1] = V/c*exp(-mu*z/L)", "f_{1} = \\frac{V}{c} e^{-\\mu z/L}"),
        ("a[n]' = -(1 - r)*a[n-1]/(1 + r)", "a_{n}' = -\\frac{(1 - r) a_{n-1}}{1 + r}"),
        ("x = (mu*z/L)^2", "x = \\left( \\frac{\\mu z}{L} \\right)^{2}"),
        ("x = t^2/2*(3 - a_0(mu))", "x = \\frac{t^{2}}{2} (3 - a_{0}(\\mu))"),
        ("x = 1/2 - sum(a[i], i < n)", "x = \\frac{1}{2} - \\sum_{i<n} a_{i}"),
        ("x = rho^n when r = 1", "x = \\rho^{n} \\quad \\text{for } r = 1"),
        ("x = Z_1^2*(-y)", "x = {Z_{1}}^{2} (-y)"),
    ] {
        assert_eq!(of_equation(&Equation::read(text).expect("an equation")), latex);
    }
}

#[test]
fn mistakes_in_sections_are_refused() {
    for text in [
        "  reads f[n] = 1",
        "chapter 6",
        "6.1 One.\n  proves f[n] = 1",
        "6.1 One.\n  reads f[n]",
        "6.1 One.\n  reads f[n] = 1 +",
        "6.1 One.\n  or f[n] = 1",
        "values mu = x",
    ] {
        assert!(Section::read(text).is_err(), "{text}");
    }
    let section = Section::read("section 6.0 None\n6.1 One\n    thing.\n  note It is\n    so.");
    let section = section.expect("a section");
    let entry = &section.entries[0];
    assert_eq!((entry.states.as_str(), entry.note.as_deref()), ("One thing.", Some("It is so.")));
}

#[test]
fn identities_hold_or_are_refused() {
    assert!(identity("(a + b)^2", "a^2 + 2*a*b + b^2").is_ok());
    assert!(identity("(a + b)^2", "a^2 + a*b + b^2").is_err());
    assert!(identity("cos(a) + cos(b)", "2*cos((a + b)/2)*cos((a - b)/2)").is_ok());
    assert!(identity("cos(a) + cos(b)", "-2*cos((a + b)/2)*cos((a - b)/2)").is_err());
}

#[test]
fn every_name_has_its_check() {
    for (name, check) in CHECKS {
        assert!(check().is_ok(), "{name}");
    }
    assert!(run("nothing").is_err());
}

#[test]
fn sequences_are_equal_when_their_terms_are() {
    let [n, x] = ["n", "x"].map(|name| Expression::symbol(&Symbol::new(name).expect("a name")));
    let one = Sequence::term(x.clone(), n.clone());
    let two = Sequence::term(x.clone(), &n + &Expression::one());
    let difference = one.plus(&two.negated());
    assert!(!difference.is_zero());
    assert!(difference.plus(&Sequence::term(x.clone(), Expression::one())).is_zero());
    assert_eq!(two.value(3), Some(x.pow(3).scale(&Rational::from_integer(4.into()))));
    assert_eq!(one.times(&two).value(2), Some(x.pow(4).scale(&Rational::from_integer(6.into()))));
}

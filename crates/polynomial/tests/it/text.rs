//! What is printed reads back; what is no polynomial is refused at the right place, quickly.

use crate::support::*;
use proptest::prelude::*;
use std::fmt::Write;
use wavestep_polynomial::{Expected, Polynomial, Symbol};

proptest! {
    #[test]
    fn printing_reads_back(p in polynomials()) {
        prop_assert_eq!(p.to_string().parse().map(valid), Ok(p.clone()));
        prop_assert_eq!(format!("{p:?}"), p.to_string());
    }

    #[test]
    fn reading_is_adding_and_multiplying(terms in terms()) {
        let mut text = String::from("0");
        for (coefficient, powers) in &terms {
            write!(text, " + 3*{}/7", coefficient.numer().magnitude()).unwrap();
            for (x, e) in powers {
                write!(text, " * {x} ^\t{e}").unwrap();
            }
        }
        let sum = terms.iter().map(|(coefficient, powers)| {
            let size = wavestep_polynomial::Integer::from(coefficient.numer().magnitude().clone());
            let coefficient = wavestep_polynomial::Rational::new(size * 3, 7.into());
            monomial(&(coefficient, powers.clone()))
        });
        prop_assert_eq!(text.parse().map(valid), Ok(sum.sum::<Polynomial>()));
    }

    #[test]
    fn any_text_is_read_or_refused(text in "[ab0-9+*/^ -]{0,40}|\\PC{0,20}") {
        match text.parse::<Polynomial>() {
            Ok(p) => prop_assert_eq!(valid(p.clone()).to_string().parse(), Ok(p)),
            Err(error) => prop_assert!(text.is_char_boundary(error.offset), "{}", error),
        }
    }

    #[test]
    fn names_are_read_whole(name in "\\PC{0,6}") {
        match Symbol::new(&name) {
            Some(x) => prop_assert_eq!(name.parse(), Ok(Polynomial::symbol(&x))),
            None => {
                let p: Polynomial = name.parse().unwrap_or_default();
                prop_assert!(p.symbols().iter().all(|x| x.name() != name));
            }
        }
    }
}

#[test]
fn printed_form() {
    let same = [
        "0",
        "1",
        "-1",
        "-1/2",
        "x",
        "-x",
        "2*x^2 - x*y + 3/4",
        "-3/2*mu^2*s + mu - 1",
        "a^12*b + a^12 - b^13",
    ];
    for text in same {
        assert_eq!(read(text).to_string(), text);
    }
    let ordered = [
        ("y + x + x^2 + x*y", "x^2 + x*y + x + y"),
        ("1 + s*mu*s", "mu*s^2 + 1"),
        (" 2/4 * x ^ 2*3 ", "3/2*x^2"),
        ("x - x", "0"),
        ("-0*x^9", "0"),
        ("x^0", "1"),
        ("007*x^02*3", "21*x^2"),
        ("Ω*ñ_1", "ñ_1*Ω"),
    ];
    for (text, printed) in ordered {
        assert_eq!(read(text).to_string(), printed);
    }
}

#[test]
fn refused_texts() {
    use Expected::{Denominator, Exponent, Factor, Operator};
    let refused = [
        ("", 0, Factor),
        ("  ", 2, Factor),
        ("+x", 0, Factor),
        ("- -x", 2, Factor),
        ("x +", 3, Factor),
        ("x*", 2, Factor),
        ("2**x", 2, Factor),
        ("_x", 0, Factor),
        ("1/0", 2, Denominator),
        ("1/ x", 3, Denominator),
        ("1/", 2, Denominator),
        ("x^", 2, Exponent),
        ("x^-1", 2, Exponent),
        ("x^ 4096", 3, Exponent),
        ("x^99999999999999999999", 2, Exponent),
        ("2 + x^4095*y*x", 14, Exponent),
        ("x^4000*x^4000", 9, Exponent),
        ("2x", 1, Operator),
        ("x y", 2, Operator),
        ("(x)", 0, Factor),
        ("x^2^3", 3, Operator),
        ("x/2", 1, Operator),
        ("π + 1.5", 6, Operator),
    ];
    for (text, offset, expected) in refused {
        let error = text.parse::<Polynomial>().expect_err(text);
        assert_eq!((error.offset, error.expected), (offset, expected), "{text}");
        assert!(error.to_string().starts_with(&format!("at byte {offset}: expected ")), "{error}");
    }
}

#[test]
fn hostile_texts_end_soon() {
    let refused = ["x^2147483647", "x^4294967295*x^4294967295"];
    assert!(refused.iter().all(|text| text.parse::<Polynomial>().is_err()));
    assert_eq!(read("x^4095").degree(&symbol("x")), Polynomial::MAX_EXPONENT);

    let many = |count: u32, part: &dyn Fn(u32) -> String, between: &str| {
        read(&(0..count).map(part).collect::<Vec<_>>().join(between))
    };
    assert_eq!(
        many(20_000, &|i| format!("x^{}*y^{}", i % 4000, i / 4000), "+").term_count(),
        20_000
    );
    assert_eq!(many(40_000, &|_| "x".into(), "-"), read("-39998*x"));
    assert_eq!(many(4_095, &|_| "x".into(), "*").total_degree(), 4_095);
    assert_eq!(many(5_000, &|_| "3/2*2/3".into(), "*"), Polynomial::one());
    assert_eq!(many(300, &|i| format!("a{i}"), "+").symbols().len(), 300);
    assert_eq!(many(300, &|i| format!("1/{}", i + 1), "+").symbols().len(), 0);
    assert_eq!(
        read(&"9".repeat(20_000)),
        read(&format!("{} - 1", "1".to_owned() + &"0".repeat(20_000)))
    );
}

#[test]
fn symbols_are_ordered_by_name() {
    assert_eq!(read("z*b*a*a_1").to_string(), "a*a_1*b*z");
    assert_eq!(symbol("mu").to_string(), "mu");
    assert_eq!(format!("{:?}", symbol("mu")), "mu");
    assert!(["", "1", "_", "a-b", "a b"].iter().all(|name| Symbol::new(name).is_none()));
}

#[test]
fn errors_say_what_was_expected_and_where() {
    let error = "x + 3/0".parse::<Polynomial>().unwrap_err();
    assert_eq!(error.to_string(), "at byte 6: expected a denominator other than zero");
}

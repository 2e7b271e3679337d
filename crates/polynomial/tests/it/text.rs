//! What is printed reads back, in one order.

use crate::support::*;
use proptest::prelude::*;
use wavestep_polynomial::Symbol;

proptest! {
    #[test]
    fn printing_reads_back(p in polynomials()) {
        prop_assert_eq!(read(&p.to_string()), p.clone());
        prop_assert_eq!(format!("{p:?}"), p.to_string());
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
fn symbols_are_ordered_by_name() {
    assert_eq!(read("z*b*a*a_1").to_string(), "a*a_1*b*z");
    assert_eq!(symbol("mu").to_string(), "mu");
    assert_eq!(format!("{:?}", symbol("mu")), "mu");
    assert!(["", "1", "_", "a-b", "a b"].iter().all(|name| Symbol::new(name).is_none()));
}

//! The example of the README: a scene, its fourth piece as LaTeX, and thirty digits.

use std::collections::BTreeMap;
use wavestep::evaluate::{ClosedSignal, Limit, digits};
use wavestep::export::{Formula, Head, LATEX_WIDTH, latex};
use wavestep::language::{Source, parse_number, read_expression, read_recurrence};
use wavestep::solution::Solution;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = wavestep::scenes::find("rigid-mass").ok_or("a built-in scene")?;
    let source = Source::new(scene.name, scene.text)?;
    let solution = Solution::new(read_recurrence(&source, &BTreeMap::new())?);
    let f = solution.recurrence().wave("f").ok_or("a wave of the scene")?;

    // Exact: equality is decided, not estimated.
    let f_1 = Source::new("6.80", "exp(-s)*(-2*s + 1 + exp(-2*mu))")?;
    assert_eq!(solution.pieces(f, 1, 1)?, [read_expression(&f_1)?]);

    // As LaTeX, for any order.
    let s = &solution.recurrence().statement().local;
    let head = Head::Piece { wave: "f".to_owned(), n: 4, local: s.clone() };
    let f_4 = Formula::new(head, &solution.pieces(f, 4, 4)?[0], s);
    println!("{}", latex(&[f_4], LATEX_WIDTH));

    // As a number: values are put in before anything is derived, and every digit is proven.
    let values = BTreeMap::from([("mu".to_owned(), parse_number("1/4")?)]);
    let solution = Solution::new(read_recurrence(&source, &values)?);
    let f = solution.recurrence().observation("f").ok_or("a wave of the scene")?;
    let time = parse_number("33/10")?;
    let signal = ClosedSignal::of_recurrence(&solution, &f, [&time, &time])?;
    let value = digits(&signal, &time, Limit::Right, 30, 1 << 16)?;
    assert_eq!(value.to_text(30), "0.305385264408791064086396952466");
    Ok(())
}

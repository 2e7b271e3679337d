use std::time::Instant;
use wavestep::evaluate::*;
use wavestep::language::{Source, parse_number, read_recurrence};
use wavestep::solution::Solution;
fn main() {
    let text = wavestep::scenes::find("rigid-mass").unwrap().text;
    for (mu, last) in [("1", "20"), ("1", "100"), ("1/4", "20")] {
        let values = [("mu".to_owned(), parse_number(mu).unwrap())].into();
        let solution = Solution::new(
            read_recurrence(&Source::new("rigid-mass", text).unwrap(), &values).unwrap(),
        );
        let f = solution.recurrence().observation("f").unwrap();
        let signal = Signal::of_recurrence(solution.recurrence(), &f).unwrap();
        let evaluator = Evaluator::new(&solution).unwrap();
        let recognise = |at: &_, side| evaluator.rational(&f, at, side);
        let (from, to) = (parse_number("0").unwrap(), parse_number(last).unwrap());
        let t = Instant::now();
        let compiled = Compiled::new(&signal, &from, &to, None).unwrap();
        println!("mu {mu} to {last}: compiled {:?} {}", t.elapsed(), compiled.law());
        let t = Instant::now();
        let certified = Certified::new(&signal, &from, &to, &recognise).unwrap();
        let table = certified.table().unwrap();
        println!(
            "  certified {:?} pieces {} bound {:e}",
            t.elapsed(),
            table.pieces(),
            table.certified_bound()
        );
        let n = 100_000;
        let end: f64 = last.parse().unwrap();
        let times: Vec<f64> = (0..n).map(|i| end * (i as f64 + 0.5) / n as f64).collect();
        let (mut a, mut b) = (vec![0.0; n], vec![0.0; n]);
        compiled.values(&times, &mut a).unwrap();
        let t = Instant::now();
        certified.values(&times, &mut b).unwrap();
        let e = t.elapsed();
        let worst = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("  worst {worst:e} ({:?} for certified)", e);
    }
}

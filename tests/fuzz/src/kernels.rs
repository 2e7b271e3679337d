//! Doubles of piecewise polynomials against the rational values of the same polynomials.

use crate::bytes::Bytes;
use num_rational::BigRational;
use num_traits::{Signed as _, Zero as _};
use wavestep_kernels::{Level, Piece, Table};

/// Doubles beyond this have exact values that only take long.
fn is_moderate(value: f64) -> bool {
    value == 0.0 || (1e-60..1e60).contains(&value.abs())
}

fn exactly(value: f64) -> BigRational {
    BigRational::from_float(value).expect("finite")
}

/// The polynomial of a piece.
fn value(piece: &Piece, time: f64) -> BigRational {
    let u = (exactly(time) - exactly(piece.centre)) * exactly(piece.scale);
    let low = |k: usize| exactly(piece.low.get(k).copied().unwrap_or(0.0));
    let terms = piece.coefficients.iter().enumerate().rev();
    terms.fold(BigRational::zero(), |sum, (k, c)| sum * &u + exactly(*c) + low(k))
}

/// Pieces one after the other, with scales that fit.
fn pieces(bytes: &mut Bytes<'_>) -> (Vec<Piece>, f64) {
    let mut start = bytes.double();
    let count = 1 + bytes.below(5);
    let mut pieces = Vec::new();
    for _ in 0..count {
        let next = (start + bytes.double().abs()).max(start.next_up());
        let centre = match bytes.below(3) {
            0 => 0.0,
            1 => start,
            _ => start + (next - start) / 2.0,
        };
        let half = (centre - start).abs().max((next - centre).abs());
        let scale = 2.0_f64.powi(-(half.log2().ceil() as i32) - bytes.below(3) as i32);
        let degree = bytes.below(9) as usize;
        let coefficients: Vec<f64> = (0..=degree).map(|_| bytes.double()).collect();
        let low = coefficients.iter().take(bytes.below(10) as usize);
        let low = low.map(|c| c * 2.0_f64.powi(-53)).collect();
        pieces.push(Piece { start, centre, scale, coefficients, low, error: 0.0 });
        start = next;
    }
    (pieces, start)
}

pub fn kernels(data: &[u8]) {
    let mut bytes = Bytes(data);
    let (pieces, end) = pieces(&mut bytes);
    let Ok(table) = Table::new(&pieces, end) else { return };
    let numbers = |piece: &Piece| {
        let others = [piece.start, piece.centre, piece.scale];
        others
            .into_iter()
            .chain(piece.coefficients.clone())
            .chain(piece.low.clone())
            .all(is_moderate)
    };
    if !pieces.iter().all(numbers) {
        return;
    }
    let mut times = vec![end, end.next_down(), pieces[0].start.next_up(), f64::NAN, f64::INFINITY];
    times.extend(
        pieces.iter().flat_map(|piece| [piece.start, piece.start.next_down(), piece.centre]),
    );
    let share = |bytes: &mut Bytes<'_>| bytes.word() as f64 / 2.0_f64.powi(64);
    times.extend((0..9).map(|_| pieces[0].start + (end - pieces[0].start) * share(&mut bytes)));
    let is_inside = |time: f64| pieces[0].start <= time && time <= end;
    let exact: Vec<Option<BigRational>> = times
        .iter()
        .map(|&time| {
            let piece = pieces.partition_point(|piece| piece.start <= time).checked_sub(1)?;
            is_inside(time).then(|| value(&pieces[piece], time))
        })
        .collect();
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
    let mut fused = None;
    for level in Level::available() {
        let evaluator = table.evaluator().with_level(level);
        let mut all = [(); 2].map(|()| vec![0.0; times.len()]);
        let [plain, rounded] = &mut all;
        assert_eq!(evaluator.values(&times, plain), times.iter().all(|&time| is_inside(time)));
        let undecided = evaluator.rounded(&times, rounded);
        for (i, &time) in times.iter().enumerate() {
            let (mut one, mut rounded_one) = ([0.0], [0.0]);
            evaluator.values(&[time], &mut one);
            let is_decided = evaluator.rounded(&[time], &mut rounded_one).is_empty();
            assert_eq!(is_decided, undecided.binary_search(&i).is_err());
            assert_eq!(bits(&[plain[i], rounded[i]]), bits(&[one[0], rounded_one[0]]));
        }
        for (i, exact) in exact.iter().enumerate() {
            let Some(exact) = exact else {
                assert!(plain[i].is_nan() && rounded[i].is_nan(), "{:e}", times[i]);
                continue;
            };
            let error = (exactly(plain[i]) - exact).abs();
            assert!(error <= exactly(table.bound()), "{level:?} at {:e}: {:e}", times[i], plain[i]);
            let away = |double: f64| (exactly(double) - exact).abs();
            let nearest = away(rounded[i]);
            let is_nearest = [rounded[i].next_up(), rounded[i].next_down()].map(away);
            if undecided.binary_search(&i).is_err() {
                assert!(is_nearest.iter().all(|other| nearest <= *other), "{level:?} {i}");
            }
        }
        if level > Level::Baseline {
            let fused = fused.get_or_insert_with(|| (bits(plain), bits(rounded)));
            assert_eq!(*fused, (bits(plain), bits(rounded)), "AVX2 and AVX-512 differ");
        }
    }
}

//! Names where lines end: beside the plotting area where a line reaches its edge, else beside the end.

use super::drawing::{Anchor, SMALL, WIDTH};
use super::layout::{Sheet, label_size};
use super::placement::Placement;

/// How far names are from the edge of the plotting area, and their rows from one another.
const GAP: f64 = 8.0;
const ROW: f64 = 14.0;

/// The right edge of a plotting area beside which these names have room.
pub(super) fn room_beside<'a>(names: impl Iterator<Item = &'a str>) -> f64 {
    let widest = names.map(|name| label_size(name).0).fold(0.0, f64::max);
    WIDTH - 14.0 - GAP - widest
}

/// Draws the names of lines at their ends; how many found no place.
pub(super) fn draw_ends(
    ends: &[((f64, f64), &str)],
    sheet: &mut Sheet,
    placement: &mut Placement,
) -> usize {
    type End<'a> = ((f64, f64), &'a str);
    let (mut beside, within): (Vec<End<'_>>, Vec<End<'_>>) =
        ends.iter().partition(|end| end.0.0 >= sheet.right - 2.0);
    beside.sort_by(|a, b| a.0.1.total_cmp(&b.0.1));
    let wanted: Vec<f64> = beside.iter().map(|(end, _)| end.1).collect();
    let rows = apart(&wanted, ROW, (sheet.top + ROW / 2.0, sheet.bottom() - ROW / 2.0));
    for (((x, y), name), row) in beside.iter().zip(&rows) {
        if (row - y).abs() > 2.0 {
            sheet.drawing.line("tick", (*x, *y), (sheet.right + GAP - 2.0, *row));
        }
        let base = (sheet.right + GAP, row + 0.35 * SMALL);
        sheet.drawing.text("label", Anchor::Start, base, name);
    }
    let mut unlabelled = 0;
    for (end, name) in within {
        unlabelled += sheet.label(placement.beside(end, label_size(name)), name);
    }
    unlabelled
}

/// Heights near those wanted, which ascend, at least `row` apart and within the ends where there is room:
/// runs that touch are shared out evenly about their middle.
fn apart(wanted: &[f64], row: f64, (low, high): (f64, f64)) -> Vec<f64> {
    // Runs as (middle, count), merged from above while they overlap.
    let mut runs: Vec<(f64, usize)> = Vec::new();
    let half = |count: usize| (count - 1) as f64 * row / 2.0;
    let inside = |middle: f64, count: usize| {
        let room = half(count);
        if high - low < 2.0 * room { middle } else { middle.clamp(low + room, high - room) }
    };
    for &height in wanted {
        runs.push((inside(height, 1), 1));
        while let [.., (above, m), (below, n)] = runs[..]
            && below - half(n) - above - half(m) < row
        {
            runs.truncate(runs.len() - 2);
            let count = m + n;
            let middle = (above * m as f64 + below * n as f64) / count as f64;
            runs.push((inside(middle, count), count));
        }
    }
    let heights = |(middle, count): (f64, usize)| {
        (0..count).map(move |i| middle - half(count) + i as f64 * row)
    };
    runs.into_iter().flat_map(heights).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_stay_apart_and_near() {
        let wanted = [10.0, 50.0, 51.0, 52.0, 90.0, 119.0, 120.0];
        let found = apart(&wanted, 14.0, (7.0, 113.0));
        assert!(found.windows(2).all(|pair| pair[1] - pair[0] >= 14.0 - 1e-9), "{found:?}");
        assert!(found.iter().all(|y| (7.0..=113.0).contains(y)), "{found:?}");
        assert_eq!((found[0], found[2]), (10.0, 51.0));
        assert_eq!(apart(&[30.0, 80.0], 14.0, (0.0, 100.0)), [30.0, 80.0]);
    }
}

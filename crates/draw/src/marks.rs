//! Marked places: vertical lines with labels above the plotting area, horizontal ones with labels in it.

use super::axis::Mapping;
use super::drawing::{Anchor, WIDTH};
use super::layout::{LEFT, Sheet, label_size};
use super::placement::Placement;

/// The left edges of the labels of vertical lines, and the rows in which they stand, counted
/// upwards from the plotting area.
///
/// A label begins at its line, which ends below it, and stands higher than the labels of all lines
/// that it would cross. Where it would leave the picture it moves to the left.
fn rows_of(marks: &[(f64, &str)]) -> Vec<(f64, usize)> {
    let mut order: Vec<usize> = (0..marks.len()).collect();
    order.sort_by(|&i, &j| marks[j].0.total_cmp(&marks[i].0));
    let mut rows = vec![(0.0, 0); marks.len()];
    for (done, &i) in order.iter().enumerate() {
        let (x, name) = marks[i];
        let wide = label_size(name).0;
        let left = (x - 3.0).min(WIDTH - 14.0 - wide).max(LEFT);
        let crossed = order[..done].iter().filter(|&&j| marks[j].0 <= left + wide + 8.0);
        rows[i] = (left, crossed.map(|&j| rows[j].1 + 1).max().unwrap_or(0));
    }
    rows
}

const ROW: f64 = 15.0;

/// The room that the labels of vertical lines take above the plotting area.
pub(super) fn room_above(marks: &[(f64, String)], x: &Mapping) -> f64 {
    ROW * rows_of(&placed(marks, x)).iter().map(|(_, row)| row + 1).max().unwrap_or(0) as f64
}

fn placed<'a>(marks: &'a [(f64, String)], x: &Mapping) -> Vec<(f64, &'a str)> {
    marks.iter().map(|(at, name)| (x.position(*at), name.as_str())).collect()
}

/// The vertical lines with their labels above the plotting area.
pub(super) fn draw_marks(marks: &[(f64, String)], sheet: &mut Sheet, x: &Mapping) {
    let marks = placed(marks, x);
    let rows = rows_of(&marks);
    let (top, bottom) = (sheet.top, sheet.bottom());
    let base = |row: usize| top - 6.0 - ROW * row as f64;
    for ((x, _), (_, row)) in marks.iter().zip(&rows) {
        sheet.drawing.line("rule-across", (*x, base(*row) + 3.0), (*x, bottom));
    }
    for ((_, name), (left, row)) in marks.iter().zip(&rows) {
        sheet.drawing.text("label", Anchor::Start, (left + 1.0, base(*row)), name);
    }
}

/// The horizontal lines with their labels, where curves and marks leave room; how many found none.
pub(super) fn draw_levels(
    levels: &[(f64, String)],
    sheet: &mut Sheet,
    y: &Mapping,
    placement: &mut Placement,
) -> usize {
    let mut unlabelled = 0;
    for (level, name) in levels {
        let y = y.position(*level);
        sheet.drawing.line("rule", (LEFT, y), (sheet.right, y));
        let size @ (wide, high) = label_size(name);
        let room = sheet.right - LEFT - 16.0 - wide;
        let along = (0..=12).map(|step| sheet.right - 8.0 - wide - room * f64::from(step) / 12.0);
        let tries: Vec<(f64, f64)> =
            along.flat_map(|x| [(x, y - 3.0 - high), (x, y + 3.0)]).collect();
        unlabelled += sheet.label(placement.first_free(&tries, size), name);
    }
    unlabelled
}

/// What labels inside of the plotting area avoid, and where they stay.
pub(super) fn placement_in(sheet: &Sheet, marks: &[(f64, String)], x: &Mapping) -> Placement {
    let mut placement =
        Placement::within([(LEFT + 2.0, sheet.top), (sheet.right - 2.0, sheet.bottom())]);
    for (at, _) in marks {
        let x = x.position(*at);
        placement.avoid(&[(x, sheet.top), (x, sheet.bottom())]);
    }
    placement
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_above_take_rows_without_overlap() {
        let marks = [
            (649.0, "last"),
            (100.0, "first arrival"),
            (110.0, "second arrival"),
            (120.0, "x"),
            (
                400.0,
                "one with a long name that does not fit between its line and the edge of the sheet",
            ),
        ];
        let rows = rows_of(&marks);
        assert_eq!(rows.iter().map(|(_, row)| *row).collect::<Vec<_>>(), [0, 2, 1, 0, 1]);
        for ((_, name), (left, _)) in marks.iter().zip(&rows) {
            assert!(*left >= LEFT && left + label_size(name).0 <= WIDTH);
        }
    }
}

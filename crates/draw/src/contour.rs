//! Step lines on a grid of cells: where neighbours lie on different sides of a level.

use std::collections::BTreeMap;

/// A corner of the grid: column and row, from 0 to their number.
pub(super) type Corner = (usize, usize);

/// The lines along the sides between two neighbouring cells of which one lies below (`Some(true)`)
/// and one does not (`Some(false)`); nothing is known of cells that are `None`, and no line borders
/// them.
///
/// `below(column, row)` is asked for each cell of the grid. Each side stands in one line, once; a
/// line goes on as long as there are sides. Cost: O(cells · log cells).
pub(super) fn step_lines(
    columns: usize,
    rows: usize,
    below: impl Fn(usize, usize) -> Option<bool>,
) -> Vec<Vec<Corner>> {
    let differ = |a: Option<bool>, b: Option<bool>| matches!((a, b), (Some(a), Some(b)) if a != b);
    let mut sides: BTreeMap<Corner, Vec<Corner>> = BTreeMap::new();
    let mut add = |a: Corner, b: Corner| {
        sides.entry(a).or_default().push(b);
        sides.entry(b).or_default().push(a);
    };
    for row in 0..rows {
        for column in 0..columns {
            let here = below(column, row);
            if column + 1 < columns && differ(here, below(column + 1, row)) {
                add((column + 1, row), (column + 1, row + 1));
            }
            if row + 1 < rows && differ(here, below(column, row + 1)) {
                add((column, row + 1), (column + 1, row + 1));
            }
        }
    }
    let mut lines = Vec::new();
    loop {
        // A line begins where an odd number of sides meet, else anywhere: then it closes.
        let odd = sides.iter().find(|(_, ends)| ends.len() % 2 == 1);
        let Some(&start) = odd.or_else(|| sides.iter().next()).map(|(corner, _)| corner) else {
            return lines;
        };
        let mut line = vec![start];
        let mut at = start;
        while let Some(next) = sides.get(&at).and_then(|ends| ends.first().copied()) {
            remove(&mut sides, at, next);
            remove(&mut sides, next, at);
            // Corners along a straight run are passed over.
            if let [.., before, last] = line[..]
                && (before.0 == last.0 && last.0 == next.0
                    || before.1 == last.1 && last.1 == next.1)
            {
                line.pop();
            }
            line.push(next);
            at = next;
        }
        lines.push(line);
    }
}

fn remove(sides: &mut BTreeMap<Corner, Vec<Corner>>, from: Corner, to: Corner) {
    if let Some(ends) = sides.get_mut(&from) {
        if let Some(i) = ends.iter().position(|end| *end == to) {
            ends.remove(i);
        }
        if ends.is_empty() {
            sides.remove(&from);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_run_between_cells() {
        // Rows from below: ..x / .xx / xxx, with x at or above the level.
        let lines = step_lines(3, 3, |column, row| Some(column + row < 2));
        assert_eq!(lines, [vec![(0, 2), (1, 2), (1, 1), (2, 1), (2, 0)]]);
    }

    #[test]
    fn an_island_is_closed_and_unknown_cells_have_no_border() {
        let island = step_lines(3, 3, |column, row| Some((column, row) != (1, 1)));
        assert_eq!(island.len(), 1);
        assert_eq!(island[0].first(), island[0].last());
        let unknown = |column, _| [Some(true), None, Some(false)][column];
        assert!(step_lines(3, 4, unknown).is_empty());
    }

    /// Every side between cells of different kind is drawn once, and no other.
    #[test]
    fn sides_are_complete() {
        let below = |column: usize, row: usize| match (column * 7 + row * 5) % 11 {
            10 => None,
            rest => Some(rest < 5),
        };
        let mut expected = 0;
        for column in 0..9usize {
            for row in 0..8usize {
                let differ =
                    |other| matches!((below(column, row), other), (Some(a), Some(b)) if a != b);
                expected += usize::from(column < 8 && differ(below(column + 1, row)));
                expected += usize::from(row < 7 && differ(below(column, row + 1)));
            }
        }
        let length =
            |pair: &[Corner]| pair[0].0.abs_diff(pair[1].0) + pair[0].1.abs_diff(pair[1].1);
        let lines = step_lines(9, 8, below);
        let drawn: usize = lines.iter().flat_map(|line| line.windows(2).map(length)).sum();
        assert_eq!(drawn, expected);
        assert!(expected > 30);
    }
}

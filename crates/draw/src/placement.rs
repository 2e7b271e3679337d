//! Places for labels beside their points, without overlap.

/// A rectangle by its corners: left and top, right and bottom.
pub(super) type Corners = [(f64, f64); 2];

/// The size of a label: how wide and how high.
type Size = (f64, f64);

/// Areas of a picture that are occupied, and lines that labels should stay off.
///
/// # Invariants
/// No two labels placed overlap, and none overlaps a marker or leaves the area.
pub(super) struct Placement {
    area: Corners,
    taken: Vec<Corners>,
    /// Segments of lines: crossing one is allowed, but avoided.
    segments: Vec<[(f64, f64); 2]>,
}

impl Placement {
    pub fn within(area: Corners) -> Placement {
        Placement { area, taken: Vec::new(), segments: Vec::new() }
    }

    /// Keeps a rectangle free of labels.
    pub fn take(&mut self, corners: Corners) {
        self.taken.push(corners);
    }

    /// Lets labels avoid the line through these points.
    pub fn avoid(&mut self, points: &[(f64, f64)]) {
        self.segments.extend(points.windows(2).map(|pair| [pair[0], pair[1]]));
    }

    /// The left upper corner for a label of this size beside a point, and takes its place; `None`
    /// where all is full. Cost: O(places · (labels + segments)), with 24 places tried.
    pub fn beside(&mut self, at: (f64, f64), size: Size) -> Option<(f64, f64)> {
        self.first_free(&around(at, size, &[7.0, 10.0, 15.0]), size)
    }

    /// The same where no line is crossed, a little further away if need be; `None` where a label would
    /// lie on a line everywhere.
    pub fn clear_beside(&mut self, at: (f64, f64), size: Size) -> Option<(f64, f64)> {
        let places = around(at, size, &[7.0, 10.0, 15.0, 20.0]);
        let clear = |place: &&(f64, f64)| {
            let label = corners(**place, size);
            self.is_free(label) && self.crossings(label) == 0
        };
        let place = *places.iter().find(clear)?;
        self.taken.push(corners(place, size));
        Some(place)
    }

    /// The first of the places that is free and crosses the fewest lines, and takes it.
    pub fn first_free(&mut self, places: &[(f64, f64)], size: Size) -> Option<(f64, f64)> {
        let free = |place: &&(f64, f64)| self.is_free(corners(**place, size));
        let crossings = |place: &&(f64, f64)| self.crossings(corners(**place, size));
        // The first of equals is taken: `min_by_key` keeps it.
        let place = *places.iter().filter(free).min_by_key(crossings)?;
        self.taken.push(corners(place, size));
        Some(place)
    }

    fn is_free(&self, label: Corners) -> bool {
        inside(label, self.area) && !self.taken.iter().any(|taken| overlap(*taken, label))
    }

    /// How many segments of lines a label would lie on.
    fn crossings(&self, label: Corners) -> usize {
        self.segments.iter().filter(|segment| crosses(**segment, label)).count()
    }
}

fn corners((left, top): (f64, f64), (wide, high): Size) -> Corners {
    [(left, top), (left + wide, top + high)]
}

/// Left upper corners of labels about a point, the nearest first: eight for each gap.
fn around((x, y): (f64, f64), (wide, high): Size, gaps: &[f64]) -> Vec<(f64, f64)> {
    let mut places = Vec::new();
    for gap in gaps {
        let slant = 0.6 * gap;
        places.extend([
            (x + gap, y - high / 2.0),
            (x - gap - wide, y - high / 2.0),
            (x - wide / 2.0, y - gap - high),
            (x - wide / 2.0, y + gap),
            (x + slant, y - slant - high),
            (x - slant - wide, y - slant - high),
            (x + slant, y + slant),
            (x - slant - wide, y + slant),
        ]);
    }
    places
}

fn inside(label: Corners, area: Corners) -> bool {
    label[0].0 >= area[0].0
        && label[0].1 >= area[0].1
        && label[1].0 <= area[1].0
        && label[1].1 <= area[1].1
}

fn overlap(a: Corners, b: Corners) -> bool {
    a[0].0 < b[1].0 && b[0].0 < a[1].0 && a[0].1 < b[1].1 && b[0].1 < a[1].1
}

/// Whether a segment meets a rectangle.
fn crosses(segment: [(f64, f64); 2], [(left, top), (right, bottom)]: Corners) -> bool {
    part_inside(segment, [(left, right), (top, bottom)]).is_some()
}

/// The part of a segment between two sides across and two up, from and to which share of its length; `None`
/// where it is empty.
pub(super) fn part_inside(
    [from, to]: [(f64, f64); 2],
    [across, up]: [(f64, f64); 2],
) -> Option<(f64, f64)> {
    let (mut start, mut end) = (0.0f64, 1.0f64);
    for ((from, to), (low, high)) in [((from.0, to.0), across), ((from.1, to.1), up)] {
        if from == to {
            if from < low || from > high {
                return None;
            }
            continue;
        }
        let (a, b) = ((low - from) / (to - from), (high - from) / (to - from));
        (start, end) = (start.max(a.min(b)), end.min(a.max(b)));
    }
    (start <= end).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_never_overlap() {
        let area = [(0.0, 0.0), (200.0, 120.0)];
        let mut placement = Placement::within(area);
        placement.avoid(&[(0.0, 60.0), (200.0, 60.0)]);
        let (mut placed, mut refused) = (Vec::new(), 0);
        for i in 0..40 {
            let point = (f64::from(i * 37 % 200), f64::from(i * 53 % 120));
            match placement.beside(point, (40.0, 12.0)) {
                Some((x, y)) => placed.push([(x, y), (x + 40.0, y + 12.0)]),
                None => refused += 1,
            }
        }
        assert!(placed.len() > 10 && refused > 5, "{} placed, {refused} refused", placed.len());
        for (i, label) in placed.iter().enumerate() {
            assert!(inside(*label, area));
            assert!(placed[..i].iter().all(|other| !overlap(*label, *other)));
        }
    }

    #[test]
    fn crossings_are_seen_and_avoided() {
        let label = [(10.0, 10.0), (20.0, 20.0)];
        assert!(crosses([(0.0, 0.0), (30.0, 30.0)], label));
        assert!(crosses([(12.0, 12.0), (13.0, 12.0)], label));
        assert!(!crosses([(0.0, 25.0), (30.0, 25.0)], label));
        assert!(!crosses([(0.0, 15.0), (9.0, 15.0)], label));
        assert!(!crosses([(0.0, 12.0), (8.0, 40.0)], label));
        let mut placement = Placement::within([(0.0, 0.0), (200.0, 100.0)]);
        placement.avoid(&[(50.0, 50.0), (200.0, 50.0)]);
        let (x, _) = placement.beside((50.0, 50.0), (20.0, 10.0)).expect("room");
        assert!(x < 50.0);
        // Between close lines a label is left out rather than laid on them.
        let lines = (0..20).map(|i| 5.0 * f64::from(i));
        lines.for_each(|y| placement.avoid(&[(0.0, y), (200.0, y)]));
        assert_eq!(placement.clear_beside((120.0, 50.0), (20.0, 10.0)), None);
        assert!(placement.beside((120.0, 50.0), (20.0, 10.0)).is_some());
    }
}

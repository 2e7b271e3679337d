//! Places for labels beside their points, without overlap.

/// A rectangle by its corners: left and top, right and bottom.
pub(super) type Corners = [(f64, f64); 2];

/// What is taken in a picture, and what had better not be covered.
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
    pub fn beside(&mut self, (x, y): (f64, f64), wide: f64, high: f64) -> Option<(f64, f64)> {
        let mut places = Vec::new();
        for gap in [7.0, 10.0, 15.0] {
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
        self.first_free(&places, wide, high)
    }

    /// The first of the places that is free and crosses the fewest lines, and takes it.
    pub fn first_free(
        &mut self,
        places: &[(f64, f64)],
        wide: f64,
        high: f64,
    ) -> Option<(f64, f64)> {
        let corners = |&(left, top): &(f64, f64)| [(left, top), (left + wide, top + high)];
        let free = |place: &&(f64, f64)| {
            let label = corners(place);
            inside(label, self.area) && !self.taken.iter().any(|taken| overlap(*taken, label))
        };
        let crossings = |place: &&(f64, f64)| {
            let label = corners(place);
            self.segments.iter().filter(|segment| crosses(**segment, label)).count()
        };
        // The first of equals is taken: `min_by_key` keeps it.
        let place = *places.iter().filter(free).min_by_key(crossings)?;
        self.taken.push(corners(&place));
        Some(place)
    }
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

/// Whether a segment meets a rectangle: the part of it inside both pairs of sides is not empty.
fn crosses([from, to]: [(f64, f64); 2], label: Corners) -> bool {
    let (mut start, mut end) = (0.0f64, 1.0f64);
    for (from, to, low, high) in
        [(from.0, to.0, label[0].0, label[1].0), (from.1, to.1, label[0].1, label[1].1)]
    {
        let along = to - from;
        if along == 0.0 {
            if from < low || from > high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - from) / along, (high - from) / along);
        start = start.max(a.min(b));
        end = end.min(a.max(b));
    }
    start <= end
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
            match placement.beside(point, 40.0, 12.0) {
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
        let (x, _) = placement.beside((50.0, 50.0), 20.0, 10.0).expect("room");
        assert!(x < 50.0);
    }
}

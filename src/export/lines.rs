//! Breaking long formulas into lines, at signs.

/// A formula as it is written, with the places where a line may end.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct Writing {
    text: String,
    stretches: Vec<Stretch>,
}

/// A stretch of a formula that is not broken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Stretch {
    /// Where it ends in the text.
    end: usize,
    /// How wide it is on the page, in characters of plain text.
    width: usize,
    /// The number of brackets open where it begins.
    depth: usize,
}

impl Writing {
    /// Adds text to the last stretch; `width` is how wide it is on the page.
    pub fn push(&mut self, text: &str, width: usize) {
        self.text.push_str(text);
        let end = self.text.len();
        match self.stretches.last_mut() {
            Some(last) => (last.end, last.width) = (end, last.width + width),
            None => self.stretches.push(Stretch { end, width, depth: 0 }),
        }
    }

    /// Lets a line end here, inside `depth` brackets.
    pub fn allow_break(&mut self, depth: usize) {
        self.stretches.push(Stretch { end: self.text.len(), width: 0, depth });
    }

    pub fn text(&self) -> &str {
        &self.text
    }

    /// The lines of at most `width` where the places for breaks allow it. A line that is too long is broken at the last
    /// place inside the fewest brackets; inside more only where that place lies in the line's first half and the next
    /// line could not hold what stands between it and the next such place. Cost: O(stretches · depth).
    pub fn lines(&self, width: usize, first_indent: usize, indent: usize) -> Vec<&str> {
        let mut lines = Vec::new();
        let (mut next, mut start) = (0, 0);
        while next < self.stretches.len() {
            let used = if lines.is_empty() { first_indent } else { indent };
            let widths = [used, indent].map(|used| width.saturating_sub(used));
            next += stretches_in_line(&self.stretches[next..], widths);
            let end = self.stretches[next - 1].end;
            // A space before a sign stands before the break.
            lines.push(self.text[start..end].trim_end());
            start = end;
        }
        lines
    }
}

/// How many stretches the first line takes; the widths are those of the first line and of others.
fn stretches_in_line(stretches: &[Stretch], [first, others]: [usize; 2]) -> usize {
    let ends: Vec<usize> = (stretches.iter())
        .scan(0, |used, stretch| {
            *used += stretch.width;
            Some(*used)
        })
        .take_while(|used| *used <= first)
        .collect();
    if ends.len() == stretches.len() {
        return stretches.len();
    }
    let mut place = 0;
    // The last place inside the fewest brackets, of those behind the one before.
    while let Some(deeper) =
        (place + 1..=ends.len()).min_by_key(|i| (stretches[*i].depth, usize::MAX - i))
    {
        place = deeper;
        let inside = |stretch: &&Stretch| stretch.depth > stretches[place].depth;
        let mut later = stretches[place + 1..].iter().take_while(inside);
        let fits = |sum: usize| (sum <= others).then_some(sum);
        let together = fits(stretches[place].width)
            .and_then(|own| later.try_fold(own, |sum, stretch| fits(sum + stretch.width)));
        if ends[place - 1] * 2 >= first || together.is_some() {
            break;
        }
    }
    place.max(1)
}

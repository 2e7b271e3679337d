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

    /// The lines of at most `width` where the places for breaks allow it. A line that is too long
    /// is broken at the last place before its end; among the places in the line's second half, at
    /// one inside the fewest brackets. Cost: O(stretches · stretches in a line).
    pub fn lines(&self, width: usize, first_indent: usize, indent: usize) -> Vec<&str> {
        let mut lines = Vec::new();
        let (mut next, mut start) = (0, 0);
        while next < self.stretches.len() {
            let used = if lines.is_empty() { first_indent } else { indent };
            next += stretches_in_line(&self.stretches[next..], width.saturating_sub(used));
            let end = self.stretches[next - 1].end;
            // A space before a sign stands before the break.
            lines.push(self.text[start..end].trim_end());
            start = end;
        }
        lines
    }
}

/// How many stretches the first line takes.
fn stretches_in_line(stretches: &[Stretch], width: usize) -> usize {
    let mut used = 0;
    let mut best: Option<(usize, usize)> = None;
    for (i, stretch) in stretches.iter().enumerate() {
        // The best place so far: any while it lies in the line's first half, later one inside as
        // few brackets as there are.
        let early = (used * 2) < width;
        if i > 0 && best.is_none_or(|(depth, _)| early || stretch.depth <= depth) {
            best = Some((if early { usize::MAX } else { stretch.depth }, i));
        }
        used += stretch.width;
        if let (true, Some((_, place))) = (used > width, best) {
            return place;
        }
    }
    stretches.len()
}

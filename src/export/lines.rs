//! Breaking long formulas into lines, at signs.

/// A stretch of a formula that is not broken, with its width on the page.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Atom {
    /// What is written.
    pub text: String,
    /// How wide it is, in characters of plain text.
    pub width: usize,
    /// Whether a line may end before it: the number of brackets open there.
    pub break_before: Option<usize>,
}

impl Atom {
    /// Writing that is never broken.
    pub fn solid(text: &str, width: usize) -> Atom {
        Atom { text: text.to_owned(), width, break_before: None }
    }
}

/// Distributes atoms to lines of at most `width` where the atoms allow it. A line that is too long
/// is broken at the last place before its end; among the places in the line's second half, at one
/// inside the fewest brackets. Cost: O(atoms · atoms in a line).
pub fn fill(atoms: &[Atom], width: usize, first_indent: usize, indent: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut rest = atoms;
    while !rest.is_empty() {
        let start = if lines.is_empty() { first_indent } else { indent };
        let end = line_end(rest, width.saturating_sub(start));
        let text: String = rest[..end].iter().map(|atom| atom.text.as_str()).collect();
        lines.push(text.trim_end().to_owned());
        rest = &rest[end..];
    }
    lines
}

/// How many atoms the first line takes.
fn line_end(atoms: &[Atom], width: usize) -> usize {
    let mut used = 0;
    let mut places: Vec<(usize, usize, usize)> = Vec::new();
    for (i, atom) in atoms.iter().enumerate() {
        if let (Some(depth), true) = (atom.break_before, i > 0) {
            places.push((depth, used, i));
        }
        used += atom.width;
        if used > width && !places.is_empty() {
            let late = places.iter().filter(|(_, at, _)| *at * 2 >= width);
            let best = late.min_by_key(|(depth, at, _)| (*depth, usize::MAX - at));
            return best.or(places.last()).map_or(i, |place| place.2);
        }
    }
    atoms.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn atoms(text: &str) -> Vec<Atom> {
        let break_before = |word: &str| (word == "+").then_some(0);
        let words = text.split_inclusive(' ');
        words
            .map(|word| Atom {
                text: word.to_owned(),
                width: word.chars().count(),
                break_before: break_before(word.trim()),
            })
            .collect()
    }

    #[test]
    fn lines_break_before_signs_and_lose_nothing() {
        let text = "aaaa + bbbb + cccc + dddddddddddddddddddddd + e";
        let lines = fill(&atoms(text), 14, 0, 2);
        assert_eq!(lines, ["aaaa + bbbb", "+ cccc", "+ dddddddddddddddddddddd", "+ e"]);
        assert_eq!(fill(&atoms(text), 100, 0, 2), [text]);
    }
}

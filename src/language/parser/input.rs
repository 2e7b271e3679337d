//! The rest of a text, aware of its place in the whole.

use nom::{Compare, CompareResult, Needed, Offset};

use super::Context;

/// What is still to be read.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    pub(super) text: &'a str,
    /// How many bytes of the whole come before it.
    pub(super) offset: usize,
    pub(super) context: Context<'a>,
}

impl<'a> Input<'a> {
    fn with_text(self, text: &'a str, offset: usize) -> Input<'a> {
        Input { text, offset, ..self }
    }
}

impl<'a> nom::Input for Input<'a> {
    type Item = char;
    type Iter = std::str::Chars<'a>;
    type IterIndices = std::str::CharIndices<'a>;

    fn input_len(&self) -> usize {
        self.text.len()
    }

    fn take(&self, index: usize) -> Self {
        self.with_text(&self.text[..index], self.offset)
    }

    fn take_from(&self, index: usize) -> Self {
        self.with_text(&self.text[index..], self.offset + index)
    }

    fn take_split(&self, index: usize) -> (Self, Self) {
        (self.take_from(index), self.take(index))
    }

    fn position<P: Fn(char) -> bool>(&self, predicate: P) -> Option<usize> {
        self.text.find(predicate)
    }

    fn iter_elements(&self) -> Self::Iter {
        self.text.chars()
    }

    fn iter_indices(&self) -> Self::IterIndices {
        self.text.char_indices()
    }

    fn slice_index(&self, count: usize) -> Result<usize, Needed> {
        nom::Input::slice_index(&self.text, count)
    }
}

impl Offset for Input<'_> {
    fn offset(&self, later: &Self) -> usize {
        later.offset - self.offset
    }
}

impl Compare<&str> for Input<'_> {
    fn compare(&self, other: &str) -> CompareResult {
        self.text.compare(other)
    }

    fn compare_no_case(&self, other: &str) -> CompareResult {
        self.text.compare_no_case(other)
    }
}

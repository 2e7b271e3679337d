//! Tokens that the grammar demands, and such as may be wrong in themselves.

use nom::bytes::complete::take_till;
use num_rational::BigRational;

use super::super::name;
use super::super::number;
use super::super::syntax::{Name, Operator, Span, Spanned};
use super::Outcome;
use super::complaint;
use super::input::Input;

impl Input<'_> {
    /// A sign that the grammar demands here.
    pub fn demand(&mut self, sign: &str) -> Outcome<Span> {
        self.symbol(sign).ok_or_else(|| complaint::expected(*self, &format!("`{sign}`")))
    }

    /// A given word, and no longer one that starts with it.
    pub fn keyword(&mut self, wanted: &str) -> Outcome<()> {
        let before = *self;
        match self.word() {
            Some(found) if found.value == wanted => Ok(()),
            _ => Err(complaint::expected(before, &format!("`{wanted}`"))),
        }
    }

    /// A name that the grammar demands here; `what` says whose.
    pub fn name(&mut self, what: &str) -> Outcome<Name> {
        let Some(Spanned { value, span }) = self.word() else {
            return Err(complaint::expected_name(*self, what));
        };
        match name::RESERVED.contains(&value) {
            true => Err(complaint::reserved(*self, value, span)),
            false => Ok(Spanned::new(name::normalise(value), span)),
        }
    }

    /// `*` or `/`; refuses `**`.
    pub fn multiplicative(&mut self) -> Outcome<Option<Spanned<Operator>>> {
        let signs = ["*", "·", "×", "⋅", "∗"].map(|sign| (sign, Operator::Multiply));
        if let Some(times) = self.one_of(&signs) {
            return match self.text.starts_with('*') {
                true => {
                    let both = Span::new(times.span.start, self.offset + 1);
                    Err(complaint::plain(*self, both, complaint::DOUBLE_STAR))
                }
                false => Ok(Some(times)),
            };
        }
        Ok(self.one_of(&[("/", Operator::Divide)]))
    }

    /// A number literal after blanks, where a digit follows, or a point and a digit.
    pub fn literal(&mut self) -> Outcome<Option<Spanned<BigRational>>> {
        let Some(Spanned { value: written, span }) = self.number() else { return Ok(None) };
        let input = *self;
        let next = Span::new(input.offset, input.offset + 1);
        match input.text.chars().next() {
            Some('.') => Err(complaint::plain(input, next, complaint::TWO_POINTS)),
            Some('_') => Err(complaint::plain(input, next, complaint::GROUPED_DIGITS)),
            _ => match number::literal(written) {
                Ok(value) => Ok(Some(Spanned::new(value, span))),
                Err(error) => Err(complaint::literal(input, span, error)),
            },
        }
    }

    /// A string between straight quotes on one line.
    pub fn string(&mut self) -> Outcome<Option<Spanned<String>>> {
        let Some(opener) = self.symbol("\"") else { return Ok(None) };
        let text = self.take_if(take_till(|c| c == '"' || c == '\n')).unwrap_or_default();
        if !self.text.starts_with('"') {
            return Err(complaint::unclosed_string(*self, opener, self.here()));
        }
        self.take(1);
        Ok(Some(Spanned::new(text.to_owned(), Span::new(opener.start, self.offset))))
    }
}

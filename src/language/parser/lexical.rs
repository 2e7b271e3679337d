//! Tokens that the grammar demands, and such as may be wrong in themselves.

use num_rational::BigRational;

use super::super::name;
use super::super::number;
use super::super::syntax::{Name, Operator, Span, Spanned};
use super::Outcome;
use super::complaint;
use super::input::{Input, count_digits};

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

    /// A number literal after blanks, where a digit or a point follows; `None` for a point alone.
    pub fn literal(&mut self) -> Outcome<Option<Spanned<BigRational>>> {
        let mut input = self.after_blanks();
        let (text, start) = (input.text, input.offset);
        let whole = count_digits(text);
        let fraction = text[whole..].strip_prefix('.').map_or(0, |rest| 1 + count_digits(rest));
        let mut length = whole + fraction;
        if whole == 0 && fraction <= 1 {
            return Ok(None);
        }
        if let Some(exponent) = text[length..].strip_prefix(['e', 'E']) {
            let unsigned = exponent.strip_prefix(['+', '-', '−']).unwrap_or(exponent);
            let digits = count_digits(unsigned);
            if digits > 0 {
                length = text.len() - unsigned.len() + digits;
            }
        }
        let written = input.take(length);
        *self = input;
        let span = Span::new(start, input.offset);
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
        let text = self.take(self.text.find(['"', '\n']).unwrap_or(self.text.len()));
        if !self.text.starts_with('"') {
            return Err(complaint::unclosed_string(*self, opener, self.here()));
        }
        self.take(1);
        Ok(Some(Spanned::new(text.to_owned(), Span::new(opener.start, self.offset))))
    }
}

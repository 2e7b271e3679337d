//! The rest of a text, aware of its place in the whole, and the tokens at its front. Nothing here
//! complains: what is not there is `None`, and nothing is taken.

use super::super::layout::is_space;
use super::super::name;
use super::super::source::Source;
use super::super::syntax::{Sign, Span, Spanned};
use super::forms::{Form, SCENE};
use crate::expression::Relation;
use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_while, take_while1};
use nom::character::complete::{char, digit1, one_of, satisfy};
use nom::combinator::{opt, recognize, verify};
use nom::multi::many0_count;
use nom::sequence::preceded;
use nom::{IResult, Parser};

/// A parser that takes a piece of text.
pub(super) trait Take<'a>: Parser<&'a str, Output = &'a str, Error = ()> {}

impl<'a, P: Parser<&'a str, Output = &'a str, Error = ()>> Take<'a> for P {}

/// What is still to be read. It starts right behind the last token that was read, before the blanks
/// that follow.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    pub text: &'a str,
    /// How many bytes of the whole come before it.
    pub offset: usize,
    pub context: Context<'a>,
}

/// What a parser knows about its surroundings.
#[derive(Clone, Copy)]
pub(super) struct Context<'a> {
    pub source: &'a Source,
    /// What the text is called in "the end of the …".
    pub unit: &'static str,
    /// How the whole unit is written, for a remedy.
    pub form: Option<&'static str>,
    /// The words that begin statements, the title's first, and how each statement is written.
    pub forms: &'static [Form],
    /// How far an expression goes.
    pub extent: Extent,
}

/// Where an expression ends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
    /// Where it cannot go on; a word after it is a mistake.
    Whole,
    /// Also before a word, which is the unit of the whole.
    Unit,
    /// After one factor.
    Factor,
}

impl Context<'_> {
    /// Whether the text is a scene, in which braces and bars are signs.
    pub fn is_scene(&self) -> bool {
        self.forms[0] == SCENE[0]
    }
}

impl<'a> Input<'a> {
    /// The place where the input starts, of no width.
    pub fn here(&self) -> Span {
        Span::new(self.offset, self.offset)
    }

    /// Takes so many bytes.
    pub fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.text.split_at(bytes);
        (self.text, self.offset) = (rest, self.offset + bytes);
        taken
    }

    /// The input after spaces, line ends and comments.
    pub fn after_blanks(mut self) -> Input<'a> {
        let comment = preceded(char('#'), take_till(|character| character == '\n'));
        let blanks = recognize(many0_count(alt((take_while1(is_space), comment))));
        self.take_if(blanks);
        self
    }

    /// Whether the next token starts with this.
    pub fn next_is(self, sign: &str) -> bool {
        self.after_blanks().text.starts_with(sign)
    }

    /// What a parser takes from the front; nothing where it fails.
    pub fn take_if(&mut self, mut parser: impl Take<'a>) -> Option<&'a str> {
        let (_, found) = parser.parse(self.text).ok()?;
        Some(self.take(found.len()))
    }

    /// A token after blanks.
    fn token(&mut self, parser: impl Take<'a>) -> Option<Spanned<&'a str>> {
        let mut input = self.after_blanks();
        let start = input.offset;
        let text = input.take_if(parser)?;
        *self = input;
        Some(Spanned::new(text, Span::new(start, input.offset)))
    }

    /// A fixed sign.
    pub fn symbol(&mut self, sign: &str) -> Option<Span> {
        self.token(tag(sign)).map(|found| found.span)
    }

    /// One of several signs, and what it stands for.
    pub fn one_of<T: Copy>(&mut self, signs: &[(&str, T)]) -> Option<Spanned<T>> {
        let found = |(sign, value): &(&str, T)| Some(Spanned::new(*value, self.symbol(sign)?));
        signs.iter().find_map(found)
    }

    /// `+` or `-`.
    pub fn additive(&mut self) -> Option<Spanned<Sign>> {
        self.one_of(&[("+", Sign::Plus), ("-", Sign::Minus), ("−", Sign::Minus)])
    }

    /// A comparison.
    pub fn relation(&mut self) -> Option<Spanned<Relation>> {
        self.one_of(&[
            (">=", Relation::AtLeast),
            ("≥", Relation::AtLeast),
            ("<=", Relation::AtMost),
            ("≤", Relation::AtMost),
            ("!=", Relation::Unequal),
            ("≠", Relation::Unequal),
            (">", Relation::Greater),
            ("<", Relation::Less),
        ])
    }

    /// A prime, straight or as a word processor writes it; how many times it differentiates.
    pub fn prime(&mut self) -> Option<Spanned<u32>> {
        self.one_of(&[("'", 1), ("′", 1), ("’", 1), ("″", 2)])
    }

    /// A word as it is written: a letter, then letters, digits and `_`.
    pub fn word(&mut self) -> Option<Spanned<&'a str>> {
        self.token(recognize((satisfy(name::is_letter), take_while(name::continues))))
    }

    /// The word that follows, left where it is.
    pub fn next_word(mut self) -> Option<Spanned<&'a str>> {
        self.word()
    }

    /// Digits alone, as they are written.
    pub fn digits(&mut self) -> Option<Spanned<&'a str>> {
        self.token(digit1)
    }

    /// Digits with a decimal point among them or none, and a power of ten, as they are written.
    pub fn number(&mut self) -> Option<Spanned<&'a str>> {
        self.token(number)
    }
}

fn number(text: &str) -> IResult<&str, &str, ()> {
    let is_digit = |c: char| c.is_ascii_digit();
    let whole = take_while(is_digit);
    let mantissa = recognize((whole, opt((char('.'), take_while(is_digit)))));
    let mantissa = verify(mantissa, |written: &str| written.contains(is_digit));
    let exponent = (one_of("eE"), opt(one_of("+-−")), digit1);
    recognize((mantissa, opt(exponent))).parse(text)
}

//! Alters inputs: token by token where they are texts, else byte by byte.

use crate::random::Random;

/// Tokens that are put in: numbers at limits, brackets, words and signs that mean something somewhere.
const TOKENS: [&str; 48] = [
    "0",
    "1",
    "-1",
    "2",
    "1/3",
    "0.5",
    "1e3",
    "1e-3",
    "1e1001",
    "99",
    "1000",
    "4294967296",
    "1.",
    ".5",
    "0/0",
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    "[n]",
    "[n-1]",
    "'",
    "\"",
    "\n",
    "\n  ",
    " ",
    "\t",
    "#",
    ",",
    "=",
    "|",
    "-",
    "−",
    "^",
    "²",
    "*",
    "/",
    "·",
    "μ",
    "pi",
    "exp(",
    "sqrt(",
    "t",
    "n",
    "kN/mm",
    "\r\n",
];

/// The tokens of a text: words and numbers, white space, and any other byte by itself.
fn tokens(text: &[u8]) -> Vec<&[u8]> {
    let kind = |byte: &u8| match byte {
        b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' | b'_' | b'.' | 0x80.. => 1,
        b' ' => 2,
        _ => 0,
    };
    text.chunk_by(|a, b| kind(a) == kind(b) && kind(a) > 0).collect()
}

/// A part of a list, at most so long, with its place.
fn part(length: usize, most: usize, random: &mut Random) -> std::ops::Range<usize> {
    let start = random.bits() as usize % (length + 1);
    start..(start + random.bits() as usize % (most + 1)).min(length)
}

/// One to four changes of an input; other inputs lend parts.
pub fn altered(one: &[u8], other: &[u8], is_text: bool, random: &mut Random) -> Vec<u8> {
    let mut whole = one.to_vec();
    for _ in 0..=random.bits() % 4 {
        if !is_text || random.bits().is_multiple_of(8) {
            whole = bytes_altered(whole, other, is_text, random);
            continue;
        }
        let (mut own, others) = (tokens(&whole), tokens(other));
        let place = part(own.len(), 3, random);
        let lent = &others[part(others.len(), 3, random)];
        match random.bits() % 8 {
            0 => drop(own.drain(place)),
            1 => drop(own.splice(place, lent.iter().copied())),
            2 => drop(own.splice(place.start..place.start, lent.iter().copied())),
            3 => {
                let copied = own[place.clone()].to_vec();
                drop(own.splice(place.end..place.end, copied));
            }
            4 if !place.is_empty() => {
                let with = random.bits() as usize % own.len();
                own.swap(place.start, with);
            }
            5 => {
                // A line from elsewhere.
                let lines: Vec<&[u8]> = other.split_inclusive(|byte| *byte == b'\n').collect();
                let line = lines.get(random.bits() as usize % lines.len().max(1));
                let starts = own.iter().position(|token| token.starts_with(b"\n"));
                let starts = starts.map_or(own.len(), |at| at + 1).max(place.start);
                drop(own.splice(starts..starts, line.copied()));
            }
            _ => {
                let token = TOKENS[random.bits() as usize % TOKENS.len()];
                let end = if random.bits().is_multiple_of(2) { place.end } else { place.start };
                drop(own.splice(place.start..end, [token.as_bytes()]));
            }
        }
        whole = own.concat();
    }
    whole.truncate(crate::MAX_BYTES);
    whole
}

fn bytes_altered(mut own: Vec<u8>, other: &[u8], is_text: bool, random: &mut Random) -> Vec<u8> {
    let place = part(own.len(), if is_text { 2 } else { 16 }, random);
    match random.bits() % 4 {
        0 => drop(own.drain(place)),
        1 => drop(own.splice(place, other[part(other.len(), 16, random)].iter().copied())),
        2 => own[place].iter_mut().for_each(|byte| *byte = random.bits() as u8),
        _ => {
            let kind = random.bits();
            let edge = [0, 1, 0x7f, 0x80, 0xff, b'9', b'e', b' '][kind as usize % 8];
            own[place].iter_mut().for_each(|byte| *byte = edge);
        }
    }
    own
}

//! Numbers from bytes.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;

/// Takes numbers from the front; zeros follow the end.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn take(&mut self, count: usize) -> Vec<u8> {
        let (taken, rest) = self.0.split_at(count.min(self.0.len()));
        self.0 = rest;
        taken.to_vec()
    }

    pub fn word(&mut self) -> u64 {
        let mut word = self.take(8);
        word.resize(8, 0);
        u64::from_le_bytes(word.try_into().expect("eight bytes"))
    }

    /// Less than `end`.
    pub fn below(&mut self, end: u64) -> u64 {
        let mut short = self.take(2);
        short.resize(2, 0);
        u64::from(u16::from_le_bytes([short[0], short[1]])) % end
    }

    /// From `-most` to `most`.
    pub fn about_zero(&mut self, most: i64) -> i64 {
        self.below(2 * most as u64 + 1) as i64 - most
    }

    /// An integer of at most so many bytes.
    pub fn integer(&mut self, most: u64) -> BigInt {
        let control = self.below(8 * most);
        let sign = if control.is_multiple_of(2) { Sign::Plus } else { Sign::Minus };
        match control / 2 % 4 {
            // Powers of two and ten and their neighbours.
            0 => {
                let base = if control.is_multiple_of(3) { 10 } else { 2 };
                let power = BigInt::from(base).pow(self.below(2 * most) as u32);
                BigInt::from_biguint(sign, power.magnitude().clone()) + self.about_zero(1)
            }
            _ => {
                let length = self.below(most + 1);
                BigInt::from_bytes_le(sign, &self.take(length as usize))
            }
        }
    }

    /// A rational number whose parts have at most so many bytes.
    pub fn rational(&mut self, most: u64) -> BigRational {
        let (above, below) = (self.integer(most), self.integer(most));
        match below == BigInt::ZERO {
            true => above.into(),
            false => BigRational::new(above, below),
        }
    }

    /// Any double, or one with few bits.
    pub fn double(&mut self) -> f64 {
        match self.below(4) {
            0 => f64::from_bits(self.word()),
            1 => self.about_zero(100) as f64 * 2.0_f64.powi(self.about_zero(40) as i32),
            _ => {
                let exponent = self.about_zero(12) as i32;
                (self.word() as i64 as f64) * 2.0_f64.powi(exponent - 63)
            }
        }
    }

    /// Up to eight characters.
    pub fn text(&mut self) -> String {
        let length = self.below(9) as usize;
        String::from_utf8_lossy(&self.take(length)).into_owned()
    }
}

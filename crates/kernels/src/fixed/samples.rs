//! Repeatable random words for tests, with the ends of the range forced now and then.

/// A linear congruential generator of words.
pub(super) struct Samples(u64);

impl Samples {
    /// The generator that begins with a seed.
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Sixty-four random bits.
    pub(super) fn bits(&mut self) -> u64 {
        let mut next = || {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            self.0 >> 32
        };
        (next() << 32) | next()
    }

    /// A word of 128 bits: random ones of any length, and the ends of the signed and the unsigned
    /// range.
    pub(super) fn word(&mut self) -> u128 {
        let choice = self.bits() % 16;
        let near = (self.bits() % 3) as u128;
        match choice {
            0 => near,
            1 => u128::MAX - near,
            2 => (1 << 127) + near,
            3 => (1 << 127) - 1 - near,
            _ => {
                let word = (u128::from(self.bits()) << 64) | u128::from(self.bits());
                let length = (self.bits() % 128) as u32;
                let short = word >> length;
                if choice.is_multiple_of(2) { short } else { short.wrapping_neg() }
            }
        }
    }
}

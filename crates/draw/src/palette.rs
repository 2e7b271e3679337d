//! Colours, markers and dashes that tell lines apart, for readers with any colour vision and in
//! print without colour.

/// Colours of Okabe and Ito, in the order in which lines take them. Their yellow is left out, which
/// is hardly seen on white; the first, black, turns white on dark paper.
pub(super) const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#000000", "#CC79A7", "#E69F00", "#56B4E9"];

/// Patterns of dashes, the first unbroken.
pub(super) const DASHES: [&str; 6] = ["none", "7 3", "2 3", "9 3 2 3", "16 4", "9 3 2 3 2 3"];

/// Outlines of markers about the origin, of about equal area. Their number and that of the dashes have no
/// common divisor, and so the first 42 lines differ in the pair of both.
pub(super) const MARKERS: [&str; 7] = [
    "M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z",
    "M-4 -4H4V4H-4z",
    "M0 -5.5L5 3.5H-5z",
    "M0 -5.5L5 0L0 5.5L-5 0z",
    "M0 5.5L5 -3.5H-5z",
    "M-1.5 -5H1.5V-1.5H5V1.5H1.5V5H-1.5V1.5H-5V-1.5H-1.5z",
    "M-5 -3L-3 -5L0 -2L3 -5L5 -3L2 0L5 3L3 5L0 2L-3 5L-5 3L-2 0z",
];

/// Samples of the scale "viridis" at equal distances: lightness rises evenly, and hardly differs
/// between kinds of colour vision.
const VIRIDIS: [[u8; 3]; 10] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3E, 0x49, 0x89],
    [0x31, 0x68, 0x8E],
    [0x26, 0x82, 0x8E],
    [0x1F, 0x9E, 0x89],
    [0x35, 0xB7, 0x79],
    [0x6E, 0xCE, 0x58],
    [0xB5, 0xDE, 0x2B],
    [0xFD, 0xE7, 0x25],
];

/// The halves of the scale "RdBu" of ColorBrewer at equal distances, from white: above zero red, below
/// zero blue. The darkest samples are left out, on which black lines would hardly be seen.
const ABOVE_ZERO: [[u8; 3]; 5] = [
    [0xFF, 0xFF, 0xFF],
    [0xFD, 0xDB, 0xC7],
    [0xF4, 0xA5, 0x82],
    [0xD6, 0x60, 0x4D],
    [0xB2, 0x18, 0x2B],
];
const BELOW_ZERO: [[u8; 3]; 5] = [
    [0xFF, 0xFF, 0xFF],
    [0xD1, 0xE5, 0xF0],
    [0x92, 0xC5, 0xDE],
    [0x43, 0x93, 0xC3],
    [0x21, 0x66, 0xAC],
];

/// The colour at `share` of the scale, from dark at 0 to light at 1; values outside take the ends.
pub(super) fn shade(share: f64) -> String {
    between(&VIRIDIS, share)
}

/// The colour of a value with a sign, from −1 to 1: white at zero, and the darker the farther from it.
pub(super) fn diverging(share: f64) -> String {
    between(if share < 0.0 { &BELOW_ZERO } else { &ABOVE_ZERO }, share.abs())
}

fn between(samples: &[[u8; 3]], share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (samples.len() - 1) as f64;
    let below = (at.floor() as usize).min(samples.len() - 2);
    let part = at - below as f64;
    let channel = |i: usize| {
        let (low, high) = (f64::from(samples[below][i]), f64::from(samples[below + 1][i]));
        (low + part * (high - low)).round() as u8
    };
    format!("#{:02X}{:02X}{:02X}", channel(0), channel(1), channel(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The relative luminance of a colour (WCAG 2).
    fn luminance(colour: &str) -> f64 {
        let channel = |at: usize| {
            let value = u8::from_str_radix(&colour[at..at + 2], 16).expect("hexadecimal digits");
            let value = f64::from(value) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
    }

    #[test]
    fn the_scales_are_ordered_by_lightness() {
        let halves = [|share: f64| diverging(1.0 - share), |share: f64| diverging(share - 1.0)];
        for scale in [shade, halves[0], halves[1]] {
            let shades: Vec<f64> =
                (0..=200).map(|i| luminance(&scale(f64::from(i) / 200.0))).collect();
            assert!(shades.windows(2).all(|pair| pair[0] < pair[1] + 2e-3), "lightness falls");
            assert!(
                shades.windows(20).all(|run| run[0] + 5e-3 < run[19]),
                "lightness stands still"
            );
        }
        assert_eq!((shade(-1.0), shade(2.0)), ("#440154".to_owned(), "#FDE725".to_owned()));
    }

    #[test]
    fn signs_differ_in_hue_and_are_white_at_zero() {
        assert_eq!(diverging(0.0), "#FFFFFF");
        let red = |colour: &str| i32::from_str_radix(&colour[1..3], 16).expect("two digits");
        let blue = |colour: &str| i32::from_str_radix(&colour[5..7], 16).expect("two digits");
        for step in 1..=20 {
            let (above, below) =
                (diverging(f64::from(step) / 20.0), diverging(f64::from(-step) / 20.0));
            assert!(red(&above) > blue(&above) && red(&below) < blue(&below), "{above} {below}");
        }
    }

    #[test]
    fn lines_differ_in_more_than_colour() {
        let style = |i: usize| (i % MARKERS.len(), i % DASHES.len());
        let styles: std::collections::BTreeSet<_> = (0..40).map(style).collect();
        assert_eq!(styles.len(), 40);
        // A curve without markers has its dashes and its colour alone.
        let strokes: std::collections::BTreeSet<_> =
            (0..40).map(|i| (i % COLOURS.len(), i % DASHES.len())).collect();
        assert_eq!(strokes.len(), 40);
        assert_eq!((0..6).map(|i| DASHES[i]).collect::<std::collections::BTreeSet<_>>().len(), 6);
        let mut colours = COLOURS.to_vec();
        colours.sort_unstable();
        colours.dedup();
        assert_eq!(colours.len(), COLOURS.len());
    }
}

//! Colours, markers and dashes that tell lines apart, for readers with any colour vision and in
//! print without colour.

/// Colours of Okabe and Ito, in the order in which lines take them. Their yellow is left out, which
/// is hardly seen on white; the first, black, turns white on dark paper.
pub(super) const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#000000", "#CC79A7", "#E69F00", "#56B4E9"];

/// Patterns of dashes, the first unbroken.
pub(super) const DASHES: [&str; 5] = ["none", "7 3", "2 3", "9 3 2 3", "14 4"];

/// Outlines of markers about the origin, of about equal area.
pub(super) const MARKERS: [&str; 8] = [
    "M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z",
    "M-4 -4H4V4H-4z",
    "M0 -5.5L5 3.5H-5z",
    "M0 -5.5L5 0L0 5.5L-5 0z",
    "M0 5.5L5 -3.5H-5z",
    "M-1.5 -5H1.5V-1.5H5V1.5H1.5V5H-1.5V1.5H-5V-1.5H-1.5z",
    "M-5 -3L-3 -5L0 -2L3 -5L5 -3L2 0L5 3L3 5L0 2L-3 5L-5 3L-2 0z",
    "M0 -5.3L5 -1.6L3.1 4.3H-3.1L-5 -1.6z",
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

/// Samples of the scale "YlGnBu" of ColorBrewer at equal distances, from dark to light: for large
/// areas on white paper.
const TINTS: [[u8; 3]; 9] = [
    [0x08, 0x1D, 0x58],
    [0x25, 0x34, 0x94],
    [0x22, 0x5E, 0xA8],
    [0x1D, 0x91, 0xC0],
    [0x41, 0xB6, 0xC4],
    [0x7F, 0xCD, 0xBB],
    [0xC7, 0xE9, 0xB4],
    [0xED, 0xF8, 0xB1],
    [0xFF, 0xFF, 0xD9],
];

/// The colour at `share` of the scale, from dark at 0 to light at 1; values outside take the ends.
pub(super) fn shade(share: f64) -> String {
    between(&VIRIDIS, share)
}

/// The same of the scale for large areas.
pub(super) fn tint(share: f64) -> String {
    between(&TINTS, share)
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
        for scale in [shade, tint] {
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
    fn lines_differ_in_more_than_colour() {
        let style = |i: usize| (i % MARKERS.len(), i % DASHES.len());
        let styles: std::collections::BTreeSet<_> = (0..40).map(style).collect();
        assert_eq!(styles.len(), 40);
        let mut colours = COLOURS.to_vec();
        colours.sort_unstable();
        colours.dedup();
        assert_eq!(colours.len(), COLOURS.len());
    }
}

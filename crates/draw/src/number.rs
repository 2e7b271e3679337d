//! Numbers as people read them in a picture: `10⁻¹²`, `3.4·10⁻⁶`, `0.25`, with a true minus sign.

/// A whole number in superscript digits.
fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = exponent.to_string();
    let raised =
        digits.chars().map(|digit| digit.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]));
    raised.collect()
}

pub(super) fn power_of_ten(exponent: i32) -> String {
    format!("10{}", superscript(exponent))
}

/// `digits · 10^exponent`, exactly: in positions while it is short, else with a power of ten.
pub(super) fn decimal(digits: i64, exponent: i32) -> String {
    let (mut digits, mut exponent) = (digits, exponent);
    if digits == 0 {
        return "0".to_owned();
    }
    while digits % 10 == 0 {
        (digits, exponent) = (digits / 10, exponent + 1);
    }
    let sign = if digits < 0 { "−" } else { "" };
    let figures = digits.unsigned_abs().to_string();
    let count = i32::try_from(figures.len()).expect("at most nineteen figures");
    let leading = count - 1 + exponent;
    match (exponent, leading) {
        (0.., ..=5) => {
            format!("{sign}{figures}{}", "0".repeat(usize::try_from(exponent).unwrap_or(0)))
        }
        (..0, 0..=5) => {
            let (whole, part) = figures.split_at(usize::try_from(leading + 1).unwrap_or(0));
            format!("{sign}{whole}.{part}")
        }
        (..0, -3..0) => {
            let zeros = "0".repeat(usize::try_from(-1 - leading).unwrap_or(0));
            format!("{sign}0.{zeros}{figures}")
        }
        _ if figures == "1" => format!("{sign}{}", power_of_ten(leading)),
        _ => {
            let (first, rest) = figures.split_at(1);
            let point = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{point}{rest}·{}", power_of_ten(leading))
        }
    }
}

/// A value to two figures, for sentences and labels.
pub(super) fn rounded(value: f64) -> String {
    if !value.is_finite() {
        return if value.is_nan() { "not a number" } else { "infinite" }.to_owned();
    }
    let text = format!("{value:.1e}");
    let (mantissa, exponent) = text.split_once('e').expect("an exponent is always printed");
    let digits: i64 = mantissa.replace('.', "").parse().expect("two figures");
    let exponent: i32 = exponent.parse().expect("a whole number");
    decimal(digits, exponent - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_written_by_hand() {
        for (digits, exponent, text) in [
            (0, 5, "0"),
            (25, -2, "0.25"),
            (-5, -1, "−0.5"),
            (1, -12, "10⁻¹²"),
            (100, 0, "100"),
            (15, 5, "1.5·10⁶"),
            (150, 3, "150000"),
            (1, 6, "10⁶"),
            (-3, -4, "−3·10⁻⁴"),
            (123, -5, "0.00123"),
            (12345, -2, "123.45"),
        ] {
            assert_eq!(decimal(digits, exponent), text);
        }
        assert_eq!(rounded(3.44e-17), "3.4·10⁻¹⁷");
        assert_eq!(rounded(1e-8), "10⁻⁸");
        assert_eq!(rounded(0.25), "0.25");
        assert_eq!(rounded(5e-324), "4.9·10⁻³²⁴");
        assert_eq!(rounded(0.0), "0");
        assert_eq!(rounded(f64::INFINITY), "infinite");
    }
}

//! A window of an observable as a C function, with its proven bound in the file.
//!
//! The file holds the table of a [`Compiled`] observable: polynomials, and buckets of equal length
//! in which the polynomial of a time is looked up. The function needs nothing but C89 and doubles after
//! IEEE 754; the bound holds whether multiplications and additions are fused or not.

use crate::signal::{Compiled, Evaluator as _};
use std::fmt::Write as _;

/// The heading of a C file.
#[derive(Clone, Debug)]
pub struct CHeading {
    pub title: String,
    pub quantity: String,
    /// The unit of its values; empty if they have none.
    pub unit: String,
    pub time_unit: String,
    /// What the values take for granted; empty if that is nothing.
    pub note: String,
    /// The command that writes the file.
    pub command: String,
}

/// The buckets of a table: for each the first piece that may hold a time of it.
fn buckets(starts: &[f64], end: f64, count: usize) -> Vec<usize> {
    let width = (end - starts[0]) / count as f64;
    let place = |bucket: usize| {
        // A bucket too early does no harm, since the search goes on from there.
        let time = starts[0] + width * (bucket as f64 - 1.0);
        starts.partition_point(|start| *start <= time).max(1) - 1
    };
    (0..count).map(place).collect()
}

/// A double that is read back as it is, in C89.
fn number(value: f64) -> String {
    format!("{value:.16e}")
}

fn array(output: &mut String, kind: &str, name: &str, values: impl Iterator<Item = String>) {
    let values: Vec<String> = values.collect();
    let per_line = if kind == "double" { 4 } else { 16 };
    let _ = writeln!(output, "static const {kind} {name}[{}] = {{", values.len());
    for line in values.chunks(per_line) {
        let _ = writeln!(output, "    {},", line.join(", "));
    }
    output.push_str("};\n\n");
}

/// A C file with the function `double wavestep_QUANTITY(double t)` and one for many times.
pub fn to_c(compiled: &Compiled<'_>, heading: &CHeading) -> String {
    // An identifier, whatever the observable is called.
    let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = heading.quantity.chars().map(letter).collect();
    let (pieces, end) = (compiled.pieces(), compiled.table().end());
    let starts: Vec<f64> = pieces.iter().map(|piece| piece.start).collect();
    let count = (2 * pieces.len()).next_power_of_two();
    let bound = compiled.bound().unwrap_or(f64::INFINITY);
    let mut output = preamble(heading, &name, [starts[0], end], bound);
    array(&mut output, "double", "start", starts.iter().map(|value| number(*value)));
    array(&mut output, "double", "middle", pieces.iter().map(|piece| number(piece.centre)));
    array(&mut output, "double", "inverse", pieces.iter().map(|piece| number(piece.scale)));
    let length = compiled.table().degree() + 1;
    let rows = pieces.iter().flat_map(|piece| {
        (0..length).map(|m| number(piece.coefficients.get(m).copied().unwrap_or(0.0)))
    });
    array(&mut output, "double", "coefficient", rows);
    let kind = if pieces.len() <= 1 << 16 { "unsigned short" } else { "unsigned int" };
    let first = buckets(&starts, end, count);
    array(&mut output, kind, "bucket", first.iter().map(ToString::to_string));
    let per_bucket = number(count as f64 / (end - starts[0]).max(f64::MIN_POSITIVE));
    let pieces = pieces.len();
    let _ =
        write!(output, "enum {{ PIECES = {pieces}, LENGTH = {length}, BUCKETS = {count} }};\n\n");
    output + &functions(&name, &number(end), &per_bucket)
}

/// The comment that says what the file holds and proves, and the bound as a macro.
fn preamble(heading: &CHeading, name: &str, [first, end]: [f64; 2], bound: f64) -> String {
    // The end of a comment would end this one.
    let plain = |text: &str| text.replace("*/", "* /").replace(['\n', '\r'], " ");
    let unit = |unit: &str| if unit.is_empty() { "1".to_owned() } else { plain(unit) };
    let bound = number(bound);
    let note = match plain(&heading.note) {
        note if note.is_empty() => note,
        note => format!(" *\n * Note: {note}.\n"),
    };
    format!(
        "/* {title}: {name}(t)\n \
         *\n \
         * Written by wavestep {version}:\n \
         *   {command}\n \
         *\n \
         * t from {first} to {end}, in {time_unit}; {name} in {unit}.\n \
         * At an arrival the value just after it is meant. Outside the window the result is not a\n \
         * number.\n \
         *\n \
         * Proven: for every double t of the window the result is within\n \
         *   {bound}\n \
         * of the exact solution, if doubles are those of IEEE 754 and the compiler keeps to the order\n \
         * of operations (no -ffast-math); multiplications and additions may be fused.\n\
         {note} */\n\n\
         #include <stddef.h>\n\n\
         #define WAVESTEP_{upper}_BOUND {bound}\n\n",
        title = plain(&heading.title),
        version = env!("CARGO_PKG_VERSION"),
        command = plain(&heading.command),
        first = number(first),
        end = number(end),
        time_unit = unit(&heading.time_unit),
        unit = unit(&heading.unit),
        upper = name.to_uppercase(),
    )
}

/// The functions of the file, which read its tables.
fn functions(name: &str, end: &str, per_bucket: &str) -> String {
    format!(
        "static double evaluate(size_t piece, double t)\n{{\n    \
             const double *c = coefficient + piece * LENGTH;\n    \
             const double u = (t - middle[piece]) * inverse[piece];\n    \
             double value = c[LENGTH - 1];\n    \
             int k;\n    \
             for (k = LENGTH - 2; k >= 0; k--)\n        value = value * u + c[k];\n    \
             return value;\n}}\n\n\
         static size_t find(double t)\n{{\n    \
             size_t place = (size_t) ((t - start[0]) * {per_bucket});\n    \
             size_t piece = bucket[place < BUCKETS ? place : BUCKETS - 1];\n    \
             while (piece > 0 && t < start[piece])\n        piece--;\n    \
             while (piece + 1 < PIECES && t >= start[piece + 1])\n        piece++;\n    \
             return piece;\n}}\n\n\
         static int outside(double t)\n{{\n    \
             return !(t >= start[0] && t <= {end});\n}}\n\n\
         static double not_a_number(void)\n{{\n    \
             const volatile double zero = 0.0;\n    \
             return zero / zero;\n}}\n\n\
         /* {name} at the time t. */\n\
         double wavestep_{name}(double t)\n{{\n    \
             return outside(t) ? not_a_number() : evaluate(find(t), t);\n}}\n\n\
         /* {name} at n times; fastest where they ascend. */\n\
         void wavestep_{name}_many(const double *t, double *values, size_t n)\n{{\n    \
             size_t piece = 0;\n    \
             size_t i;\n    \
             for (i = 0; i < n; i++) {{\n        \
                 if (outside(t[i])) {{\n            values[i] = not_a_number();\n            continue;\n        }}\n        \
                 if (t[i] < start[piece] || (piece + 1 < PIECES && t[i] >= start[piece + 1]))\n            \
                     piece = find(t[i]);\n        \
                 values[i] = evaluate(piece, t[i]);\n    }}\n}}\n",
    )
}

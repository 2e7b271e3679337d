//! Charts written to files of the kind that their names say.

use super::failure::Failure;
use super::output::write_whole;
use std::path::Path;
use wavestep_draw::{Chart, png};

/// What a file holds, by its ending.
#[derive(Clone, Copy)]
enum Written {
    Svg,
    Png,
    Json,
    Csv,
}

/// Makes a chart and writes it; what is given wrongly is told before any work is done.
pub fn draw(
    file: &str,
    width: u32,
    chart: impl FnOnce() -> Result<Box<dyn Chart>, Failure>,
) -> Result<String, Failure> {
    let path = Path::new(file);
    let kind = kind(path)?;
    let chart = chart()?;
    let bytes = match kind {
        Written::Svg => chart.svg().into_bytes(),
        Written::Png => png(&chart.svg(), width)?,
        Written::Json => format!("{:#}\n", chart.json()).into_bytes(),
        Written::Csv => chart.csv().into_bytes(),
    };
    write_whole(path, &bytes)?;
    Ok(format!("{file}: {} bytes\n", bytes.len()))
}

fn kind(file: &Path) -> Result<Written, Failure> {
    let ending = file.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    match ending.to_ascii_lowercase().as_str() {
        "svg" => Ok(Written::Svg),
        "png" => Ok(Written::Png),
        "json" => Ok(Written::Json),
        "csv" => Ok(Written::Csv),
        _ => {
            let message = format!("`{}` does not say what to write", file.display());
            Err(Failure::usage(message, "name a file that ends with .svg, .png, .json or .csv"))
        }
    }
}

//! Charts written to files of the kind that their names say.

use super::failure::Failure;
use super::output::write_whole;
use super::progress;
use std::path::Path;
use wavestep::language;
use wavestep_draw::{Chart, pdf, png};

/// Makes a chart and writes it as the ending of the file's name says; a wrong one is told before any work
/// is done.
pub fn draw(
    file: &str,
    width: u32,
    chart: impl FnOnce() -> Result<Box<dyn Chart>, Failure>,
) -> Result<String, Failure> {
    if file == "-" {
        return Ok(chart()?.svg());
    }
    let path = Path::new(file);
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let write: fn(&dyn Chart, u32) -> Result<Vec<u8>, Failure> =
        match ending.to_ascii_lowercase().as_str() {
            "svg" => |chart, _| Ok(chart.svg().into_bytes()),
            "pdf" => |chart, _| Ok(pdf(&chart.svg())?),
            "png" => |chart, width| Ok(png(&chart.svg(), width)?),
            "json" => |chart, _| Ok(format!("{:#}\n", chart.json()).into_bytes()),
            "csv" => |chart, _| Ok(chart.csv().into_bytes()),
            _ => {
                let message = format!("the extension of `{file}` is not a known format");
                let likely = language::closest(ending, ["svg", "pdf", "png", "json", "csv"]);
                let remedy = match likely {
                    Some(likely) => {
                        format!("did you mean `{}`?", path.with_extension(likely).display())
                    }
                    None => "use the extension .svg, .pdf, .png, .json or .csv".to_owned(),
                };
                return Err(Failure::usage(message, remedy));
            }
        };
    let progress = progress::spinner("drawing");
    let bytes = write(&*chart()?, width)?;
    drop(progress);
    write_whole(path, &bytes)?;
    Ok(format!("{file}: {} bytes\n", bytes.len()))
}

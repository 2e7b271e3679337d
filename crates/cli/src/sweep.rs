//! `sweep`: a scene at many values of its symbols, as a table.

use super::arguments::Sweep as Options;
use super::failure::{COMPUTATION, Failure};
use super::input;
use super::output::{plural, write_whole, written};
use super::progress;
use super::table::Table;
use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use serde_json::{Value as Json, json};
use std::fs::{self, File, OpenOptions};
use std::io::{BufRead as _, BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use wavestep_studies::sweep::{Axis, MOST_ROWS, Row, Sweep, TEXTS, Time, ToSweep};

pub fn run(options: &Options) -> Result<String, Failure> {
    let (name, text) = input::text(&options.scene.scene)?;
    let set = input::values(&options.scene.set)?;
    let axes = options.over.iter().map(|over| over.parse::<Axis>()).collect::<Result<Vec<_>, _>>();
    let axes = axes.map_err(|error| {
        let form = "write --over mu=1,2,5 or --over mu=1/10..10:25:log";
        Failure::usage(error.to_string(), error.remedy(form))
    })?;
    let trimmed = |names: &[String]| names.iter().map(|name| name.trim().to_owned()).collect();
    let asked = ToSweep {
        quantities: trimmed(&options.quantity),
        at: options.at.iter().map(|at| time("--at", at)).collect(),
        extrema: options.extrema(),
        from: time("--from", &options.from),
        to: options.to.as_ref().map(|to| time("--to", to)),
        contacts: options.contacts,
    };
    let sweep = Sweep { text: &text, name: &name, set: &set, axes: &axes, asked: &asked };
    if let Some(twice) = sweep.twice() {
        return Err(input::two_values(twice));
    }
    let Some(count) = sweep.count() else {
        let message = format!("there are more than {MOST_ROWS} combinations of values");
        return Err(Failure::usage(message, "give fewer values, or sweep in parts"));
    };
    sweep.check()?;
    let file = options.output.as_deref().filter(|file| *file != "-");
    if let Some(file) = file {
        is_table(file)?;
    }
    let mut kept = Kept::open(file, &sweep, count)?;
    let threads = options.threads.map_or_else(cores, usize::from);
    let begun = kept.rows.len();
    if begun > 0 {
        eprintln!("note: {} of {count} are there already", plural(begun, "row"));
    }
    let progress = progress::counted(count);
    progress.set_position(begun as u64);
    sweep.run(begun, threads, |_, row| {
        progress.inc(1);
        kept.add(row)
    })?;
    drop(progress);
    let without = kept.rows.iter().filter(|row| row.contains_key("error")).count();
    if without > 0 {
        let rows = plural(without, "row");
        eprintln!("note: {rows} of {count} not complete: see the column `error`");
    }
    let mut table = Table::default();
    kept.rows.drain(..).for_each(|row| table.push(row));
    table.move_last(&TEXTS);
    let told = match file {
        Some(file) if file.ends_with(".parquet") => {
            let bytes = parquet(&table).map_err(|error| {
                Failure::new(COMPUTATION, format!("no Parquet can be made: {error}"), "ask for CSV")
            })?;
            write_whole(Path::new(file), &bytes)?;
            format!("{file}: {}\n", plural(count, "row"))
        }
        _ => written(table.csv(), file)?,
    };
    kept.remove();
    Ok(told)
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn time(option: &'static str, text: &str) -> Time {
    let label = text.trim().to_owned();
    Time { given: label.clone().into(), label, option }
}

fn is_table(file: &str) -> Result<(), Failure> {
    match Path::new(file).extension().and_then(|end| end.to_str()) {
        Some("csv" | "parquet") => Ok(()),
        _ => {
            let message = format!("`{file}` does not say which kind of table it is");
            Err(Failure::usage(message, "name a file that ends in .csv or .parquet"))
        }
    }
}

/// Rows that are done, in memory and, where the table goes to a file, beside that file until it is there: the request in
/// the first line, then a row each.
struct Kept {
    rows: Vec<Row>,
    beside: Option<(PathBuf, File)>,
}

impl Kept {
    /// With the first rows that the same request has left there.
    fn open(file: Option<&str>, sweep: &Sweep<'_>, count: usize) -> Result<Kept, Failure> {
        let Some(file) = file else { return Ok(Kept { rows: Vec::new(), beside: None }) };
        let path = PathBuf::from(format!("{file}.rows"));
        let request = sweep.request().to_string();
        let rows = rows_of(&path, &request).into_iter().take(count).enumerate();
        let rows = rows.map_while(|(i, row)| sweep.is_row(i, &row).then_some(row));
        let rows: Vec<Row> = rows.collect();
        let whole: String = rows.iter().map(|row| json!(row).to_string() + "\n").collect();
        // A line that was cut off is done again.
        write_whole(&path, format!("{request}\n{whole}").as_bytes())?;
        let opened = OpenOptions::new().append(true).open(&path);
        let beside = opened.map_err(|error| unwritten(&path, &error))?;
        Ok(Kept { rows, beside: Some((path, beside)) })
    }

    fn add(&mut self, row: Row) -> Result<(), Failure> {
        if let Some((path, beside)) = &mut self.beside {
            let line = json!(row).to_string() + "\n";
            beside.write_all(line.as_bytes()).map_err(|error| unwritten(path, &error))?;
        }
        self.rows.push(row);
        Ok(())
    }

    fn remove(self) {
        if let Some((path, _)) = self.beside {
            let _ = fs::remove_file(path);
        }
    }
}

fn unwritten(path: &Path, error: &std::io::Error) -> Failure {
    let message = format!("the file `{}` cannot be written: {error}", path.display());
    Failure::usage(message, "name a file in an existing, writable folder")
}

/// The rows in a file that begins with this request.
fn rows_of(path: &Path, request: &str) -> Vec<Row> {
    let Ok(file) = File::open(path) else { return Vec::new() };
    let mut lines = BufReader::new(file).lines().map_while(Result::ok);
    if lines.next().as_deref() != Some(request) {
        return Vec::new();
    }
    lines.map_while(|line| serde_json::from_str(&line).ok()).collect()
}

/// The table as Parquet: doubles, and text in the last columns.
fn parquet(table: &Table) -> Result<Vec<u8>, ParquetError> {
    let field = |name: &String| {
        let (physical, converted) = match TEXTS.contains(&name.as_str()) {
            true => (Physical::BYTE_ARRAY, ConvertedType::UTF8),
            false => (Physical::DOUBLE, ConvertedType::NONE),
        };
        let field = Type::primitive_type_builder(name, physical)
            .with_converted_type(converted)
            .with_repetition(Repetition::OPTIONAL);
        Ok::<_, ParquetError>(Arc::new(field.build()?))
    };
    let fields = table.columns().iter().map(field).collect::<Result<_, _>>()?;
    let schema = Arc::new(Type::group_type_builder("sweep").with_fields(fields).build()?);
    let mut bytes = Vec::new();
    let mut writer =
        SerializedFileWriter::new(&mut bytes, schema, Arc::new(WriterProperties::default()))?;
    let mut group = writer.next_row_group()?;
    for name in table.columns() {
        let cells = table.rows().iter().map(|row| row.get(name).filter(|cell| !cell.is_null()));
        let known: Vec<i16> = cells.clone().map(|cell| cell.is_some().into()).collect();
        let cells = cells.flatten();
        let mut column = group.next_column()?.expect("a column for each field");
        if TEXTS.contains(&name.as_str()) {
            let texts: Vec<ByteArray> =
                cells.filter_map(Json::as_str).map(ByteArray::from).collect();
            column.typed::<ByteArrayType>().write_batch(&texts, Some(&known), None)?;
        } else {
            let numbers: Vec<f64> = cells.filter_map(Json::as_f64).collect();
            column.typed::<DoubleType>().write_batch(&numbers, Some(&known), None)?;
        }
        column.close()?;
    }
    group.close()?;
    writer.close()?;
    Ok(bytes)
}

//! `generate`: completions and the manual page, from the arguments themselves.

use super::arguments::{Arguments, Generate, Generated};
use super::failure::Failure;
use clap::CommandFactory as _;

pub fn run(options: &Generate) -> Result<String, Failure> {
    let mut command = Arguments::command();
    let shell = match options.what {
        Generated::Completions(shell) => shell,
        Generated::Manual => return manual(command),
        Generated::Options => return Ok(vocabulary(command)),
    };
    let mut out = Vec::new();
    clap_complete::generate(shell, &mut command, "wavestep", &mut out);
    Ok(text(out))
}

/// An option: its name and what its value is called, what it means in the words of the first command that has it, and the
/// commands that have it.
struct Word {
    option: String,
    meaning: String,
    commands: Vec<String>,
}

/// The table of all options.
fn vocabulary(mut command: clap::Command) -> String {
    command.build();
    let mut words: Vec<Word> = Vec::new();
    for subcommand in command.get_subcommands().filter(|own| own.get_name() != "help") {
        for argument in subcommand.get_arguments().filter(|own| !own.is_global_set()) {
            let Some(long) = argument.get_long().filter(|long| *long != "help") else { continue };
            let names = argument.get_value_names().filter(|_| argument.get_action().takes_values());
            let value = names.map_or(String::new(), |names| format!(" {}", names[0]));
            let short = argument.get_short().map_or(String::new(), |short| format!("-{short}, "));
            let option = format!("{short}--{long}{value}");
            let name = subcommand.get_name().to_owned();
            if let Some(known) = words.iter_mut().find(|word| word.option == option) {
                known.commands.push(name);
                continue;
            }
            let meaning = argument.get_help().map(|help| help.to_string()).unwrap_or_default();
            words.push(Word { option, meaning, commands: vec![name] });
        }
    }
    for argument in command.get_arguments().filter(|own| own.is_global_set() && !own.is_hide_set())
    {
        let long = argument.get_long().unwrap_or_default();
        let value = argument.get_value_names().map_or("", |names| &names[0]);
        let meaning = argument.get_help().map(|help| help.to_string()).unwrap_or_default();
        let option = format!("--{long} {value}");
        words.push(Word { option, meaning, commands: vec!["all".to_owned()] });
    }
    words.sort_by_key(|word| word.option.trim_start_matches("-o, ").to_owned());
    let row = |word: &Word| {
        let (meaning, commands) = (word.meaning.replace('|', "\\|"), word.commands.join(", "));
        format!("| `{}` | {meaning} | {commands} |\n", word.option)
    };
    "| Option | Meaning | Commands |\n|---|---|---|\n".to_owned()
        + &words.iter().map(row).collect::<String>()
}

/// One page: the command, then each of its subcommands.
fn manual(command: clap::Command) -> Result<String, Failure> {
    // Without wrapping: man breaks lines itself.
    let mut command = command.term_width(0).disable_help_subcommand(true);
    command.build();
    let mut out = Vec::new();
    let written = |result: std::io::Result<()>| result.expect("memory takes what is written");
    let page = clap_mangen::Man::new(command.clone());
    written(page.render_title(&mut out));
    written(page.render_name_section(&mut out));
    written(page.render_synopsis_section(&mut out));
    written(page.render_description_section(&mut out));
    written(page.render_subcommands_section(&mut out));
    written(page.render_extra_section(&mut out));
    for subcommand in command.get_subcommands() {
        let name = subcommand.get_name().to_owned();
        out.extend(format!(".SH \"WAVESTEP {}\"\n", name.to_uppercase()).into_bytes());
        let page = clap_mangen::Man::new(subcommand.clone());
        for render in [
            clap_mangen::Man::render_synopsis_section,
            clap_mangen::Man::render_description_section,
            clap_mangen::Man::render_options_section,
            clap_mangen::Man::render_extra_section,
        ] {
            let mut section = Vec::new();
            written(render(&page, &mut section));
            // Sections of a subcommand are parts of its own section.
            out.extend(text(section).replace(".SH ", ".SS ").into_bytes());
        }
    }
    let mut page =
        text(out).replace(".SH EXTRA", ".SH EXAMPLES").replace(".SS EXTRA", ".SS EXAMPLES");
    // Examples keep their lines.
    let mut lines: Vec<&str> = Vec::new();
    for line in page.lines().filter(|line| *line != "Examples:") {
        let heading = line.starts_with(".SH ") || line.starts_with(".SS ");
        if heading && lines.iter().rev().find(|l| matches!(**l, ".nf" | ".fi")) == Some(&".nf") {
            lines.push(".fi");
        }
        lines.push(line);
        if heading && line.ends_with("EXAMPLES") {
            lines.push(".nf");
        }
    }
    page = lines.join("\n") + "\n.fi\n";
    for subcommand in command.get_subcommands() {
        // Subcommands have sections here, no pages of their own.
        let name = subcommand.get_name();
        page = page.replace(&format!("wavestep\\-{name}(1)"), &format!("wavestep {name}"));
    }
    Ok(page)
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("what is generated is text")
}

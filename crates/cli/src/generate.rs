//! `generate`: completions and the manual page, from the arguments themselves.

use super::arguments::{Arguments, Generate, Generated};
use super::failure::Failure;
use clap::CommandFactory as _;

pub fn run(options: &Generate) -> Result<String, Failure> {
    let mut command = Arguments::command();
    let Generated::Completions(shell) = options.what else { return manual(command) };
    let mut out = Vec::new();
    clap_complete::generate(shell, &mut command, "wavestep", &mut out);
    Ok(text(out))
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

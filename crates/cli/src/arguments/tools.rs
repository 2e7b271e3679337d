//! Arguments of `scenes` and `generate`.

use super::named;
use clap::Args;
use clap_complete::Shell;

#[derive(Args)]
#[command(after_help = "Examples:\n  wavestep scenes\n  wavestep scenes rigid-mass > mine.wave")]
pub struct Scenes {
    /// Show the text of this scene, with its units and sources
    pub name: Option<String>,
}

#[derive(Args)]
#[command(after_help = "Examples:\n  \
    wavestep generate bash > ~/.local/share/bash-completion/completions/wavestep\n  \
    wavestep generate zsh > ~/.zfunc/_wavestep\n  \
    wavestep generate manual > wavestep.1 && man ./wavestep.1")]
pub struct Generate {
    /// What to write
    #[arg(value_parser = named([
        ("bash", Generated::Completions(Shell::Bash), "Completions for bash"),
        ("elvish", Generated::Completions(Shell::Elvish), "Completions for elvish"),
        ("fish", Generated::Completions(Shell::Fish), "Completions for fish"),
        ("powershell", Generated::Completions(Shell::PowerShell), "Completions for PowerShell"),
        ("zsh", Generated::Completions(Shell::Zsh), "Completions for zsh"),
        ("options", Generated::Options, "A table of all options, as Markdown"),
        ("manual", Generated::Manual, "The manual page, for man"),
    ]))]
    pub what: Generated,
}

/// What `generate` writes.
#[derive(Clone, Copy)]
pub enum Generated {
    Completions(Shell),
    Manual,
    Options,
}

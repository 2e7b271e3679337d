//! Arguments of `scenes` and `generate`.

use clap::{Args, ValueEnum};

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
    #[arg(value_enum)]
    pub what: Generated,
}

/// What `generate` writes.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Generated {
    /// Completions for bash
    Bash,
    /// Completions for elvish
    Elvish,
    /// Completions for fish
    Fish,
    /// Completions for PowerShell
    Powershell,
    /// Completions for zsh
    Zsh,
    /// The manual page, for man
    Manual,
}

//! Commands as a shell reads them: they stand in reports, pictures and code, to make these again.

use super::arguments::Scene;

/// A command on a scene.
pub struct CommandLine(String);

impl CommandLine {
    /// `wavestep NAME SCENE`, with the values that are set.
    pub fn new(name: &str, scene: &Scene) -> Self {
        let line = Self(format!("wavestep {name} {}", quoted(&scene.scene)));
        scene.set.iter().fold(line, |line, set| line.option("--set", set))
    }

    /// The command with an option and its value.
    pub fn option(mut self, name: &str, value: &str) -> Self {
        self.0 += &format!(" {name} {}", quoted(value));
        self
    }

    /// The command with an option, where it has a value.
    pub fn given(self, name: &str, value: Option<&String>) -> Self {
        match value {
            Some(value) => self.option(name, value),
            None => self,
        }
    }

    /// The command with a word that stands for itself.
    pub fn word(mut self, word: &str) -> Self {
        self.0 += &format!(" {}", quoted(word));
        self
    }

    pub fn into_text(self) -> String {
        self.0
    }
}

/// A word as it is, or between quotes where a shell would not read it so.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_=./:+,".contains(c);
    match word.chars().all(plain) && !word.is_empty() {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

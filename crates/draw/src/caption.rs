//! What a reader must know to trust a picture, and to draw it again.

use serde_json::{Map, Value, json};

/// The small print under a picture: how its numbers were obtained.
///
/// Empty fields are left out.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Caption {
    /// The norm in which errors are measured.
    pub norm: String,
    /// The law by which points or problems were chosen.
    pub sampling: String,
    /// Names and versions of what was measured.
    pub versions: Vec<(String, String)>,
    /// The seed of the random choices, if there were any.
    pub seed: Option<u64>,
    /// The command that measures and draws again, the same on every machine.
    pub command: String,
    /// Other remarks: what is left out, and why.
    pub remarks: Vec<String>,
}

impl Caption {
    /// The caption in sentences, in the order norm, sampling, versions, seed, remarks, command.
    pub fn sentences(&self) -> Vec<String> {
        let versions: Vec<String> =
            self.versions.iter().map(|(name, version)| format!("{name} {version}")).collect();
        let seed = self.seed.map(|seed| seed.to_string()).unwrap_or_default();
        let named = [
            ("Norm", self.norm.as_str()),
            ("Sampling", &self.sampling),
            ("Versions", &versions.join(", ")),
            ("Seed", &seed),
        ]
        .map(|(name, text)| (!text.is_empty()).then(|| format!("{name}: {text}.")));
        let mut sentences: Vec<String> = named.into_iter().flatten().collect();
        sentences.extend(self.remarks.iter().cloned());
        if !self.command.is_empty() {
            sentences.push(format!("Drawn again by: {}", self.command));
        }
        sentences
    }

    pub(super) fn json(&self) -> Value {
        let version = |(name, version): &(String, String)| (name.clone(), json!(version));
        json!({
            "norm": self.norm,
            "sampling": self.sampling,
            "versions": self.versions.iter().map(version).collect::<Map<_, _>>(),
            "seed": self.seed,
            "remarks": self.remarks,
            "command": self.command,
        })
    }
}

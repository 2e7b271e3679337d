//! Scenes ready to run, by name.

/// A scene that comes with the library: its name, and its text in the language.
///
/// ```
/// let scene = wavestep::scenes::find("two-bars").unwrap();
/// assert_eq!(scene.name, "two-bars");
/// assert!(scene.text.contains("period 2, local s, time t"));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Scene {
    /// The name.
    pub name: &'static str,
    /// The text.
    pub text: &'static str,
}

/// Every scene: recurrences in the order of the source's sections, then the same four described by
/// their parts, then others of bars and what joins them, then those whose contacts open, and last those
/// with a local contact, which have values and no recurrence.
///
/// ```
/// assert!(wavestep::scenes::SCENES.map(|scene| scene.name).contains(&"rigid-mass"));
/// ```
pub const SCENES: [Scene; 25] = [
    Scene { name: "two-bars", text: include_str!("../scenes/two-bars.wave") },
    Scene { name: "constant-force", text: include_str!("../scenes/constant-force.wave") },
    Scene { name: "pulse-shape", text: include_str!("../scenes/pulse-shape.wave") },
    Scene { name: "rigid-mass", text: include_str!("../scenes/rigid-mass.wave") },
    Scene { name: "striker-on-long-bar", text: include_str!("../scenes/striker-on-long-bar.wave") },
    Scene { name: "pushed-bar", text: include_str!("../scenes/pushed-bar.wave") },
    Scene { name: "cushioned-impact", text: include_str!("../scenes/cushioned-impact.wave") },
    Scene { name: "mass-on-fixed-bar", text: include_str!("../scenes/mass-on-fixed-bar.wave") },
    Scene { name: "struck-free-bar", text: include_str!("../scenes/struck-free-bar.wave") },
    Scene { name: "stepped-striker", text: include_str!("../scenes/stepped-striker.wave") },
    Scene { name: "mass-between-bars", text: include_str!("../scenes/mass-between-bars.wave") },
    Scene { name: "hopkinson", text: include_str!("../scenes/hopkinson.wave") },
    Scene { name: "pile", text: include_str!("../scenes/pile.wave") },
    Scene { name: "percussive-drill", text: include_str!("../scenes/percussive-drill.wave") },
    Scene { name: "incommensurate", text: include_str!("../scenes/incommensurate.wave") },
    Scene { name: "bars-that-part", text: include_str!("../scenes/bars-that-part.wave") },
    Scene {
        name: "bars-of-equal-length",
        text: include_str!("../scenes/bars-of-equal-length.wave"),
    },
    Scene {
        name: "bars-of-unequal-length",
        text: include_str!("../scenes/bars-of-unequal-length.wave"),
    },
    Scene { name: "saint-venant", text: include_str!("../scenes/saint-venant.wave") },
    Scene { name: "mass-on-free-bar", text: include_str!("../scenes/mass-on-free-bar.wave") },
    Scene {
        name: "cushion-with-release",
        text: include_str!("../scenes/cushion-with-release.wave"),
    },
    Scene {
        name: "hopkinson-with-release",
        text: include_str!("../scenes/hopkinson-with-release.wave"),
    },
    Scene { name: "mass-that-bounces", text: include_str!("../scenes/mass-that-bounces.wave") },
    Scene { name: "local-contact", text: include_str!("../scenes/local-contact.wave") },
    Scene { name: "hertz-striker", text: include_str!("../scenes/hertz-striker.wave") },
];

impl Scene {
    /// Its title, which stands in the first line that is no comment.
    pub fn title(&self) -> &'static str {
        let title = self.text.lines().find(|line| !line.starts_with('#')).unwrap_or_default();
        title.split('"').nth(1).unwrap_or_default()
    }
}

/// The scene called `name`.
///
/// ```
/// assert!(wavestep::scenes::find("rigid-mass").is_some());
/// assert_eq!(wavestep::scenes::find("rigid-bar"), None);
/// ```
pub fn find(name: &str) -> Option<&'static Scene> {
    SCENES.iter().find(|scene| scene.name == name)
}

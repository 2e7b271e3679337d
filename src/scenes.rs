//! Scenes ready to run, by name.

/// A scene that comes with the library: its name, and its text in the language.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Scene {
    /// The name.
    pub name: &'static str,
    /// The text.
    pub text: &'static str,
}

/// Every scene, in the order of the source's sections.
pub const SCENES: [Scene; 4] = [
    Scene { name: "two-bars", text: include_str!("../scenes/two-bars.wave") },
    Scene { name: "constant-force", text: include_str!("../scenes/constant-force.wave") },
    Scene { name: "pulse-shape", text: include_str!("../scenes/pulse-shape.wave") },
    Scene { name: "rigid-mass", text: include_str!("../scenes/rigid-mass.wave") },
];

/// The scene called `name`.
///
/// ```
/// assert!(wavestep::scenes::find("rigid-mass").is_some());
/// ```
pub fn find(name: &str) -> Option<&'static Scene> {
    SCENES.iter().find(|scene| scene.name == name)
}

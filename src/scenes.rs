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

/// Every scene, in the order of the source's sections.
///
/// ```
/// use wavestep::language::{Source, read_recurrence};
/// use wavestep::scenes::SCENES;
///
/// assert!(SCENES.map(|scene| scene.name).contains(&"rigid-mass"));
/// for scene in SCENES {
///     read_recurrence(&Source::new(scene.name, scene.text)?, &Default::default())?;
/// }
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
/// assert_eq!(wavestep::scenes::find("rigid-bar"), None);
/// ```
pub fn find(name: &str) -> Option<&'static Scene> {
    SCENES.iter().find(|scene| scene.name == name)
}

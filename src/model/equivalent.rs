//! The linear spring that lets the force of a local contact rise in about the same time.

use crate::model::course::double_root;
use crate::model::error::{ModelError, NotRepresented};
use crate::model::line::{Bar, Law, Line};
use crate::network::{ScaledScene, Side};
use crate::scene::ElementIndex;

const NAME: &str = "equivalent spring";

/// The stiffness `k_1` of the equivalent spring of a local contact, in N/m or as a plain number:
///
/// ```text
/// k_1 S = (k S)^{1/m} V^{1 − 1/m},      S = 1/Z_1 + 1/Z_2
/// ```
///
/// where bars of impedances `Z_1`, `Z_2` meet with the velocity `V`, and `X = k α^m` (6.57 for
/// `m = 3/2`). Both forces then tend to `V/S`, and the contact's `1 − X S/V` and the spring's
/// `e^{−h_1 t}` are functions of the same `h_1 t`, `h_1 = k_1 S`. An end that is fixed is a bar of
/// infinite impedance at rest; a strain at the start adds `X_0/Z` to the velocity of a bar.
///
/// ```
/// use wavestep::language::{Source, read_scene};
/// use wavestep::model::equivalent_stiffness;
/// use wavestep::network::ScaledScene;
///
/// let text = "scene \"A\"\nbar a { impedance = 1, travel = 1, velocity = 8 }\nhertz tip { stiffness = 1/2 }\nbar b { impedance = 1 }\nline free - a - tip - b - endless";
/// let scene = read_scene(&Source::new("text", text)?, &Default::default()).unwrap();
/// // S = 2, k S = 1: k_1 = 8^{1/3}/2.
/// let stiffness = equivalent_stiffness(&ScaledScene::of(&scene).unwrap(), 1).unwrap();
/// assert!((stiffness - 1.0).abs() < 1e-15);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
///
/// # Errors
/// [`ModelError::Refused`] for what is no local contact, where something else stands beside it, and
/// where what it joins does not approach; [`ModelError::MissingValue`] for symbols without values.
pub fn equivalent_stiffness(
    scene: &impl AsRef<ScaledScene>,
    contact: ElementIndex,
) -> Result<f64, ModelError> {
    let scaled = scene.as_ref();
    let refuse = |reason| Err(ModelError::Refused { model: NAME, reason });
    let Some(element) = scaled.scene().elements.get(contact) else {
        return refuse(NotRepresented::NoElement(contact));
    };
    let line = Line::of(scaled)?;
    let name = || element.name.clone();
    let here = |node: &&crate::model::line::Node| {
        node.lumps.iter().any(|lump| lump.name == element.name && matches!(lump.law, Law::Hertz(_)))
    };
    let Some(node) = line.nodes.iter().find(here) else {
        return refuse(NotRepresented::NotALocalContact(name()));
    };
    let [lump] = &node.lumps[..] else {
        return refuse(NotRepresented::NotBetweenBars(name()));
    };
    let Law::Hertz(law) = lump.law else { unreachable!("just seen") };
    // 1/Z, and the velocity that what arrives would give a free end.
    let side = |side: Side, way: usize| match side {
        Side::Bar(bar) => {
            let bar: &Bar = &line.bars[bar];
            Some((1.0 / bar.impedance, 2.0 * bar.before()[way]))
        }
        Side::Fixed => Some((0.0, 0.0)),
        Side::Free => None,
    };
    let (Some(left), Some(right)) = (side(node.left, 0), side(node.right, 1)) else {
        return refuse(NotRepresented::FreeEnd(name()));
    };
    let velocity = left.1 - right.1;
    if velocity <= 0.0 {
        return refuse(NotRepresented::NoApproach(name()));
    }
    let stiffness = law.equivalent_stiffness(left.0 + right.0, velocity);
    let numbers = crate::enclosure::Numbers::new(&scaled.model().constants);
    let scale = &scaled.model().scale;
    let unit = scale.impedance.over(&scale.time)?;
    Ok(stiffness * double_root(&numbers, &unit)?)
}

//! The linear spring that lets the force of a local contact rise in about the same time.

use crate::model::course::double_root;
use crate::model::line::{Bar, Line, LocalContact};
use crate::network::{ScaledScene, Side};
use crate::scene::ElementIndex;

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
/// `None` unless the contact is directly between two such bars that approach each other.
pub fn equivalent_stiffness(scene: &ScaledScene, contact: ElementIndex) -> Option<f64> {
    let line = Line::of(scene).ok()?;
    let mut nodes = line.nodes.iter();
    let (node, place) = nodes.find_map(|node| Some((node, node.place(contact)?)))?;
    let law = LocalContact::of(&node.elements[place].law)?;
    if node.elements.len() > 1 {
        return None;
    }
    // 1/Z, and the velocity that what arrives would give a free end.
    let side = |side: Side, way: usize| match side {
        Side::Bar(bar) => {
            let bar: &Bar = &line.bars[bar];
            Some((1.0 / bar.impedance, 2.0 * bar.before()[way]))
        }
        Side::Fixed => Some((0.0, 0.0)),
        Side::Free => None,
    };
    let (left, right) = (side(node.left, 0)?, side(node.right, 1)?);
    let velocity = left.1 - right.1;
    if velocity <= 0.0 {
        return None;
    }
    let stiffness = law.equivalent_stiffness(left.0 + right.0, velocity);
    let numbers = crate::enclosure::Numbers::new(&scene.model().constants);
    let scale = &scene.model().scale;
    let unit = scale.impedance.over(&scale.time).ok()?;
    Some(stiffness * double_root(&numbers, &unit).ok()?)
}

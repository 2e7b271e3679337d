//! A scene together with its scales, without waves.

use crate::expression::Fraction;
use crate::network::error::NetworkError;
use crate::network::layout::{Contacts, Layout};
use crate::network::measures::{Measured, measures};
use crate::network::model::Model;
use crate::network::node::{ElementLaw, Node, Side};
use crate::scene::{ElementIndex, Kind, Scene};

/// A scene with its model in scales of its own: what models in doubles are made of.
///
/// A [`Network`](crate::network::Network) holds one, and more: the delays, and the laws of waves where every law is linear.
///
/// # Invariants
/// The model is that of the scene, and of nothing else.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ScaledScene {
    pub(in crate::network) scene: Scene,
    pub(in crate::network) model: Model,
    /// Its bars and nodes, with all contacts closed.
    pub layout: Layout,
    /// The observables of the scene, as sums of readings.
    pub measures: Vec<Measured>,
}

impl ScaledScene {
    /// The scene in its own scales.
    pub fn of(scene: &Scene) -> Result<ScaledScene, NetworkError> {
        ScaledScene::with(scene, Model::of(scene)?)
    }

    pub(in crate::network) fn with(
        scene: &Scene,
        mut model: Model,
    ) -> Result<ScaledScene, NetworkError> {
        let layout = Layout::of(scene, &model, Contacts::Closed);
        let measures = measures(scene, &layout, &mut model)?;
        Ok(ScaledScene { scene: scene.clone(), model, layout, measures })
    }

    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The scene in its own scales.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The velocities at the start of all that moves together.
    pub(in crate::network) fn initial_velocities(
        &self,
        node: &Node<Fraction>,
        run: usize,
    ) -> Vec<Fraction> {
        let of_side = |side: Side| match side {
            Side::Bar(bar) => Some(self.model.bars[&self.layout.bars[bar]].velocity.clone()),
            Side::Fixed => Some(Fraction::zero()),
            Side::Free => None,
        };
        let masses = node.attached(run).filter_map(|own| match &own.law {
            ElementLaw::Mass { velocity, .. } => Some(velocity.clone()),
            _ => None,
        });
        node.sides(run).filter_map(of_side).chain(masses).collect()
    }

    /// The first local contact of the line, which makes the scene one without a recurrence; `None`
    /// where every law is linear.
    pub fn local_contact(&self) -> Option<ElementIndex> {
        let is_contact =
            |element: &&ElementIndex| matches!(self.scene.elements[**element].kind, Kind::Hertz(_));
        self.scene.line.elements.iter().find(is_contact).copied()
    }

    /// The contacts whose opening is looked for: all of them, but beside a local one only those that the scene lets open.
    pub fn contacts_that_may_open(&self) -> Contacts {
        match self.local_contact() {
            Some(_) => Contacts::of(&self.scene),
            None => Contacts::Links,
        }
    }
}

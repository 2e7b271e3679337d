//! From a scene to its recurrence.
//!
//! A line of bars and lumped elements is cut into *nodes*, the places between two bars or between a
//! bar and an end. At each node the laws of its elements relate what leaves it to what arrives: with
//! the waves `f` (to the right) and `g` (to the left) in a bar of impedance `Z`, moving with `V` and
//! compressed by `X_0` at the start,
//!
//! ```text
//! v = V + f + g,      X = X_0 + Z (f − g)
//! ```
//!
//! Waves travel from node to node in the travel times of the bars. [`Network::recurrence`] writes the
//! laws as equations between the wave functions of successive periods.
//!
//! A [`ScaledScene`] comes before the network: it is all that models of a scene need. A local contact is not linear: a
//! network with one has no recurrence.

mod assumed;
mod balance;
mod clocks;
mod delay;
mod equations;
mod error;
mod fields;
mod impact;
mod laws;
mod layout;
mod measures;
mod model;
mod node;
mod observe;
mod observed;
mod reading;
mod scaled;
mod system;
mod unfold;

pub use assumed::Assumed;
pub use delay::{Lattice, common_measure};
pub(crate) use equations::{FieldBars, WaveRole};
pub use equations::{Network, Role};
pub use error::NetworkError;
pub use impact::{Impact, NoClosedForm};
pub(crate) use laws::{Law, Rule};
pub use layout::{Contact, Contacts, Layout};
pub use measures::Passage;
pub use measures::{Measured, MeasuredValue};
pub use model::{Model, ModelBar, ModelLoad, Scale};
pub use node::ElementLaw;
pub use node::{Acting, Link, Lumped, Node, Side};
pub(crate) use observed::{Balance, EnergySum, EnergyTerm, Extent, FieldBar, FlowTerm, Squared};
pub use observed::{Observed, ObservedValue, Window};
pub use reading::{Elements, Energy, Face, Field, Lump, Reading, Section, Term};
pub use scaled::ScaledScene;
pub use system::{System, Unresisted, dot, inverse};
pub(crate) use unfold::Unfolded;

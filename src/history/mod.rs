//! Contacts that open and close: what a scene does when they push and never pull.
//!
//! The history of a scene is followed with the method of steps, in which every signal is a Taylor polynomial
//! with a proven rest. Where the force of a contact would become tensile the contact opens, and
//! where a gap closes the contact is formed again; each of these instants is exact or enclosed, and what
//! cannot be decided is refused by name.
//!
//! Read `engine` for the way from cell to cell, `leaving` for what a node sends out, `contacts` for which of them are
//! closed, `reading` for what is taken from it, `crossing` and `positive` for the proof that nothing is passed over,
//! `story` for how events are told, `observe`, `follower` and `phased` for what is seen of it, `validity` for how long closed
//! contacts are true, `closed_form` for instants in closed form, `series` for the arithmetic, `cells` and `memory` for
//! what is kept of it, `pressing` and `power` for local contacts, `resting` for those that press evenly, `passivity` and
//! `passive` for what becomes of errors, at a node and in the line, `energy` for what a wave holds, `body` for energies
//! and momenta of bodies and for why they never meet again, `parting` for what is followed no longer then. `family` follows closed contacts for all values of a symbol at
//! once.

mod body;
pub mod cells;
pub mod closed_form;
mod contacts;
pub mod crossing;
pub mod energy;
mod engine;
mod error;
pub mod family;
mod follower;
#[expect(clippy::module_inception, reason = "the module is named after what it tells")]
mod history;
mod leaving;
pub mod load;
mod memory;
pub mod moment;
pub mod motion;
mod observe;
mod part;
mod parting;
pub mod passive;
pub mod passivity;
mod phased;
pub mod positive;
mod power;
pub mod pressing;
mod reading;
mod resting;
mod separation;
pub mod series;
mod story;
pub mod track;
mod validity;

pub use error::{HistoryError, NotFollowed, Question, When};
pub(crate) use follower::Follower;
pub use history::{Body, ContactSummary, Ending, Event, EventKind, History};
pub(crate) use phased::FollowedSignal;
pub use validity::Validity;
pub(crate) use validity::stays_closed;

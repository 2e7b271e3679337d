//! The places at which fields are given.

use super::FieldError;
use crate::limits::MAX_FIELD_CELLS;
use crate::signal::Limit;
use wavestep_polynomial::Rational;

/// Whether fields are given as values or as averages.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sampling {
    /// The values at the N + 1 nodes `x_j = jL/N`.
    Nodes,
    /// The means `∫ q dx/h` over the N cells between them.
    Averages,
}

/// Each bar divided into equal cells.
///
/// # Invariants
/// - from 1 to [`MAX_FIELD_CELLS`] cells;
/// - a reach is above zero.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mesh {
    pub(super) cells: usize,
    pub(super) sampling: Sampling,
    pub(super) limit: Limit,
    pub(super) bars: Vec<String>,
    pub(super) reach: Option<Rational>,
}

impl Mesh {
    /// All bars with so many cells each, values at nodes, limits from the right.
    pub fn new(cells: usize) -> Result<Mesh, FieldError> {
        match cells {
            1..=MAX_FIELD_CELLS => Ok(Mesh {
                cells,
                sampling: Sampling::Nodes,
                limit: Limit::Right,
                bars: Vec::new(),
                reach: None,
            }),
            _ => Err(FieldError::Cells { cells, limit: MAX_FIELD_CELLS }),
        }
    }

    /// The same with averages over cells.
    #[must_use]
    pub fn averages(self) -> Mesh {
        Mesh { sampling: Sampling::Averages, ..self }
    }

    /// The same with this limit where a field jumps at a node: from larger `x` with
    /// [`Limit::Right`]. At the ends of a bar the limit is always from within.
    #[must_use]
    pub fn with_limit(self, limit: Limit) -> Mesh {
        Mesh { limit, ..self }
    }

    /// The same for this bar and others named in this way.
    #[must_use]
    pub fn only(mut self, bar: &str) -> Mesh {
        self.bars.push(bar.to_owned());
        self
    }

    /// The same with endless bars up to this distance from their end, in the unit of lengths (of times
    /// for bars given by impedance). By default they reach as far as a wave that left their end at the
    /// start.
    pub fn reaching(self, reach: &Rational) -> Result<Mesh, FieldError> {
        match *reach > Rational::default() {
            true => Ok(Mesh { reach: Some(reach.clone()), ..self }),
            false => Err(FieldError::NegativeReach(reach.clone())),
        }
    }
}

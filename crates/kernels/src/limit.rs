//! The two limits of a function at a jump.

/// Which one-sided limit of a function is meant at a jump.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Limit {
    /// From earlier times, or from smaller `x`.
    Left,
    /// From later times, or from larger `x`.
    #[default]
    Right,
}

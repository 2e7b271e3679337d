//! The kernels, a module a capability.

mod echoes;
mod fixed;
mod march;
mod piecewise;
mod random;
mod reference;

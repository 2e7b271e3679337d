//! Doubles at memory speed, with error bounds that are written down.
//!
//! The kernels know nothing of waves: they evaluate polynomials, sum series and march recurrences in
//! the machine's own numbers, and say by how much the results can be off. What they are given is
//! derived and proven elsewhere.

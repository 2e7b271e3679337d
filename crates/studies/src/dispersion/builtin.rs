//! Dispersion relations that have names.

use super::read::read_relation;
use super::relation::Relation;
use wavestep::language::Source;

/// Relations that have names. Lengths and times are in units in which long waves of the string have
/// velocity 1, unless another is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builtin {
    String,
    /// Masses on springs, at unit distances.
    Lattice,
    /// Two terms of a relation that is concave downwards.
    Cubic,
    /// A string with bending stiffness, concave upwards.
    StiffString,
    /// Euler's and Bernoulli's beam in units of its own, `EI/(ρA) = 1`.
    Beam,
    /// `κ = ν² r²`: a bar with the inertia of its lateral motion, `ν` Poisson's ratio, `r` the polar radius of
    /// gyration.
    Love,
}

impl Builtin {
    pub const ALL: [Builtin; 6] =
        [Self::String, Self::Lattice, Self::Cubic, Self::StiffString, Self::Beam, Self::Love];

    /// Its name, `ω(k)`, and what it describes.
    const fn words(self) -> [&'static str; 3] {
        match self {
            Self::String => ["string", "k", "a string, or a bar of long waves: no dispersion"],
            Self::Lattice => {
                ["lattice", "2*sin(k/2)", "a chain of masses and springs at unit distances"]
            }
            Self::Cubic => {
                ["cubic", "k - k^3/12", "two terms of a relation that is concave downwards"]
            }
            Self::StiffString => [
                "stiff-string",
                "k*sqrt(1 + k^2/12)",
                "a string with bending stiffness, concave upwards",
            ],
            Self::Beam => ["beam", "k^2", "bending waves of a thin beam"],
            Self::Love => [
                "love",
                "k/sqrt(1 + kappa*k^2)",
                "a bar with lateral inertia, kappa = (Poisson's ratio · polar radius of gyration)^2",
            ],
        }
    }

    pub const fn name(self) -> &'static str {
        self.words()[0]
    }

    pub const fn title(self) -> &'static str {
        self.words()[2]
    }

    pub fn find(name: &str) -> Option<Builtin> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }

    pub fn relation(self) -> Relation {
        let [name, formula, _] = self.words();
        let source = Source::new(name, formula).expect("a short text");
        read_relation(&source, &Default::default()).expect("a formula in k")
    }
}

//! What is observed of a line, in words and by the solver in doubles.

use crate::chance::Chance;
use crate::scene::{Element, Measure, Quotient, Scene};
use crate::solver::Solver;

/// Where it is seen.
#[derive(Clone, Copy, Debug)]
enum Section {
    /// Of an element with one place, or at an end of a bar.
    Side(usize),
    At(Quotient),
}

/// Something that is observed, and where it is seen.
#[derive(Clone, Copy, Debug)]
pub struct Observed {
    measure: Measure,
    element: usize,
    section: Section,
}

impl Observed {
    /// All that the solver can tell of a scene.
    pub fn all(scene: &Scene, solver: &Solver, chance: &mut Chance) -> Vec<Observed> {
        use Measure::{Compression, Displacement, Force, Strain, Velocity};
        let mut all = Vec::new();
        for (element, own) in scene.elements.iter().enumerate() {
            let measures: &[Measure] = match own {
                Element::Bar { .. } if scene.is_sectioned(element) => {
                    &[Velocity, Force, Displacement, Strain]
                }
                Element::Bar { .. } => &[Velocity, Force, Displacement],
                Element::Mass { .. } => &[Velocity, Displacement],
                Element::Spring { .. } => &[Force, Compression],
                _ => &[],
            };
            let sides = (0..2).filter(|side| solver.ends(element)[*side]).map(Section::Side);
            let mut sections: Vec<Section> = sides.collect();
            if let Element::Bar { travel: Some(_), .. } = own {
                sections.push(Section::At(chance.one_of(&[(1, 2), (1, 3), (4, 5), (1, 7)])));
            }
            let seen = sections.into_iter().flat_map(|section| {
                measures.iter().map(move |measure| Observed { measure: *measure, element, section })
            });
            all.extend(seen);
        }
        all
    }

    /// Its reading, `force(e1.left)`.
    pub fn text(&self, scene: &Scene) -> String {
        let section = match (self.section, &scene.elements[self.element]) {
            (Section::At(share), _) => format!(".at({share})"),
            (Section::Side(side), Element::Bar { .. }) => [".left", ".right"][side].to_owned(),
            _ => String::new(),
        };
        format!("{}(e{}{section})", self.measure.word(), self.element)
    }

    /// What it is in the unit of the language where the solver has 1.
    pub fn unit(&self, scene: &Scene) -> f64 {
        scene.unit(self.measure)
    }

    /// Its value in doubles.
    pub fn at(&self, solver: &Solver, scene: &Scene, time: f64) -> f64 {
        let Observed { measure, element, section } = *self;
        let [velocity, force, moved]: [&dyn Fn() -> f64; 3] = match section {
            Section::Side(side) => [
                &move || solver.velocity(element, side, time),
                &move || solver.force(element, side, time),
                &move || solver.moved(element, side, time),
            ],
            Section::At(share) => [
                &move || solver.within(element, share.value(), time)[0],
                &move || solver.within(element, share.value(), time)[1],
                &move || solver.moved_within(element, share.value(), time),
            ],
        };
        match (measure, &scene.elements[element]) {
            (Measure::Velocity, _) => velocity(),
            (Measure::Force, _) => force(),
            (Measure::Displacement, _) => moved(),
            (Measure::Strain, Element::Bar { impedance, .. }) => -force() / impedance.value(),
            (Measure::Compression, _) => solver.compression(element, time),
            _ => unreachable!("no measure of this element"),
        }
    }

    /// How large errors of its value may be where the largest is 1 of the line.
    pub fn size(&self, scene: &Scene, time: f64) -> f64 {
        match self.measure {
            Measure::Force => scene.largest(),
            Measure::Displacement | Measure::Compression => 1.0 + time,
            _ => 1.0,
        }
    }
}

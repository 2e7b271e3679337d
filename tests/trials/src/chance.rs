//! What scenes are drawn from.

use crate::scene::{Element, End, Load, Quotient, Scene, Size, UNITS};
use std::collections::BTreeMap;

/// Numbers without an end (splitmix64).
pub struct Chance(u64);

/// Numbers of one size.
const COMMON: [(i64, i64); 10] =
    [(1, 1), (2, 1), (1, 2), (3, 2), (3, 1), (2, 3), (5, 4), (7, 5), (1, 3), (4, 1)];

/// Numbers that are far apart, or have little in common.
const RARE: [(i64, i64); 12] = [
    (1, 1000),
    (1000, 1),
    (1, 40),
    (25, 1),
    (7, 11),
    (13, 17),
    (101, 100),
    (99, 100),
    (1, 97),
    (355, 113),
    (999, 1000),
    (22, 7),
];

impl Chance {
    /// Those of a trial.
    pub fn of(number: u64) -> Chance {
        Chance(number << 32)
    }

    pub fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % count as u64) as usize
    }

    pub fn is(&mut self, one_in: usize) -> bool {
        self.below(one_in) == 0
    }

    pub fn one_of(&mut self, all: &[(i64, i64)]) -> Quotient {
        let (over, under) = all[self.below(all.len())];
        Quotient(over, under)
    }

    /// A positive number.
    pub fn size(&mut self) -> Quotient {
        self.one_of(&COMMON)
    }

    /// The velocity of an element; those at the left come, those at the right stand still or come too.
    fn velocity(&mut self, is_left: bool) -> Quotient {
        match is_left {
            true => self.one_of(&[(1, 1), (1, 1), (2, 3), (0, 1), (5, 7)]),
            false => self.one_of(&[(0, 1), (0, 1), (-1, 2), (-1, 1), (1, 3)]),
        }
    }

    fn load(&mut self) -> Load {
        let until = self.is(2).then(|| self.one_of(&[(5, 2), (4, 1), (17, 3), (20, 1)]));
        let is_short = self.is(2);
        let none = Quotient::ZERO;
        let turns = if self.is(3) { self.one_of(&[(1, 1), (2, 1), (1, 2), (2, 3)]) } else { none };
        let strength = self.one_of(&[(1, 4), (-1, 4), (1, 10), (1, 2), (-1, 3)]);
        Load {
            is_imposed: self.is(4),
            constant: strength,
            slope: if is_short { self.one_of(&[(1, 2), (-1, 2), (0, 1)]) } else { none },
            rate: if is_short { self.one_of(&[(1, 1), (1, 2), (2, 1)]) } else { none },
            turns,
            from: self.one_of(&[(0, 1), (0, 1), (1, 2), (7, 3)]),
            until,
        }
    }

    fn element(&mut self, is_left: bool) -> Element {
        let none = Quotient::ZERO;
        let damping = |own: &mut Self| if own.is(3) { own.size() } else { none };
        match self.below(9) {
            0..4 => Element::Bar {
                impedance: self.size(),
                travel: Some(self.size().into()),
                velocity: self.velocity(is_left),
                strain: if self.is(6) { self.one_of(&[(1, 3), (-1, 2)]) } else { none },
            },
            4 | 5 => Element::Mass { mass: self.size(), velocity: self.velocity(is_left) },
            6 => Element::Spring { stiffness: self.size(), damping: damping(self) },
            7 => Element::Support { stiffness: self.size(), damping: damping(self) },
            _ => Element::Load(self.load()),
        }
    }

    /// A line of two to five elements whose contacts open, which may make no sense.
    pub fn open_scene(&mut self) -> Scene {
        let count = 2 + self.below(4);
        let mut scene = self.scene(count);
        for joint in 0..=count {
            if scene.joints[joint] && self.is(4) {
                let gap = self.one_of(&[(1, 4), (1, 10), (1, 1), (2, 3), (1, 50)]);
                scene.gaps.insert(joint, gap);
            }
        }
        scene
    }

    fn scene(&mut self, count: usize) -> Scene {
        let first = self.below(count + 1);
        let mut elements: Vec<Element> = (0..count).map(|at| self.element(at < first)).collect();
        let joints: Vec<bool> =
            (0..=count).map(|at| at == first || at > 0 && at < count && self.is(4)).collect();
        let mut end = |element: &mut Element, may_hold: bool| match element {
            Element::Bar { travel, .. } if self.is(6) => {
                *travel = None;
                End::Endless
            }
            _ if may_hold && self.is(2) => End::Fixed,
            _ => End::Free,
        };
        let (may_hold_left, may_hold_right) = (first == 0 || count > 3, true);
        let left = end(&mut elements[0], may_hold_left);
        let right = end(&mut elements[count - 1], may_hold_right);
        let ends = [left, right];
        let gaps = BTreeMap::new();
        Scene { ends, elements, joints, gaps, opens: true, units: None, symbols: Vec::new() }
    }

    /// A line whose contacts stay closed, with numbers of all sizes.
    pub fn closed_scene(&mut self) -> Scene {
        let count = 2 + self.below(3);
        let mut scene = Scene { opens: false, ..self.scene(count) };
        for element in &mut scene.elements {
            match element {
                Element::Bar { impedance, travel, .. } => {
                    self.vary(impedance, 6);
                    if let (Some(travel), true) = (travel, self.is(12)) {
                        travel.quotient =
                            self.one_of(&[(1, 40), (25, 1), (7, 11), (13, 17), (99, 100), (22, 7)]);
                    }
                }
                Element::Mass { mass, .. } => self.vary(mass, 8),
                Element::Spring { stiffness, damping }
                | Element::Support { stiffness, damping } => {
                    self.vary(stiffness, 8);
                    if damping.0 != 0 {
                        self.vary(damping, 8);
                        *stiffness = if self.is(4) { Quotient::ZERO } else { *stiffness };
                    }
                }
                Element::Load(_) => {}
            }
        }
        scene
    }

    fn vary(&mut self, size: &mut Quotient, one_in: usize) {
        if self.is(one_in) {
            *size = self.one_of(&RARE);
        }
    }

    /// The same in units.
    pub fn in_units(&mut self, scene: Scene) -> Scene {
        let mut scene = Scene { units: Some(&UNITS[self.below(2)]), ..scene };
        for number in 0..scene.elements.len() {
            let is_sectioned = scene.is_sectioned(number);
            if let (Element::Bar { strain, .. }, false) =
                (&mut scene.elements[number], is_sectioned)
            {
                *strain = Quotient::ZERO;
            }
        }
        scene
    }

    /// Travel times of different roots; some of them are roots of the same number.
    pub fn without_measure(&mut self, mut scene: Scene) -> Scene {
        for element in &mut scene.elements {
            if let Element::Bar { travel: Some(Size { root, .. }), .. } = element {
                *root = [1, 2, 3, 5, 7][self.below(5)];
            }
        }
        scene
    }

    /// One to three of its numbers as symbols; a travel time where it is the only one.
    pub fn with_symbols(&mut self, mut scene: Scene) -> Scene {
        let mut all = Vec::new();
        let finite = |own: &&Element| matches!(own, Element::Bar { travel: Some(_), .. });
        let is_single = scene.elements.iter().filter(finite).count() == 1;
        for (number, element) in scene.elements.iter().enumerate() {
            match element {
                Element::Bar { impedance, travel, velocity, .. } => {
                    all.push((number, "impedance", *impedance));
                    all.push((number, "velocity", *velocity));
                    let single = travel.filter(|_| is_single);
                    all.extend(single.map(|travel| (number, "travel", travel.quotient)));
                }
                Element::Mass { mass, velocity } => {
                    all.extend([(number, "mass", *mass), (number, "velocity", *velocity)]);
                }
                Element::Spring { stiffness, .. } if stiffness.0 != 0 => {
                    all.push((number, "stiffness", *stiffness));
                }
                _ => {}
            }
        }
        for _ in 0..=self.below(2) {
            if !all.is_empty() {
                let at = self.below(all.len());
                scene.symbols.push(all.swap_remove(at));
            }
        }
        scene
    }
}

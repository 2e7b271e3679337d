//! Local contacts with proof: `X = F (α/α₁)^m` while they are compressed.
//!
//! On a cell the motion of a node beside a pressed local contact has Taylor coefficients from
//! `α X' = m α' X`. A box that the integral operator of the equations maps into itself (Picard) holds the motion
//! on a disc of complex times, so that what the coefficients leave out is a geometric series (Cauchy).
//!
//! Errors. Near the beginning and the end of a contact the force is no power series in time. While it is below
//! the precision the contact is *light*: its force is taken to be zero, and what it may be pushes as an error does.
//! Else an error `e` of the compression changes the force by `S e`, with a secant stiffness `S` between the least and
//! the largest `X'` of the cell. With a spring `K` in place of the contact errors do not grow in the norm of the energy;
//! the difference pushes with `|S − K| |e|`, so that they grow as `e^(λt)`, `λ = max |S − K| |B|/√K` (Gronwall). So `K`
//! follows `X'` from cell to cell; where it becomes larger, so does the norm, by the square root at most. Where nothing
//! but the contact acts on the compression, as between two bars, more compression means more resistance, and errors do
//! not grow at all.

use crate::ball::{BallError, Magnitude, Number};
use crate::history::motion::{Added, Course, Given, Motion};
use crate::history::passivity::{Block, Known, StateError};
use crate::history::power::{PowerLaw, PowerSeries};
use crate::history::series::{CellNorm, Roughness, Series, Truncation};
use crate::network::{ElementLaw, Node, System};
use crate::signal::Signed;
use num_traits::ToPrimitive as _;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// The precision of bounds.
const BITS: u64 = 64;

/// The radius of the disc of times is this power of two times the length of the cell.
const REACH: i64 = 2;

/// So often a disc is made smaller in search of one that the motion stays in.
const MOST_DISCS: usize = 4096;

/// A disc is cut into this power of two of rings.
const RINGS: i64 = 3;

/// So often a box is made larger before its disc is taken to be too large.
const MOST_BOXES: usize = 24;

/// `K` is kept while `X'`, within these limits, is within this fraction of it.
const NEAR: f64 = 1.0 / 4096.0;

/// The error of a compression is assumed to be below one of these powers of two times it.
const TIGHT: i64 = -20;
const LOOSE: i64 = -5;

/// A contact is light at the start of a cell whose compression is this power of two times the largest light one.
const LIGHT_AT_START: i64 = -4;

/// A local contact that is pressed, in the system of its node.
#[derive(Clone, Debug)]
pub struct Pressed {
    pub law: PowerLaw,
    /// Where its compression stands in the state, and its force in the input.
    pub state: usize,
    pub input: usize,
    /// `K`, the stiffness of the spring that it is compared with, and its share of the largest.
    pub stiffness: Number,
    share: f64,
}

impl Pressed {
    /// The pressed contacts of a node, each with its spring: `K` about `X'` at the state `now`, the largest without one.
    pub fn all(
        node: &Node<Number>,
        system: &System<Number>,
        now: Option<&[Number]>,
    ) -> Result<Vec<Pressed>, BallError> {
        let mut all = Vec::new();
        for ((own, kept), driven) in node.elements.iter().zip(&system.kept).zip(&system.driven) {
            let ElementLaw::LocalContact { force, compression, exponent } = &own.law else {
                continue;
            };
            let (Some(state), Some(input)) = (*kept, *driven) else { continue };
            let (force, compression) = (force.clone(), compression.clone());
            let law = PowerLaw { force, compression, exponent: exponent.clone() };
            let share = now.map_or(1.0, |now| law.share(&now[state]));
            let part = Number::Exact(Rational::from_float(share).expect("a share is finite"));
            let stiffness = law.largest_spring()?.multiply(&part, BITS);
            all.push(Pressed { law, state, input, stiffness, share });
        }
        Ok(all)
    }

    /// Whether its spring is about as stiff as it is itself at a state.
    pub fn is_near(&self, now: &[Number]) -> bool {
        (self.law.share(&now[self.state]) / self.share - 1.0).abs() <= NEAR
    }
}

impl Node<Number> {
    /// The same node, its local contacts given by the force at a compression that is about the largest they come to
    /// where they stop what moves with this velocity: of a mass `α F = ½ (m+1) M v²`, of a bar `F = Z v`.
    pub fn with_typical_compressions(
        mut self,
        velocity: f64,
        bits: u64,
    ) -> Result<Node<Number>, BallError> {
        let double = |number: &Number| number.ball(BITS).to_double().0;
        let least = |sizes: Vec<f64>| {
            sizes.into_iter().filter(|size| *size > 0.0).fold(f64::INFINITY, f64::min)
        };
        let impedance = least(self.impedance.iter().map(double).collect());
        let masses = (0..self.runs()).map(|run| double(&self.mass_of(run, BITS)));
        let mass = least(masses.collect());
        for own in &mut self.elements {
            let ElementLaw::LocalContact { force, compression, exponent } = &mut own.law else {
                continue;
            };
            let (at, m) = (double(compression), exponent.to_f64().unwrap_or(1.0));
            let softness = at.powf(m) / double(force);
            let of_bar = (softness * impedance * velocity).powf(1.0 / m);
            let energy = 0.5 * mass * velocity * velocity;
            let of_mass = ((m + 1.0) * softness * energy).powf(1.0 / (m + 1.0));
            let typical = Rational::from_float(of_bar.min(of_mass).log2().round().exp2());
            let Some(typical) = typical.filter(|typical| *typical > Rational::default()) else {
                continue;
            };
            let law = PowerLaw {
                force: force.clone(),
                compression: compression.clone(),
                exponent: exponent.clone(),
            };
            let law = law.at(&typical, bits)?;
            (*force, *compression) = (law.force, law.compression);
        }
        Ok(self)
    }
}

/// A cell is longer than the motion beside a local contact can be followed at once: it may be as long as this.
#[derive(Clone, PartialEq, Debug)]
pub struct TooLong(pub Rational);

impl TooLong {
    /// A length of few bits, no longer than this part of a magnitude.
    fn than(length: &Magnitude) -> TooLong {
        let (mantissa, exponent) = length.parts();
        let few =
            Magnitude::power_of_two(exponent + 28).multiply(&Magnitude::from_u64(mantissa >> 28));
        TooLong(Rational::from(&few))
    }
}

/// What a contact is on a cell.
#[derive(Clone, Debug)]
pub(super) struct Compressed {
    /// Its place among the members of its block.
    pub(super) place: usize,
    /// The compression at the start, without its error.
    pub(super) start: Magnitude,
    /// That error; none where it is exactly zero.
    pub(super) off: Magnitude,
    /// How large it is taken to become at most, which `course` checks with the bound that follows, so that there is no
    /// first time at which it is larger.
    assumed: Magnitude,
    /// Whether it is known to be compressed then.
    is_compressed: bool,
    pub(super) is_light: bool,
    /// How far the compression may go from where it starts.
    most: Magnitude,
    /// Bounds of the force and of `|X'|` then; zero for a light one.
    force: Magnitude,
    pub(super) stiffest: Magnitude,
}

/// A box on a disc of times.
struct Picard {
    radius: Magnitude,
    /// How far each member may go from where it starts, and how far on the cell.
    sizes: Vec<Magnitude>,
    on_cell: Vec<Magnitude>,
}

impl System<Number> {
    /// The same with springs in place of local contacts.
    pub fn stiffened(&self, pressed: &[Pressed], bits: u64) -> System<Number> {
        let mut system = self.clone();
        for own in pressed {
            for row in system.change.iter_mut().chain(&mut system.output) {
                let pushed = row[self.states() + own.input].multiply(&own.stiffness, bits);
                row[own.state] = row[own.state].add(&pushed, bits);
            }
        }
        system
    }

    /// Solves the equations on a cell, `(k+1) y_(k+1) = A y_k + B u_k`. The forces of local contacts that are pressed are
    /// added to the input.
    ///
    /// # Errors
    /// [`TooLong`], beside pressed local contacts only.
    ///
    /// # Cost
    /// N times the products of small matrices with vectors, and `N²` products for each pressed contact.
    pub fn solve(
        &self,
        known: Known<'_>,
        input: &mut [Series],
        (norm, cut): (&CellNorm, &Truncation),
    ) -> Result<Motion, TooLong> {
        let given = Given::new(input, norm, cut);
        let (mut courses, mut forces) = (Vec::new(), Vec::new());
        for (block, own, error) in known.blocks() {
            if block.pressed.is_empty() {
                courses.push(self.course(block, own, error, &given));
                continue;
            }
            let pressing = self.pressing(block, &given);
            if let Some(columns) = pressing.untouched(&own) {
                courses.push(Course::exact(columns));
                continue;
            }
            let (course, own) = match pressing.resting_course(&own, error) {
                Some(resting) => resting,
                None => pressing.course(&own, error)?,
            };
            courses.push(course);
            forces.extend(block.pressed.iter().map(|pressed| pressed.input).zip(own));
        }
        for (place, force) in forces {
            input[place] = force;
        }
        Ok(self.motion(known.passivity, (known.state, courses), input, cut))
    }

    pub(super) fn pressing<'a>(&'a self, block: &'a Block, given: &'a Given<'a>) -> Pressing<'a> {
        Pressing { system: self, block, given }
    }
}

/// A block of a node with local contacts, on a cell.
pub(super) struct Pressing<'a> {
    pub(super) system: &'a System<Number>,
    pub(super) block: &'a Block,
    pub(super) given: &'a Given<'a>,
}

/// What is known of the errors on a cell.
struct Bounds {
    /// Of the state, in the norm of its energy and of this roughness.
    rest: Magnitude,
    roughness: Option<Roughness>,
    /// Of light contacts, the largest force.
    light: Vec<Magnitude>,
    /// The share of the bounds of the motion that its coefficients leave out.
    left_out: Magnitude,
    added: Added,
}

/// The coefficients of the members and of the forces.
type Columns = (Vec<Vec<Number>>, Vec<Vec<Number>>);

impl Pressing<'_> {
    /// The courses of the block and of the forces of its contacts.
    fn course(&self, own: &[Number], error: &StateError) -> Result<(Course, Vec<Series>), TooLong> {
        let norm = self.given.norm;
        let (start, rounding) = self.block.rounded(own, self.given.cut.bits);
        let at_start = error.size().add(&rounding);
        let mut doubted: Vec<usize> = Vec::new();
        loop {
            let contacts = self.compressed((own, &start), &at_start, &doubted)?;
            let rates = self.rates_at_start(&start, &contacts)?;
            let radius = norm.length.scale(REACH);
            let Some(picard) = self.picard(&rates, &contacts, &radius) else {
                return Err(self.shorter(&rates, &contacts, radius));
            };
            let is_pushed = |own: &Compressed| own.is_light && !picard.reached(own).is_zero();
            let distance = match contacts.iter().any(is_pushed) {
                true => Magnitude::ZERO,
                false => self.distance(&contacts),
            };
            let (columns, forces) = self.coefficients(&start, &contacts, &picard, &distance)?;
            let left_out = picard.left_out(&norm.length.add(&distance), columns.len());
            let bounds =
                self.bounds(&contacts, &picard, (&at_start, &rounding), &distance, left_out)?;
            // A compression that is not known to be positive presses as a light one may.
            let is_doubtful =
                |own: &&Compressed| self.block.entry(own.place, &bounds.rest) > own.assumed;
            let heavy = contacts.iter().filter(|own| !own.is_light);
            let doubtful: Vec<usize> = heavy.filter(is_doubtful).map(|own| own.place).collect();
            if doubtful.is_empty() {
                let forces = self.forces(&contacts, forces, &bounds);
                let Bounds { rest, added, roughness, .. } = bounds;
                let (error, fresh) = (rest, rest);
                let course = Course { columns, rest, error, fresh, at_start, added, roughness };
                return Ok((course, forces));
            }
            doubted.extend(doubtful);
        }
    }

    /// The exact motion where no contact is compressed all the while.
    fn untouched(&self, own: &[Number]) -> Option<Vec<Vec<Number>>> {
        let columns = self.system.exact_columns(self.block, own, self.given)?;
        let places: Vec<usize> =
            self.block.pressed.iter().map(|pressed| self.place_of(pressed)).collect();
        let is_untouched =
            |column: &Vec<Number>| places.iter().all(|place| column[*place].is_zero());
        columns.iter().all(is_untouched).then_some(columns)
    }

    /// A shorter cell may do where a bound is not found.
    fn unknown(&self) -> TooLong {
        TooLong::than(&self.given.norm.length.scale(-1))
    }

    /// What the contacts are on the cell; those in places that were doubted once may have large errors, twice are light.
    pub(super) fn compressed(
        &self,
        (own, start): (&[Number], &[Number]),
        error: &Magnitude,
        doubted: &[usize],
    ) -> Result<Vec<Compressed>, TooLong> {
        let mut all = Vec::new();
        for pressed in &self.block.pressed {
            let place = self.place_of(pressed);
            let (from, off) = (start[place].magnitude(), self.block.entry(place, error));
            let largest = pressed.law.light(self.given.cut.bits);
            let is_positive = start[place].sign() == Some(Ordering::Greater);
            let is_compressed = is_positive && off < from;
            let doubts = doubted.iter().filter(|doubted| **doubted == place).count();
            let is_light = doubts > 1
                || !is_positive
                || from < largest.scale(LIGHT_AT_START)
                || off.scale(6) > from;
            let (most, force, stiffest) = if is_light {
                // The disc reaches `2^REACH` cells: room for a cell in which the compression falls to zero.
                (largest.max(from.scale(4)).max(off.scale(4)), Magnitude::ZERO, Magnitude::ZERO)
            } else {
                let most = from.multiply(&Magnitude::from_u64(7)).scale(-3);
                let ends = [&from.scale(-4), &from.scale(1)];
                let force = pressed.law.bound(ends[1]).map_err(|_| self.unknown())?;
                (most, force, pressed.law.stiffest(ends).map_err(|_| self.unknown())?)
            };
            let start = from;
            let is_tight = doubts == 0 && off.scale(4) < from.scale(TIGHT);
            let assumed = from.scale(if is_tight { TIGHT } else { LOOSE });
            let off = if own[place].is_zero() { Magnitude::ZERO } else { off };
            all.push(Compressed {
                place,
                start,
                off,
                assumed,
                is_compressed,
                is_light,
                most,
                force,
                stiffest,
            });
        }
        Ok(all)
    }

    pub(super) fn place_of(&self, pressed: &Pressed) -> usize {
        let place = self.block.members.iter().position(|member| *member == pressed.state);
        place.expect("a contact of the block")
    }

    /// What the contacts are, each with its law.
    pub(super) fn each<'b>(
        &'b self,
        contacts: &'b [Compressed],
    ) -> impl Iterator<Item = (&'b Compressed, &'b Pressed)> {
        contacts.iter().zip(&self.block.pressed)
    }

    /// `|y'|` of each member at the start.
    fn rates_at_start(
        &self,
        start: &[Number],
        contacts: &[Compressed],
    ) -> Result<Vec<Magnitude>, TooLong> {
        let mut input = self.given.coefficients(0);
        for (own, law) in self.each(contacts).filter(|(own, _)| !own.is_light) {
            input[law.input] =
                law.law.value(&start[own.place], BITS).map_err(|_| self.unknown())?;
        }
        let rates = self.system.next(self.block, start, (0, input), BITS);
        Ok(rates.iter().map(Number::magnitude).collect())
    }

    /// A box in which the motion for the polynomials of the inputs stays on a disc of times, where it is found. It is found
    /// ring by ring: on one of width `w` a motion that begins within `s` stays within `s + w · |y'|`, where `|y'|` is at most
    /// its value at the start plus what moving within that box adds.
    fn picard(
        &self,
        rates: &[Magnitude],
        contacts: &[Compressed],
        radius: &Magnitude,
    ) -> Option<Picard> {
        let states = self.system.states();
        let changes_of = |series: &Series| series.size_from(1, radius).multiply(radius);
        let mut inputs: Vec<Magnitude> = self.given.settled.iter().map(changes_of).collect();
        for own in &self.block.pressed {
            inputs[own.input] = Magnitude::ZERO;
        }
        let product = |row: &[Number], column: &[Magnitude]| {
            let terms = row.iter().zip(column).map(|(a, x)| a.magnitude().multiply(x));
            terms.fold(Magnitude::ZERO, |sum, term| sum.add(&term))
        };
        let rows: Vec<&Vec<Number>> =
            self.block.members.iter().map(|member| &self.system.change[*member]).collect();
        let given: Vec<Magnitude> = (rows.iter().zip(rates))
            .map(|(row, rate)| rate.add(&product(&row[states..], &inputs)))
            .collect();
        let width = radius.scale(-RINGS);
        let mut reached = vec![Magnitude::ZERO; rates.len()];
        let mut on_cell = Vec::new();
        for ring in 0..1 << RINGS {
            // So many rings are as wide as the cell.
            if ring == 1 << (RINGS - REACH) {
                on_cell.clone_from(&reached);
            }
            let mut sizes = reached.clone();
            let mut boxes = 0..MOST_BOXES;
            reached = loop {
                boxes.next()?;
                let mut moved = vec![Magnitude::ZERO; states + inputs.len()];
                for (member, size) in self.block.members.iter().zip(&sizes) {
                    moved[*member] = *size;
                }
                for (own, law) in self.each(contacts) {
                    moved[states + law.input] = own.stiffest.multiply(&sizes[own.place]);
                }
                let changes =
                    rows.iter().zip(&given).zip(&reached).map(|((row, given), reached)| {
                        product(row, &moved).add(given).multiply(&width).add(reached)
                    });
                let changes: Vec<Magnitude> = changes.collect();
                if contacts.iter().any(|own| changes[own.place] > own.most) {
                    return None;
                }
                if changes.iter().zip(&sizes).all(|(change, size)| change <= size) {
                    break changes;
                }
                sizes = changes.iter().map(|change| change.add(&change.scale(-5))).collect();
            };
        }
        Some(Picard { radius: *radius, sizes: reached, on_cell })
    }

    /// A length of which a disc is small enough.
    fn shorter(&self, rates: &[Magnitude], contacts: &[Compressed], radius: Magnitude) -> TooLong {
        let is_kept = |radius: &Magnitude| self.picard(rates, contacts, radius).is_some();
        let mut radius = radius;
        for _ in 0..MOST_DISCS {
            radius = radius.scale(-1);
            if is_kept(&radius) {
                break;
            }
        }
        // Between this disc and the last one there may be a larger one.
        let larger = [15_u64, 13, 11, 9];
        let larger = larger.map(|part| radius.multiply(&Magnitude::from_u64(part)).scale(-3));
        let radius = larger.into_iter().find(is_kept).unwrap_or(radius);
        TooLong::than(&radius.scale(-REACH))
    }

    /// Within which distance of the cell errors are bounded: half of that of the inputs, half of a cell, and less than
    /// they grow to `e` times in.
    pub(super) fn distance(&self, contacts: &[Compressed]) -> Magnitude {
        let norm = self.given.norm;
        let mut rate = self.block.rate;
        for (own, law) in self.each(contacts) {
            let stiffness = law.stiffness.magnitude().add(&own.stiffest);
            rate = rate.add(&self.pushed_back(law, &stiffness));
        }
        let mut distance = norm.length.scale(-1);
        if let Some(roughness) = norm.roughness {
            distance = distance.min(roughness.distance().scale(-1));
        }
        let one = Magnitude::power_of_two(0);
        while rate.multiply(&distance) > one {
            distance = distance.scale(-1);
        }
        Roughness::within(&distance, self.given.cut).distance()
    }

    /// `S |B|/√K`: how fast an error of the compression changes the state, where it changes the force by `S`.
    pub(super) fn pushed_back(&self, pressed: &Pressed, stiffness: &Magnitude) -> Magnitude {
        let push = self.block.pushed_by(pressed.input).multiply(stiffness);
        self.block.entry(self.place_of(pressed), &push)
    }

    /// The coefficients of the members and of the forces, until what they leave out is nothing to speak of.
    fn coefficients(
        &self,
        start: &[Number],
        contacts: &[Compressed],
        picard: &Picard,
        distance: &Magnitude,
    ) -> Result<Columns, TooLong> {
        let bits = self.given.cut.bits;
        let mut powers = Vec::new();
        for (own, law) in self.each(contacts) {
            let power = || PowerSeries::new(&law.law, &start[own.place], bits);
            let power = (!own.is_light).then(power).transpose();
            powers.push(power.map_err(|_| self.unknown())?);
        }
        let reach = self.given.norm.length.add(distance);
        let mut columns: Vec<Vec<Number>> = Vec::new();
        let mut column = start.to_vec();
        for k in 0..self.terms(contacts, picard, &reach) {
            let mut input = self.given.coefficients(k);
            for ((own, law), power) in self.each(contacts).zip(&mut powers) {
                if let Some(power) = power {
                    input[law.input] = power.next(&column[own.place], bits);
                }
            }
            let next = self.system.next(self.block, &column, (k, input), bits);
            columns.push(std::mem::replace(&mut column, next));
        }
        let forces = powers.into_iter().map(|power| power.map_or(Vec::new(), |own| own.values));
        Ok((columns, forces.collect()))
    }

    /// How many coefficients leave out less than the precision tells of a typical force.
    fn terms(&self, contacts: &[Compressed], picard: &Picard, reach: &Magnitude) -> usize {
        let whole = self.block.size(picard.sizes.iter().copied());
        let of_state = |law: &Pressed| whole.multiply(&law.stiffness.magnitude().square_root());
        let of_force =
            |own: &Compressed| own.stiffest.multiply(&picard.sizes[own.place]).add(&own.force);
        let precision = -(self.given.cut.bits as i64);
        let mut terms = 1;
        for (own, law) in self.each(contacts) {
            let least = law.law.force.magnitude().scale(precision);
            let size = of_state(law).max(of_force(own));
            while size.multiply(&picard.left_out(reach, terms)) > least {
                terms += 1;
            }
        }
        terms
    }

    /// `max |S − K|` while the compression moves so far from where it starts.
    pub(super) fn mismatch(
        &self,
        own: &Compressed,
        law: &Pressed,
        moved: &Magnitude,
    ) -> Result<Magnitude, BallError> {
        let [start, moved] = [&own.start, moved].map(Rational::from);
        let mut largest = Magnitude::ZERO;
        for end in [&start - &moved, &start + &moved] {
            let off = law.law.slope(&end)?.subtract(&law.stiffness, BITS);
            largest = largest.max(off.magnitude());
        }
        Ok(largest)
    }

    /// `max |S − K|` on the cell; of a light contact `K`, since its force is counted as a push.
    fn mismatch_on(
        &self,
        own: &Compressed,
        law: &Pressed,
        picard: &Picard,
    ) -> Result<Magnitude, BallError> {
        if own.is_light {
            return Ok(law.stiffness.magnitude());
        }
        let rounded = own.start.scale(-20);
        let moved = picard.on_cell[own.place].add(&own.assumed).add(&rounded);
        self.mismatch(own, law, &moved)
    }

    /// The bounds of errors, by that of the state at the start and what of it comes from rounding now.
    fn bounds(
        &self,
        contacts: &[Compressed],
        picard: &Picard,
        (at_start, rounding): (&Magnitude, &Magnitude),
        distance: &Magnitude,
        left_out: Magnitude,
    ) -> Result<Bounds, TooLong> {
        let (norm, cut) = (self.given.norm, self.given.cut);
        let mut rate = Magnitude::ZERO;
        // A compression that is the only state, as between two bars, has errors that the contact only damps.
        if self.block.members.len() > 1 {
            for (own, law) in self.each(contacts) {
                let off = self.mismatch_on(own, law, picard).map_err(|_| self.unknown())?;
                rate = rate.add(&self.pushed_back(law, &off));
            }
        }
        // e^z ≤ 1 + z + z² for z ≤ 1.
        let z = rate.multiply(&norm.length);
        if z > Magnitude::power_of_two(0) {
            return Err(self.unknown());
        }
        let growth = z.add(&z.multiply(&z));
        let factor = Magnitude::power_of_two(0).add(&growth);
        let arriving = self.block.push(&self.given.rests);
        let early = at_start.add(&arriving.multiply(&norm.length)).multiply(&factor);
        // The forces of light contacts themselves move them by as much again at most, which is proven here. One that
        // nothing else presses is pressed by what the others push, which the rounds before have found.
        let mut assumed = early;
        let mut rounds = 0..=self.block.pressed.len();
        let (light, per_time, error) = loop {
            rounds.next().ok_or_else(|| self.unknown())?;
            let room = |own: &Compressed| {
                picard.reached(own).add(&self.block.entry(own.place, &assumed)).scale(1)
            };
            let (mut light, mut per_time) = (Vec::new(), arriving);
            for (own, law) in self.each(contacts) {
                let mut largest = Magnitude::ZERO;
                if own.is_light {
                    largest = law.law.bound(&room(own)).map_err(|_| self.unknown())?;
                    per_time = per_time.add(&self.block.pushed_by(law.input).multiply(&largest));
                }
                light.push(largest);
            }
            let error = at_start.add(&per_time.multiply(&norm.length)).multiply(&factor);
            let moved =
                |own: &Compressed| picard.reached(own).add(&self.block.entry(own.place, &error));
            if contacts.iter().filter(|own| own.is_light).all(|own| moved(own) <= room(own)) {
                break (light, per_time, error);
            }
            assumed = error;
        };
        let tail = self.block.size(picard.sizes.iter().copied()).multiply(&left_out);
        // Within the distance errors of the state grow to e times, and those of the inputs are four times as large.
        let is_smooth = light.iter().all(Magnitude::is_zero);
        let around = match is_smooth {
            true => {
                let arrived = arriving.multiply(distance).scale(2);
                error.add(&arrived).multiply(&Magnitude::from_u64(3))
            }
            false => error,
        };
        Ok(Bounds {
            rest: around.add(&tail),
            roughness: Some(Roughness::within(distance, cut)),
            light,
            left_out,
            added: Added::Growing { at_once: rounding.add(&tail), per_time, growth },
        })
    }

    /// The forces of the contacts. A contact that stays closed pushes, which is proven of the cell before it is taken
    /// over.
    fn forces(
        &self,
        contacts: &[Compressed],
        forces: Vec<Vec<Number>>,
        bounds: &Bounds,
    ) -> Vec<Series> {
        let mut all = Vec::new();
        for (((own, law), force), light) in self.each(contacts).zip(forces).zip(&bounds.light) {
            let at_ends = [own.is_compressed, true];
            let signed = Some(Signed { sign: Ordering::Greater, at_ends });
            if own.is_light {
                let first = law.law.bound(&own.start.add(&own.off)).unwrap_or(*light);
                let roughness = (!light.is_zero()).then_some(Roughness::Values);
                let signed = signed.filter(|_| !light.is_zero());
                let series = Series::new(Vec::new(), *light).with_error_at_start(first.min(*light));
                all.push(Series { roughness, signed, ..series });
                continue;
            }
            let rest = own.stiffest.multiply(&self.block.entry(own.place, &bounds.rest));
            let series = Series::new(force, rest.add(&own.force.multiply(&bounds.left_out)))
                .with_error_at_start(own.stiffest.multiply(&own.off));
            all.push(Series { roughness: bounds.roughness, signed, ..series });
        }
        all
    }
}

impl Picard {
    /// How large a compression may become.
    fn reached(&self, own: &Compressed) -> Magnitude {
        own.start.add(&self.sizes[own.place])
    }

    /// The share of its bounds that all terms from this one on are at most: with `q = reach/radius`, at most 3/4, the
    /// sum `Σ_{k≥N} q^k` is no more than `4 q^N`.
    fn left_out(&self, reach: &Magnitude, terms: usize) -> Magnitude {
        let inverse = Magnitude::from_rational(&Rational::from(&self.radius).recip());
        let ratio = reach.multiply(&inverse);
        ratio.power(terms as u64).scale(2)
    }
}

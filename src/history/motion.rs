//! What a node does on a cell: the answer of its system to what arrives, as series with a proven rest.

use crate::ball::{Magnitude, Number};
use crate::history::error::{NotFollowed, Outcome};
use crate::history::passive::ErrorEnergy;
use crate::history::passivity::{Block, Known, Passivity, StateError};
use crate::history::separation::{Rows, Separation};
use crate::history::series::{CellNorm, LONGEST_CELL, Roughness, Series, Truncation};
use crate::network::{Node, System, dot};

/// So many derivatives at the start of a cell are enclosed one by one.
const STARTS: usize = 16;

/// So many terms more than what arrives a motion may have on a cell, where it needs them: waves that were reflected
/// often bend ever more.
const MOST_FURTHER: usize = 8;

/// Blocks are faster than a cell by this power of two at most, as far as the precision makes up for it.
const MOST_FASTER: i64 = 4096;

/// Polynomials of a higher degree do not act on a state that is kept exact.
const MAX_EXACT_DEGREE: usize = 4;

/// A state whose rounding is a few units in the last place is as exact as it can be, as a power of two.
const ROUNDING: i64 = 4;

/// How far a block is from its slow motion at the start of a cell, by what is known of it.
fn free_motion(block: &Block, own: &[Number], slow: &[Vec<Number>], cut: &Truncation) -> Magnitude {
    let middle = |value: &Number| match value.exact() {
        Some(_) => value.clone(),
        None => value.split(cut.bits).0,
    };
    let free = own.iter().enumerate().map(|(place, value)| match slow.first() {
        Some(slow) => middle(value).subtract(&slow[place], cut.bits).magnitude(),
        None => middle(value).magnitude(),
    });
    block.size(free)
}

/// What is as small as this cannot be told from nothing.
pub(super) fn told(error: &StateError, cut: &Truncation) -> Magnitude {
    error.size().max(cut.largest.scale(ROUNDING - cut.bits as i64))
}

/// The precision of a slow motion: what is left of the equation is as much larger than a rounding as the block is faster
/// than the cell.
fn slow_bits(block: &Block, length: &Magnitude, cut: &Truncation) -> u64 {
    let faster = block.rate.multiply(&block.memory(length)).top().unwrap_or(0);
    cut.bits + faster.clamp(0, MOST_FASTER) as u64
}

/// What a node does on a cell.
pub struct Motion {
    /// The state.
    pub state: Vec<Series>,
    /// What is added to the error of each block of the state, by the length of the cell: of the polynomials
    /// themselves, and per unit of time what arrives.
    added: Vec<Added>,
    /// The velocity of each run.
    pub velocities: Vec<Series>,
    /// The force of each closed contact, as they stand in [`System::closed`].
    pub forces: Vec<Series>,
}

/// What is added to an error.
pub(super) enum Added {
    /// Nothing: the block is exact, or nothing changes it.
    Nothing,
    /// So much, and so much per unit of time; of all of it so much is fresh at the end.
    Error { at_once: Magnitude, per_time: Magnitude, fresh: Magnitude },
    /// The same, and all of it pushes itself on, by this part of its size. Where it does not, it is not known to die out:
    /// a contact may be softer than the spring in its place.
    Growing { at_once: Magnitude, per_time: Magnitude, growth: Magnitude },
}

/// A block on a cell: the coefficients of its members, the norm of what they leave out, its size, how much of that is
/// fresh, and its size at the start.
pub(super) struct Course {
    pub columns: Vec<Vec<Number>>,
    pub rest: Magnitude,
    pub error: Magnitude,
    pub fresh: Magnitude,
    pub at_start: Magnitude,
    pub added: Added,
    pub roughness: Option<Roughness>,
}

impl Course {
    /// One that leaves nothing out.
    pub fn exact(columns: Vec<Vec<Number>>) -> Course {
        let none = Magnitude::ZERO;
        let added = Added::Nothing;
        let (rest, error, fresh, at_start) = (none, none, none, none);
        Course { columns, rest, error, fresh, at_start, added, roughness: None }
    }
}

/// What a node is given on a cell.
pub(super) struct Given<'a> {
    input: &'a [Series],
    /// The same without radii, and the norms of what was left out.
    pub settled: Vec<Series>,
    pub rests: Vec<Magnitude>,
    pub norm: &'a CellNorm,
    pub cut: &'a Truncation,
}

impl<'a> Given<'a> {
    pub fn new(input: &'a [Series], norm: &'a CellNorm, cut: &'a Truncation) -> Given<'a> {
        let settled: Vec<Series> = input.iter().map(|own| own.bare(norm, cut)).collect();
        let rests = settled.iter().map(|own| own.rest).collect();
        Given { input, settled, rests, norm, cut }
    }

    /// How fast a block is pushed by the errors of what it is given: by those of values, and by the fresh ones.
    fn pushes(&self, block: &Block) -> [Magnitude; 2] {
        let push = |bound: fn(&Series) -> Magnitude| {
            block.push(&self.settled.iter().map(bound).collect::<Vec<_>>())
        };
        [push(|own| own.error), push(|own| own.fresh)]
    }

    /// The coefficients of x^k, without radii.
    pub fn coefficients(&self, k: usize) -> Vec<Number> {
        self.settled.iter().map(|series| series.coefficient(k)).collect()
    }

    /// The same as they are given: rational ones are not rounded.
    fn as_given(&self, k: usize) -> Vec<Number> {
        self.input.iter().map(|series| series.coefficient(k)).collect()
    }
}

/// A row times series.
pub fn combined<'a>(row: &[Number], parts: impl Iterator<Item = &'a Series>, bits: u64) -> Series {
    let parts = parts.zip(row).filter(|(_, c)| !c.is_zero());
    parts.fold(Series::zero(), |sum, (part, c)| sum.combine(&Number::one(), part, c, bits))
}

impl System<Number> {
    /// What a node does from a state on, by the courses of its blocks.
    pub(super) fn motion(
        &self,
        passivity: &Passivity,
        (start, courses): (&[Number], Vec<Course>),
        input: &[Series],
        cut: &Truncation,
    ) -> Motion {
        let mut states = vec![Series::zero(); self.states()];
        let flat = self.flatness(start, input);
        let mut added = Vec::with_capacity(passivity.blocks.len());
        for (block, course) in passivity.blocks.iter().zip(courses) {
            for (place, member) in block.members.iter().enumerate() {
                let own: Vec<Number> =
                    course.columns.iter().map(|column| column[place].clone()).collect();
                let entry = |size: &Magnitude| block.entry(place, size);
                // What is exactly zero at the start has no error there, however large that of its block.
                let starts_at_zero = own.first().is_none_or(Number::is_zero);
                let at_start = match starts_at_zero && start[*member].is_zero() {
                    true => Magnitude::ZERO,
                    false => entry(&course.at_start),
                };
                let series = Series::new(own, entry(&course.rest))
                    .with_error(entry(&course.error), entry(&course.fresh))
                    .with_error_at_start(at_start);
                let (flat, steady) = flat[*member];
                states[*member] = Series { flat, steady, roughness: course.roughness, ..series };
            }
            added.push(course.added);
        }
        let mut outputs =
            self.output.iter().map(|row| combined(row, states.iter().chain(input), cut.bits));
        let velocities = outputs.by_ref().take(self.group.len()).collect();
        let forces = outputs.collect();
        Motion { state: states, added, velocities, forces }
    }

    /// How many derivatives of each entry of the state are exactly zero at the start, and how many of its slope, by those of
    /// what acts on it.
    fn flatness(&self, state: &[Number], input: &[Series]) -> Vec<(usize, usize)> {
        let mut flat: Vec<usize> =
            state.iter().map(|own| if own.is_zero() { STARTS } else { 0 }).collect();
        let acting: Vec<usize> = input.iter().map(Series::flatness).collect();
        // `y' = A y + B u` vanishes as often as all that it is the sum of.
        loop {
            let both: Vec<usize> = flat.iter().chain(&acting).copied().collect();
            let pushed = |row: &Vec<Number>| {
                let acts = row.iter().zip(&both).filter(|(entry, _)| !entry.is_zero());
                acts.map(|(_, order)| *order).min().unwrap_or(STARTS).min(STARTS)
            };
            let slopes: Vec<usize> = self.change.iter().map(pushed).collect();
            let next: Vec<usize> =
                flat.iter().zip(&slopes).map(|(own, slope)| (slope + 1).min(*own)).collect();
            if next == flat {
                return flat.into_iter().zip(slopes).collect();
            }
            flat = next;
        }
    }

    /// What leaves at a side, as a row: the velocity of its run less what arrives there.
    pub fn leaving_row(&self, (side, run): (usize, usize), bits: u64) -> Vec<Number> {
        let mut row = self.output[run].clone();
        let own = &mut row[self.states() + side];
        *own = own.subtract(&Number::one(), bits);
        row
    }

    /// Enclosures of the first coefficients of all outputs, velocities of runs and then forces of contacts.
    pub fn starts(&self, state: &[Number], input: &[Series], cut: &Truncation) -> Vec<Vec<Number>> {
        let mut starts = vec![Vec::with_capacity(STARTS); self.output.len()];
        let mut next = state.to_vec();
        for k in 0..STARTS {
            let mut both = next;
            both.extend(input.iter().map(|series| series.start(k, cut)));
            for (start, row) in starts.iter_mut().zip(&self.output) {
                start.push(dot(row, &both, cut.bits));
            }
            let change = |row: &Vec<Number>| dot(row, &both, cut.bits).over(k as u64 + 1, cut.bits);
            next = self.change.iter().map(change).collect();
        }
        starts
    }

    /// What a block does on a cell.
    pub(super) fn course(
        &self,
        block: &Block,
        own: Vec<Number>,
        error: &StateError,
        given: &Given<'_>,
    ) -> Course {
        if block.is_still() {
            return Course::exact(vec![own]);
        }
        if let Some(columns) = self.exact_columns(block, &own, given) {
            return Course::exact(columns);
        }
        match block.separation_on(&given.norm.length) {
            Some(separation) => {
                let columns = self.slow_columns(block, separation, &own, given);
                self.slow_course(block, &own, error, columns, given)
            }
            None => self.enclosed_course(block, own, error, given),
        }
    }

    /// The largest rate of the motions that have not died out, as far as the precision tells.
    pub fn free_rate(
        &self,
        known: Known<'_>,
        input: &[Series],
        (norm, cut): (&CellNorm, &Truncation),
    ) -> Magnitude {
        let given = Given::new(input, norm, cut);
        let rates = known.blocks().map(|(block, own, error)| {
            if !block.pressed.is_empty() {
                let rests = self.pressing(block, &given).rest(&own, error).is_some();
                return if rests { Magnitude::ZERO } else { block.rate };
            }
            let told = told(error, cut);
            let has_died_out = |separation: &&Separation| {
                let columns = self.slow_columns(block, separation, &own, &given);
                free_motion(block, &own, &columns, cut) <= told
            };
            let slow = block.separations.iter().find(has_died_out);
            slow.map_or(block.rate, |separation| separation.rate)
        });
        rates.max().unwrap_or(Magnitude::ZERO)
    }

    /// About how many cells, as short as its fastest motions need, the fastest block takes until these have died out.
    pub fn cells_until_gone(
        &self,
        known: Known<'_>,
        input: &[Series],
        (norm, cut): (&CellNorm, &Truncation),
    ) -> Option<f64> {
        let (block, own, error) = known.blocks().max_by_key(|(block, ..)| block.rate)?;
        let separation = block.separations.last()?;
        let columns = self.slow_columns(block, separation, &own, &Given::new(input, norm, cut));
        let free = free_motion(block, &own, &columns, cut).top()?;
        let halvings = (free - told(error, cut).top()?).max(0) as f64;
        Some(halvings * std::f64::consts::LN_2 * separation.lasting / f64::from(1 << LONGEST_CELL))
    }

    /// The *slow motion* of a block: the polynomial that solves `s' = A s + B u` for the polynomials of its inputs,
    /// `(k+1) s_(k+1) = A s_k + B u_k`. Its slow part `P s` begins with that of the state, the lowest coefficient
    /// first; its fast part is forced by the inputs, the highest first. All other motions come to it as the fast part
    /// of their free motion `e^(Ax)` dies out.
    fn slow_columns(
        &self,
        block: &Block,
        separation: &Separation,
        own: &[Number],
        given: &Given<'_>,
    ) -> Vec<Vec<Number>> {
        let (cut, length) = (given.cut, &given.norm.length);
        let bits = slow_bits(block, length, cut);
        let times = |rows: &Rows, column: &[Number]| -> Vec<Number> {
            rows.iter().map(|row| dot(row, column, bits).split(bits).0).collect()
        };
        let acting = given.settled.iter().enumerate().filter(|(j, _)| block.is_driven_by(*j));
        let degree = acting.map(|(_, series)| series.coefficients.len()).max().unwrap_or(0);
        let middles: Vec<Number> = own.iter().map(|value| value.split(bits).0).collect();
        let mut slow = times(&separation.slow, &middles);
        let mut columns = Vec::with_capacity(degree);
        let mut power = Magnitude::power_of_two(0);
        let mut largest = Magnitude::ZERO;
        loop {
            let k = columns.len();
            let size = block.size(slow.iter().map(Number::magnitude)).multiply(&power);
            largest = largest.max(size);
            let is_enough = size <= largest.scale(-(cut.bits as i64));
            if k >= degree && (is_enough || k >= cut.order.max(degree + MOST_FURTHER)) {
                break;
            }
            power = power.multiply(length);
            let next = self.next(block, &slow, (k, given.coefficients(k)), bits);
            columns.push(std::mem::replace(&mut slow, times(&separation.slow, &next)));
        }
        let mut fast = vec![Number::zero(); block.members.len()];
        for (k, column) in columns.iter_mut().enumerate().rev() {
            let pushed = self.pushed(block, k, given);
            let above = fast.iter().zip(pushed);
            let above: Vec<Number> = above
                .map(|(s, u)| s.multiply(&Number::integer(k as i64 + 1), bits).subtract(&u, bits))
                .collect();
            fast = times(&separation.fast_inverse, &above);
            for (entry, fast) in column.iter_mut().zip(&fast) {
                *entry = entry.add(fast, bits);
            }
        }
        columns
    }

    /// `B u_k` for the members of a block.
    fn pushed(&self, block: &Block, k: usize, given: &Given<'_>) -> Vec<Number> {
        let both = given.coefficients(k);
        let rows = block.members.iter().map(|i| &self.change[*i][self.states()..]);
        rows.map(|row| dot(row, &both, given.cut.bits)).collect()
    }

    /// A block on a cell many times longer than its fast motions last: its slow motion `s`.
    ///
    /// The error `e = y − s` obeys `e' = A e + B e_u + ρ` with `ρ = A s + B u − s'`, what roundings leave and what is
    /// not quite slow or fast, and begins with the rest of the free motion.
    fn slow_course(
        &self,
        block: &Block,
        own: &[Number],
        error: &StateError,
        columns: Vec<Vec<Number>>,
        given: &Given<'_>,
    ) -> Course {
        let (norm, cut) = (given.norm, given.cut);
        let bits = slow_bits(block, &norm.length, cut);
        let mut residuals = Vec::with_capacity(columns.len());
        for (k, column) in columns.iter().enumerate() {
            let next = self.next(block, column, (k, given.coefficients(k)), bits);
            let above = columns.get(k + 1);
            let left = next.iter().enumerate().map(|(place, next)| match above {
                Some(above) => next.subtract(&above[place], bits).magnitude(),
                None => next.magnitude(),
            });
            residuals.push(block.size(left).multiply(&Magnitude::from_u64(k as u64 + 1)));
        }
        let residual = norm.of_sizes(&residuals);
        let [per_time, fresh_per_time] = given.pushes(block).map(|push| push.add(&residual));
        let memory = block.memory(&norm.length);
        let free = free_motion(block, own, &columns, cut);
        let at_start = error.size().add(&free);
        let error = at_start.add(&per_time.multiply(&memory));
        let rest = cut.driven(&error, &block.push(&given.rests).add(&residual));
        let fresh = free.add(&fresh_per_time.multiply(&memory));
        let added = Added::Error { at_once: free, per_time, fresh };
        Course { columns, rest, error, fresh, at_start, added, roughness: norm.roughness }
    }

    /// The next coefficients of a block after those of x^k.
    pub(super) fn next(
        &self,
        block: &Block,
        column: &[Number],
        (k, input): (usize, Vec<Number>),
        bits: u64,
    ) -> Vec<Number> {
        let mut both = vec![Number::zero(); self.states()];
        for (member, value) in block.members.iter().zip(column) {
            both[*member] = value.clone();
        }
        both.extend(input);
        let rows = block.members.iter().map(|i| &self.change[*i]);
        rows.map(|row| dot(row, &both, bits).over(k as u64 + 1, bits)).collect()
    }

    /// The coefficients of a polynomial with rational ones, if they are few.
    pub(super) fn exact_columns(
        &self,
        block: &Block,
        own: &[Number],
        given: &Given<'_>,
    ) -> Option<Vec<Vec<Number>>> {
        let acting = || {
            let acts = |(j, _): &(usize, &Series)| block.is_driven_by(*j);
            given.input.iter().enumerate().filter(acts).map(|(_, series)| series)
        };
        let degree = acting().map(|series| series.coefficients.len()).max().unwrap_or(0);
        let is_exact = own.iter().all(|value| value.exact().is_some())
            && acting().all(Series::is_exact)
            && degree <= MAX_EXACT_DEGREE;
        if !is_exact {
            return None;
        }
        let mut columns = vec![own.to_vec()];
        for k in 0..degree + 4 {
            let next = self.next(block, &columns[k], (k, given.as_given(k)), given.cut.bits);
            columns.push(next);
        }
        let last = columns.pop()?;
        last.iter().all(Number::is_zero).then_some(columns)
    }

    /// Coefficients until the norm of what they leave out is nothing to speak of.
    ///
    /// The polynomial `y_N` of degree `N − 1` solves `y' = A y + B u − ρ` with `ρ = N c_N x^(N−1) + Σ_{k≥N} B u_k x^k`,
    /// where `N c_N = A c_(N−1) + B u_(N−1)`. So the error `e` of `y_N` grows by `|ρ|` and by what the errors of the
    /// inputs push, from what that of the state is at the start.
    fn enclosed_course(
        &self,
        block: &Block,
        own: Vec<Number>,
        error: &StateError,
        given: &Given<'_>,
    ) -> Course {
        let (norm, cut) = (given.norm, given.cut);
        let (mut column, rounding) = block.rounded(&own, cut.bits);
        let acting = given.settled.iter().enumerate().filter(|(j, _)| block.is_driven_by(*j));
        let degree = acting.map(|(_, series)| series.coefficients.len()).max().unwrap_or(0);
        let mut columns: Vec<Vec<Number>> = Vec::new();
        let mut largest = Magnitude::ZERO;
        let mut power = Magnitude::power_of_two(0);
        let left_out = loop {
            let k = columns.len();
            let size = block.size(column.iter().map(Number::magnitude));
            // ∫ |N c_N x^(N−1)| dx, and ‖N c_N x^(N−1)‖/γ, with what the recursion adds to it.
            let left_out = match k {
                0 => size,
                _ => size.multiply(&power).max(norm.of_residual(k, &size)),
            };
            largest = largest.max(size.multiply(&power));
            let enough = left_out <= largest.scale(-(cut.bits as i64));
            if k > 0 && k >= degree && (enough || k >= cut.order.max(degree + MOST_FURTHER)) {
                break left_out;
            }
            power = power.multiply(&norm.length);
            let next = self.next(block, &column, (k, given.coefficients(k)), cut.bits);
            columns.push(std::mem::replace(&mut column, next));
        };
        let [per_time, fresh_per_time] = given.pushes(block);
        let memory = block.memory(&norm.length);
        let at_start = error.size().add(&rounding);
        let at_once = rounding.add(&left_out);
        let error = error.size().add(&at_once).add(&per_time.multiply(&memory));
        let rest = cut.driven(&error, &block.push(&given.rests)).add(&left_out);
        let fresh = at_once.add(&fresh_per_time.multiply(&memory));
        let added = Added::Error { at_once, per_time, fresh };
        Course { columns, rest, error, fresh, at_start, added, roughness: norm.roughness }
    }

    /// The state at the end of a cell, and its errors: no larger than all errors so far allow, to which the fresh
    /// ones are added.
    pub fn ended(
        &self,
        passivity: &Passivity,
        motion: &Motion,
        (errors, energy): (&[StateError], &mut Option<ErrorEnergy>),
        length: &Number,
        cut: &Truncation,
    ) -> (Vec<Number>, Vec<StateError>) {
        let mut state = vec![Number::zero(); self.states()];
        let mut after = Vec::with_capacity(errors.len());
        for ((block, error), added) in passivity.blocks.iter().zip(errors).zip(&motion.added) {
            let values: Vec<Number> = (block.members.iter())
                .map(|member| motion.state[*member].polynomial(length, cut.bits))
                .collect();
            let split: Vec<(Number, Magnitude)> =
                values.iter().map(|value| value.split(cut.bits)).collect();
            let radius = block.size(split.iter().map(|(_, radius)| *radius));
            let after_all = |at_once: &Magnitude, per_time: &Magnitude| {
                let arrived = per_time.multiply(&block.memory(&length.magnitude()));
                at_once.add(&arrived).add(&radius)
            };
            let (error, fresh) = match added {
                Added::Nothing => {
                    let after = StateError::of(block, &values);
                    let fresh = if block.is_still() { Magnitude::ZERO } else { after.size() };
                    (after, fresh)
                }
                Added::Error { at_once, per_time, fresh } => {
                    let added = after_all(at_once, per_time);
                    (error.clone().after(length, &added, block), fresh.add(&radius))
                }
                Added::Growing { at_once, per_time, growth } => {
                    let added = at_once.add(&per_time.multiply(&length.magnitude())).add(&radius);
                    let grown = error.size().add(&added).multiply(growth);
                    let error = match growth.is_zero() {
                        true => StateError::new(error.size().add(&added)),
                        false => error.clone().after(length, &added.add(&grown), block),
                    };
                    let fresh = error.size();
                    (error, fresh)
                }
            };
            let error = match energy {
                Some(energy) => {
                    energy.add_state(&fresh);
                    error.at_most(&energy.of_state())
                }
                None => error,
            };
            let size = error.size();
            for (place, (value, (middle, _))) in values.into_iter().zip(split).enumerate() {
                state[block.members[place]] = match added {
                    Added::Nothing => value,
                    _ => middle.widened(&block.entry(place, &size), cut.bits),
                };
            }
            after.push(error);
        }
        (state, after)
    }

    /// The state that continues with these velocities of runs and displacements of elements.
    ///
    /// # Errors
    /// What `impact` says of two runs, where rigid masses of different velocities meet, or a moving one and a wall.
    pub fn state(
        &self,
        node: &Node<Number>,
        velocity: impl Fn(usize) -> Option<Number>,
        displaced: &[Number],
        impact: impl Fn([usize; 2]) -> NotFollowed,
        bits: u64,
    ) -> Outcome<Vec<Number>> {
        let mut state = Vec::with_capacity(self.states());
        let with_mass = |group: usize| {
            let own = (0..node.runs()).filter(move |run| self.group[*run] == group);
            own.filter(|run| !node.mass_of(*run, bits).is_zero())
        };
        for wall in (0..node.runs()).filter(|run| node.is_held(*run)) {
            let moves = |run: &usize| velocity(*run).is_none_or(|own| !own.is_zero());
            if let Some(run) = with_mass(self.group[wall]).find(moves) {
                return Err(impact([run, wall]).into());
            }
        }
        for group in &self.heavy {
            let mut own = with_mass(*group);
            let first = own.next().expect("a heavy group has a mass");
            let common = velocity(first).expect("a mass has a velocity");
            let mut before = first;
            for run in own {
                if velocity(run).is_none_or(|other| other != common) {
                    return Err(impact([before, run]).into());
                }
                before = run;
            }
            state.push(common);
        }
        let kept = displaced.iter().zip(&self.kept).filter(|(_, kept)| kept.is_some());
        state.extend(kept.map(|(value, _)| value.clone()));
        Ok(state)
    }
}

//! A numerical method of its own: characteristics from moment to moment, and power series at the nodes.
//!
//! It takes a scene as data and nothing else. Time is cut wherever something arrives at any node, and at
//! steps in which no rate does more than one e-folding. On each cell every wave is a power series; what
//! leaves a node follows from what arrives there, coefficient by coefficient. In doubles, with series of
//! 26 terms, it is good to about 1e-12 of the largest value.

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::ToPrimitive;
use wavestep::expression::{Expression, Fraction};
use wavestep::scene::{
    Bar, Body, Drive, ElementIndex, End, Kind, Load, Measure, Place, Position, Scene, Seen,
};

/// Terms of a power series.
const TERMS: usize = 26;
/// Moments nearer than this, in units of time of the march, are one.
const NEAR: f64 = 1e-10;

type Series = [f64; TERMS];

fn pi() -> BigRational {
    BigRational::new(
        "314159265358979323846264338327950288".parse().unwrap(),
        "100000000000000000000000000000000000".parse().unwrap(),
    )
}

/// A value without symbols other than `pi`.
fn float(value: &Fraction) -> f64 {
    let value = value.evaluate(&|symbol| (symbol.name() == "pi").then(pi));
    value.expect("a number").to_f64().unwrap()
}

fn constant(value: f64) -> Series {
    let mut series = [0.0; TERMS];
    series[0] = value;
    series
}

/// The series about `x` instead of 0.
fn shifted(series: &Series, x: f64) -> Series {
    let mut shifted = *series;
    for first in 0..TERMS {
        for j in (first..TERMS - 1).rev() {
            shifted[j] += x * shifted[j + 1];
        }
    }
    shifted
}

fn value(series: &Series, x: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// `∫_0^x`
fn integral(series: &Series, x: f64) -> f64 {
    series.iter().enumerate().rev().fold(0.0, |sum, (j, c)| sum * x + c / (j + 1) as f64) * x
}

/// A quantity as a series on each cell, constant before the start.
#[derive(Clone)]
struct History {
    before: f64,
    cells: Vec<Series>,
}

struct BarData {
    z: f64,
    travel: Option<f64>,
    velocity: f64,
    force: f64,
    /// Time per distance.
    slowness: f64,
    /// Force per strain.
    stiffness: f64,
    area: f64,
    /// What leaves the left end to the right, and the right end to the left; full waves.
    waves: [History; 2],
}

enum Side {
    Bar(usize),
    Free,
    Fixed,
}

enum Lump {
    Mass(f64),
    Spring(f64, f64),
    Support(f64, f64),
    Load(LoadData),
}

struct LoadData {
    drive: Drive,
    /// The course and its derivatives.
    derivatives: Vec<Expression>,
    time: wavestep_polynomial::Symbol,
    from: f64,
    until: Option<f64>,
}

struct NodeData {
    left: Side,
    right: Side,
    elements: Vec<(ElementIndex, Lump)>,
    /// Which run each element is in; for a spring the one at its left.
    run_of: Vec<usize>,
    /// The mass of each run.
    mass: Vec<f64>,
    /// What resists each velocity.
    resistance: Vec<Vec<f64>>,
    velocities: Vec<History>,
    /// Compressions of springs and displacements of supports, by element.
    yields: Vec<History>,
}

pub struct March {
    scene: Scene,
    bars: Vec<BarData>,
    places: BTreeMap<ElementIndex, usize>,
    nodes: Vec<NodeData>,
    /// The unit of time of the series.
    unit: f64,
    /// When the cells begin, and when the last one ends.
    starts: Vec<f64>,
}

impl LoadData {
    fn of(load: &Load, scene: &Scene) -> LoadData {
        let mut derivatives = vec![load.course.clone()];
        for j in 1..TERMS {
            derivatives.push(derivatives[j - 1].derivative(&scene.time));
        }
        LoadData {
            drive: load.drive,
            derivatives,
            time: scene.time.clone(),
            from: float(&load.from),
            until: load.until.as_ref().map(float),
        }
    }

    fn series(&self, at: f64, unit: f64) -> Series {
        let mut series = [0.0; TERMS];
        let near = NEAR * unit;
        if at < self.from - near || self.until.is_some_and(|until| at > until - near) {
            return series;
        }
        let exact = BigRational::from_float(at).unwrap();
        let mut factor = 1.0;
        for (j, derivative) in self.derivatives.iter().enumerate() {
            let known = |symbol: &wavestep_polynomial::Symbol| match symbol == &self.time {
                true => Some(exact.clone()),
                false => (symbol.name() == "pi").then(pi),
            };
            let sum = derivative.evaluate(&known).expect("a number");
            let terms = sum.iter().map(|(e, c)| c.to_f64().unwrap() * e.to_f64().unwrap().exp());
            series[j] = terms.sum::<f64>() * factor;
            factor *= unit / (j + 1) as f64;
        }
        series
    }
}

impl BarData {
    fn of(bar: &Bar) -> BarData {
        let (z, travel, slowness, stiffness, area) = match &bar.body {
            Body::Impedance { impedance, travel } => {
                let z = float(impedance);
                (z, travel.as_ref().map(float), 1.0, z, 1.0)
            }
            Body::Solid { area, modulus, density, length } => {
                let [area, modulus, density] = [area, modulus, density].map(float);
                let slowness = (density / modulus).sqrt();
                let travel = length.as_ref().map(|length| float(length) * slowness);
                (area * (modulus * density).sqrt(), travel, slowness, area * modulus, area)
            }
        };
        let (velocity, force) = (float(&bar.velocity), -float(&bar.strain) * stiffness);
        let wave = |before| History { before, cells: Vec::new() };
        let waves = [wave((velocity + force / z) / 2.0), wave((velocity - force / z) / 2.0)];
        BarData { z, travel, velocity, force, slowness, stiffness, area, waves }
    }
}

impl NodeData {
    fn close(
        left: Side,
        right: Side,
        elements: Vec<(ElementIndex, Lump)>,
        scene: &Scene,
        bars: &[BarData],
    ) -> NodeData {
        let mut run_of = Vec::new();
        let mut runs = 1;
        for (_, lump) in &elements {
            run_of.push(runs - 1);
            runs += usize::from(matches!(lump, Lump::Spring(..)));
        }
        let mut mass = vec![0.0; runs];
        let mut momentum = vec![0.0; runs];
        let mut resistance = vec![vec![0.0; runs]; runs];
        let mut yields = Vec::new();
        for ((element, lump), run) in elements.iter().zip(&run_of) {
            let run = *run;
            match lump {
                Lump::Mass(m) => {
                    let Kind::Mass(data) = &scene.elements[*element].kind else { unreachable!() };
                    mass[run] += m;
                    momentum[run] += m * float(&data.velocity);
                }
                Lump::Support(_, d) => resistance[run][run] += d,
                Lump::Spring(_, d) => {
                    resistance[run][run] += d;
                    resistance[run + 1][run + 1] += d;
                    resistance[run][run + 1] -= d;
                    resistance[run + 1][run] -= d;
                }
                Lump::Load(_) => {}
            }
            yields.push(History { before: 0.0, cells: Vec::new() });
        }
        for (side, run) in [(&left, 0), (&right, runs - 1)] {
            if let Side::Bar(bar) = side {
                resistance[run][run] += bars[*bar].z;
            }
        }
        let start = |run: usize| if mass[run] > 0.0 { momentum[run] / mass[run] } else { 0.0 };
        let history = |run| History { before: start(run), cells: Vec::new() };
        let velocities = (0..runs).map(history).collect();
        NodeData { left, right, elements, run_of, mass, resistance, velocities, yields }
    }

    /// How fast the node may change.
    fn rate(&self) -> f64 {
        let mut most: f64 = 0.0;
        for (run, mass) in self.mass.iter().enumerate() {
            let own = self.resistance[run][run];
            let stiffness: f64 = (self.elements.iter().zip(&self.run_of))
                .map(|((_, lump), at)| match lump {
                    Lump::Spring(k, _) if *at == run || at + 1 == run => *k,
                    Lump::Support(k, _) if *at == run => *k,
                    _ => 0.0,
                })
                .sum();
            let rates = match *mass > 0.0 {
                true => [own / mass, (stiffness / mass).sqrt()],
                false if own > 0.0 => [stiffness / own, 0.0],
                false => [0.0; 2],
            };
            most = most.max(rates[0]).max(rates[1]);
        }
        most
    }
}

/// Solves a small system by elimination with pivots.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let size = right.len();
    for i in 0..size {
        let pivot = (i..size).max_by(|a, b| matrix[*a][i].abs().total_cmp(&matrix[*b][i].abs()));
        let pivot = pivot.unwrap();
        assert!(matrix[pivot][i].abs() > 0.0, "nothing resists a motion without mass");
        matrix.swap(i, pivot);
        right.swap(i, pivot);
        for row in 0..size {
            if row != i {
                let factor = matrix[row][i] / matrix[i][i];
                let pivot = matrix[i].clone();
                for (entry, above) in matrix[row].iter_mut().zip(&pivot).skip(i) {
                    *entry -= factor * above;
                }
                right[row] -= factor * right[i];
            }
        }
    }
    (0..size).map(|i| right[i] / matrix[i][i]).collect()
}

impl March {
    /// The motion from the start until `last`.
    pub fn new(scene: &Scene, last: f64) -> March {
        let mut bars = Vec::new();
        let mut places = BTreeMap::new();
        for element in &scene.line.elements {
            if let Kind::Bar(bar) = &scene.elements[*element].kind {
                places.insert(*element, bars.len());
                bars.push(BarData::of(bar));
            }
        }
        let end = |end: End| match end {
            End::Free => Some(Side::Free),
            End::Fixed => Some(Side::Fixed),
            End::Endless => None,
        };
        let mut nodes = Vec::new();
        let mut left = end(scene.line.left);
        let mut elements = Vec::new();
        for element in &scene.line.elements {
            let lump = match &scene.elements[*element].kind {
                Kind::Bar(_) => {
                    let place = places[element];
                    if let Some(left) = left {
                        let elements = std::mem::take(&mut elements);
                        let right = Side::Bar(place);
                        nodes.push(NodeData::close(left, right, elements, scene, &bars));
                    }
                    left = Some(Side::Bar(place));
                    continue;
                }
                Kind::Mass(mass) => Lump::Mass(float(&mass.mass)),
                Kind::Spring(spring) => {
                    Lump::Spring(float(&spring.stiffness), float(&spring.damping))
                }
                Kind::Support(support) => {
                    Lump::Support(float(&support.stiffness), float(&support.damping))
                }
                Kind::Load(load) => Lump::Load(LoadData::of(load, scene)),
                Kind::Hertz(_) => unreachable!("linear scenes are marched"),
            };
            elements.push((*element, lump));
        }
        if let (Some(left), Some(right)) = (left, end(scene.line.right)) {
            nodes.push(NodeData::close(left, right, elements, scene, &bars));
        }
        let travels = bars.iter().filter_map(|bar| bar.travel);
        let rates = nodes.iter().map(NodeData::rate).filter(|rate| *rate > 0.0);
        let unit = travels.chain(rates.map(|rate| 1.0 / rate)).fold(last.max(1e-9), f64::min);
        let scene = scene.clone();
        let mut march = March { scene, bars, places, nodes, unit, starts: vec![0.0] };
        while *march.starts.last().unwrap() < last {
            march.step();
        }
        march
    }

    /// The cell that goes on from a moment; none before the start.
    fn cell(&self, moment: f64) -> Option<usize> {
        let count = self.starts.partition_point(|start| *start <= moment + NEAR * self.unit);
        count.checked_sub(1).map(|cell| cell.min(self.starts.len().saturating_sub(2)))
    }

    /// A quantity from a moment on.
    fn series(&self, history: &History, from: f64) -> Series {
        match self.cell(from) {
            None => constant(history.before),
            Some(cell) => shifted(&history.cells[cell], (from - self.starts[cell]) / self.unit),
        }
    }

    /// The wave that arrives at a side of a node: from the left to the right in a bar at its left.
    fn arriving(&self, bar: usize, way: usize, now: f64) -> Series {
        let bar = &self.bars[bar];
        match bar.travel {
            Some(travel) => self.series(&bar.waves[way], now - travel),
            None => constant(bar.waves[way].before),
        }
    }

    fn next_moment(&self, now: f64) -> f64 {
        let near = NEAR * self.unit;
        let mut next = now + self.unit;
        for travel in self.bars.iter().filter_map(|bar| bar.travel) {
            let then = now - travel;
            let place = self.starts.partition_point(|start| *start <= then + near);
            if let Some(start) = self.starts.get(place) {
                next = next.min(start + travel);
            }
        }
        for (_, lump) in self.nodes.iter().flat_map(|node| &node.elements) {
            if let Lump::Load(load) = lump {
                let moments = std::iter::once(load.from).chain(load.until);
                moments.filter(|at| *at > now + near).for_each(|at| next = next.min(at));
            }
        }
        next
    }

    fn step(&mut self) {
        let now = *self.starts.last().unwrap();
        let next = self.next_moment(now);
        let x = (next - now) / self.unit;
        let solved: Vec<_> = self.nodes.iter().map(|node| self.solve(node, now)).collect();
        for (node, (velocities, yields, leaving)) in self.nodes.iter_mut().zip(solved) {
            for (history, series) in node.velocities.iter_mut().zip(velocities) {
                assert!((series[TERMS - 1] * x.powi(TERMS as i32 - 1)).abs() < 1e-12);
                history.cells.push(series);
            }
            for (history, series) in node.yields.iter_mut().zip(yields) {
                history.cells.push(series);
            }
            for (bar, way, series) in leaving {
                self.bars[bar].waves[way].cells.push(series);
            }
        }
        self.starts.push(next);
        // What comes from where a bar goes on for ever.
        let cells = self.starts.len() - 1;
        for wave in self.bars.iter_mut().flat_map(|bar| &mut bar.waves) {
            if wave.cells.len() < cells {
                wave.cells.push(constant(wave.before));
            }
        }
    }

    /// Velocities of runs, yields of elements, and what leaves into the bars, on the next cell.
    #[expect(clippy::type_complexity, reason = "three rows of one cell")]
    fn solve(
        &self,
        node: &NodeData,
        now: f64,
    ) -> (Vec<Series>, Vec<Series>, Vec<(usize, usize, Series)>) {
        let runs = node.mass.len();
        let last = |history: &History| match history.cells.last() {
            Some(series) => {
                let start = self.starts[self.starts.len() - 2];
                value(series, (now - start) / self.unit)
            }
            None => history.before,
        };
        let mut velocities = vec![[0.0; TERMS]; runs];
        let mut yields: Vec<Series> = node.yields.iter().map(|own| constant(last(own))).collect();
        let mut imposed: Vec<Option<Series>> = vec![None; runs];
        let mut loads = vec![[0.0; TERMS]; runs];
        for ((_, lump), run) in node.elements.iter().zip(&node.run_of) {
            let Lump::Load(load) = lump else { continue };
            let series = load.series(now, self.unit);
            match load.drive {
                Drive::Force => (0..TERMS).for_each(|j| loads[*run][j] += series[j]),
                Drive::Velocity => imposed[*run] = Some(series),
            }
        }
        for (side, run) in [(&node.left, 0), (&node.right, runs - 1)] {
            if matches!(side, Side::Fixed) {
                imposed[run] = Some([0.0; TERMS]);
            }
        }
        for run in 0..runs {
            match &imposed[run] {
                Some(series) => velocities[run] = *series,
                None => velocities[run][0] = last(&node.velocities[run]),
            }
        }
        let free: Vec<usize> =
            (0..runs).filter(|run| imposed[*run].is_none() && node.mass[*run] == 0.0).collect();
        let arrived_left = match node.left {
            Side::Bar(bar) => Some((bar, self.arriving(bar, 0, now))),
            _ => None,
        };
        let arrived_right = match node.right {
            Side::Bar(bar) => Some((bar, self.arriving(bar, 1, now))),
            _ => None,
        };
        for j in 0..TERMS {
            // All that presses on a run but what its own velocity and its neighbours' resist.
            let mut pressed: Vec<f64> = loads.iter().map(|series| series[j]).collect();
            for (i, ((_, lump), run)) in node.elements.iter().zip(&node.run_of).enumerate() {
                match lump {
                    Lump::Spring(k, _) => {
                        pressed[*run] -= k * yields[i][j];
                        pressed[run + 1] += k * yields[i][j];
                    }
                    Lump::Support(k, _) => pressed[*run] -= k * yields[i][j],
                    _ => {}
                }
            }
            if let Some((bar, wave)) = &arrived_left {
                pressed[0] += 2.0 * self.bars[*bar].z * wave[j];
            }
            if let Some((bar, wave)) = &arrived_right {
                pressed[runs - 1] += 2.0 * self.bars[*bar].z * wave[j];
            }
            let known = |row: usize, velocities: &[Series]| -> f64 {
                let others = (0..runs).filter(|run| !free.contains(run));
                others.map(|run| node.resistance[row][run] * velocities[run][j]).sum()
            };
            if !free.is_empty() {
                let matrix = free
                    .iter()
                    .map(|row| free.iter().map(|column| node.resistance[*row][*column]).collect());
                let right = free.iter().map(|row| pressed[*row] - known(*row, &velocities));
                let solution = solve(matrix.collect(), right.collect());
                for (run, velocity) in free.iter().zip(solution) {
                    velocities[*run][j] = velocity;
                }
            }
            if j + 1 == TERMS {
                break;
            }
            let share = self.unit / (j + 1) as f64;
            for run in 0..runs {
                if imposed[run].is_none() && node.mass[run] > 0.0 {
                    let resisted: f64 =
                        (0..runs).map(|at| node.resistance[run][at] * velocities[at][j]).sum();
                    velocities[run][j + 1] = share * (pressed[run] - resisted) / node.mass[run];
                }
            }
            for (i, ((_, lump), run)) in node.elements.iter().zip(&node.run_of).enumerate() {
                yields[i][j + 1] = match lump {
                    Lump::Spring(..) => share * (velocities[*run][j] - velocities[run + 1][j]),
                    Lump::Support(..) => share * velocities[*run][j],
                    _ => 0.0,
                };
            }
        }
        let mut leaving = Vec::new();
        let sides = [(arrived_left, 1, 0), (arrived_right, 0, runs - 1)];
        for (arrived, way, run) in sides {
            if let Some((bar, wave)) = arrived {
                leaving.push((bar, way, std::array::from_fn(|j| velocities[run][j] - wave[j])));
            }
        }
        (velocities, yields, leaving)
    }
}

// ---- What is observed --------------------------------------------------------------------------

impl March {
    fn at(&self, history: &History, moment: f64) -> f64 {
        self.series(history, moment)[0]
    }

    /// `∫` from the start to a moment, also where that is before.
    fn integrated(&self, history: &History, moment: f64, of: impl Fn(&Series, f64) -> f64) -> f64 {
        let Some(last) = self.cell(moment) else {
            return of(&constant(history.before), moment / self.unit);
        };
        let mut sum = 0.0;
        for cell in 0..=last {
            let end = if cell == last { moment } else { self.starts[cell + 1] };
            sum += of(&history.cells[cell], (end - self.starts[cell]) / self.unit);
        }
        sum
    }

    /// `∫ (c + h)` over time.
    fn plain(&self, history: &History, moment: f64) -> f64 {
        self.integrated(history, moment, integral) * self.unit
    }

    /// `∫ h²` over time.
    fn square(&self, history: &History, moment: f64) -> f64 {
        let of = |series: &Series, x: f64| {
            let mut sum = 0.0;
            for (i, a) in series.iter().enumerate() {
                for (j, b) in series.iter().enumerate() {
                    sum += a * b * x.powi((i + j + 1) as i32) / (i + j + 1) as f64;
                }
            }
            sum
        };
        self.integrated(history, moment, of) * self.unit
    }

    /// The delays of the two waves at a section; none for one that never changes.
    fn delays(&self, element: ElementIndex, place: &Place) -> [Option<f64>; 2] {
        let bar = &self.bars[self.places[&element]];
        let Some(travel) = bar.travel else {
            let distance = match place {
                Place::At(_, Position::Distance(distance)) => float(distance) * bar.slowness,
                _ => 0.0,
            };
            let leftmost = self.scene.line.elements[0] == element;
            return match leftmost && self.scene.line.left == End::Endless {
                true => [None, Some(distance)],
                false => [Some(distance), None],
            };
        };
        let late = match place {
            Place::Left(_) => 0.0,
            Place::Right(_) => travel,
            Place::At(_, Position::Share(share)) => float(share) * travel,
            Place::At(_, Position::Distance(distance)) => float(distance) * bar.slowness,
            _ => unreachable!("a section"),
        };
        [Some(late), Some(travel - late)]
    }

    fn in_bar(&self, seen: &Seen, element: ElementIndex, now: f64) -> f64 {
        let bar = &self.bars[self.places[&element]];
        let delays = self.delays(element, &seen.place);
        let wave = |way: usize| match delays[way] {
            Some(delay) => self.at(&bar.waves[way], now - delay),
            None => bar.waves[way].before,
        };
        let force = || bar.z * (wave(0) - wave(1));
        match seen.measure {
            Measure::Velocity => wave(0) + wave(1),
            Measure::Force => force(),
            Measure::Strain => -force() / bar.stiffness,
            Measure::Stress => -force() / bar.area,
            Measure::Displacement => (0..2)
                .map(|way| match delays[way] {
                    Some(delay) => {
                        self.plain(&bar.waves[way], now - delay)
                            - self.plain(&bar.waves[way], -delay)
                    }
                    None => bar.waves[way].before * now,
                })
                .sum(),
            _ => unreachable!("not of a section"),
        }
    }

    /// Energy or momentum in a bar.
    fn of_bar(&self, measure: Measure, element: ElementIndex, now: f64) -> f64 {
        let bar = &self.bars[self.places[&element]];
        let integral = |way: usize, moment: f64| match measure {
            Measure::Energy => self.square(&bar.waves[way], moment),
            _ => self.plain(&bar.waves[way], moment),
        };
        let Some(travel) = bar.travel else {
            assert!(bar.velocity == 0.0 && bar.force == 0.0);
            return bar.z * (integral(0, now) + integral(1, now));
        };
        bar.z * (0..2).map(|way| integral(way, now) - integral(way, now - travel)).sum::<f64>()
    }

    fn of_element(&self, measure: Measure, element: ElementIndex, now: f64) -> f64 {
        if self.places.contains_key(&element) {
            return self.of_bar(measure, element, now);
        }
        let find = |node: &NodeData| node.elements.iter().position(|(own, _)| *own == element);
        let (node, i) = self.nodes.iter().find_map(|node| Some((node, find(node)?))).unwrap();
        let run = node.run_of[i];
        let velocity = |run: usize| self.at(&node.velocities[run], now);
        let yields = self.at(&node.yields[i], now);
        match (&node.elements[i].1, measure) {
            (Lump::Mass(_) | Lump::Support(..), Measure::Velocity) => velocity(run),
            (Lump::Mass(_), Measure::Displacement) => self.plain(&node.velocities[run], now),
            (Lump::Mass(m), Measure::Momentum) => m * velocity(run),
            (Lump::Mass(m), Measure::Energy) => m * velocity(run).powi(2) / 2.0,
            (Lump::Spring(..), Measure::Compression) => yields,
            (Lump::Spring(k, d), Measure::Force) => {
                k * yields + d * (velocity(run) - velocity(run + 1))
            }
            (Lump::Support(k, d), Measure::Force) => k * yields + d * velocity(run),
            (Lump::Spring(k, _) | Lump::Support(k, _), Measure::Energy) => k * yields.powi(2) / 2.0,
            (Lump::Load(load), Measure::Force) if load.drive == Drive::Force => {
                load.series(now, self.unit)[0]
            }
            _ => 0.0,
        }
    }

    /// The value of a sum of measures, at a moment at which nothing arrives.
    pub fn observe(&self, terms: &[Seen], now: f64) -> f64 {
        let term = |seen: &Seen| {
            float(&seen.coefficient)
                * match &seen.place {
                    Place::Line => {
                        let elements = self.scene.line.elements.iter();
                        elements.map(|element| self.of_element(seen.measure, *element, now)).sum()
                    }
                    Place::Element(element) => self.of_element(seen.measure, *element, now),
                    Place::Left(bar) | Place::Right(bar) | Place::At(bar, _) => {
                        self.in_bar(seen, *bar, now)
                    }
                }
        };
        terms.iter().map(term).sum()
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.starts.len() - 1
    }
}

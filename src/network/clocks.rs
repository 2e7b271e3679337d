//! How far the clock of each node is ahead, and the lattice on which all delays are counted.

use crate::expression::Fraction;
use crate::network::delay::Lattice;
use crate::network::layout::Layout;
use crate::network::model::Model;
use crate::network::node::{ElementLaw, Node, Side};
use crate::network::scaled::ScaledScene;
use crate::scene::ElementIndex;
use num_integer::Integer as _;

/// A delay, counted on a lattice.
pub(super) type Counts = Vec<i64>;

/// The clocks of the nodes of a line.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Clocks {
    /// The node whose clock is not ahead.
    pub reference: usize,
    pub lattice: Lattice,
    /// How far the clock of each node is ahead.
    pub leads: Vec<Fraction>,
    /// The same, counted; `None` where nothing starts.
    pub counted: Vec<Option<Counts>>,
    /// The round trip in each finite bar.
    pub round_trips: Vec<Option<Counts>>,
    /// When loads begin and end, by the clock of their node.
    pub loads: Vec<(ElementIndex, Counts, Option<Counts>)>,
}

/// A load: its element, its node, when it begins, and when it ends.
type Moment<'a> = (ElementIndex, usize, &'a Fraction, Option<&'a Fraction>);

impl Clocks {
    /// The clocks of a line; the first node at which something starts is the reference.
    pub fn of(scaled: &ScaledScene) -> Clocks {
        let ScaledScene { layout, model, .. } = scaled;
        let starting: Vec<bool> = layout.nodes.iter().map(|node| starts(scaled, node)).collect();
        let travel: Vec<Option<&Fraction>> =
            layout.bars.iter().map(|bar| model.bars[bar].travel.as_ref()).collect();
        let finite =
            |bar: &usize| travel[*bar].filter(|_| layout.ends[*bar].iter().all(Option::is_some));
        let loads = loads(layout, model);
        let ends = loads.iter().flat_map(|(.., from, until)| std::iter::once(*from).chain(*until));
        let scale = Scale::of((0..travel.len()).filter_map(|bar| finite(&bar)).chain(ends));
        let reference = starting.iter().position(|starts| *starts).unwrap_or(0);
        let late = |node| {
            let bars = bars_between(layout, node, reference);
            let passage = |bar: usize| scale.counts(travel[bar].expect("a finite bar"));
            bars.map(passage).fold(scale.none(), |sum, part| sum_of(sum, &part))
        };
        let late: Vec<Counts> = (0..layout.nodes.len()).map(late).collect();
        let twice = |travel: &Fraction| scale.counts(travel).iter().map(|n| 2 * n).collect();
        let at = |node: usize, time: &Fraction| sum_of(late[node].clone(), &scale.counts(time));
        let counted = late.iter().zip(&starting).map(|(late, starts)| starts.then(|| late.clone()));
        let clocks = Clocks {
            reference,
            leads: late.iter().map(|counts| scale.lattice.delay(counts)).collect(),
            counted: counted.collect(),
            round_trips: (0..travel.len()).map(|bar| finite(&bar).map(twice)).collect(),
            loads: loads
                .iter()
                .map(|(element, node, from, until)| {
                    (*element, at(*node, from), until.map(|until| at(*node, until)))
                })
                .collect(),
            lattice: scale.lattice,
        };
        clocks.coarsened()
    }

    /// The delays that equations name: round trips, clocks, and moments of loads.
    pub fn all_counts(&self) -> impl Iterator<Item = &Counts> {
        let moments =
            self.loads.iter().flat_map(|(_, from, until)| std::iter::once(from).chain(until));
        self.round_trips.iter().flatten().chain(self.counted.iter().flatten()).chain(moments)
    }

    /// The same on a lattice as coarse as what is counted allows.
    fn coarsened(mut self) -> Clocks {
        let mut steps = vec![0_i64; self.lattice.periods().len()];
        for counts in self.all_counts() {
            for (step, count) in steps.iter_mut().zip(counts) {
                *step = step.gcd(count);
            }
        }
        steps.iter_mut().filter(|step| **step == 0).for_each(|step| *step = 1);
        let coarsen = |counts: &mut Counts| {
            counts.iter_mut().zip(&steps).for_each(|(count, step)| *count /= step);
        };
        let moments =
            self.loads.iter_mut().flat_map(|(_, from, until)| std::iter::once(from).chain(until));
        let used = self.round_trips.iter_mut().flatten().chain(self.counted.iter_mut().flatten());
        used.chain(moments).for_each(coarsen);
        self.lattice = self.lattice.coarsened(&steps);
        self
    }
}

/// Times with their counts on the lattice that they span.
struct Scale<'a> {
    times: Vec<&'a Fraction>,
    counts: Vec<Counts>,
    lattice: Lattice,
}

impl<'a> Scale<'a> {
    fn of(times: impl Iterator<Item = &'a Fraction>) -> Scale<'a> {
        let times: Vec<&Fraction> = times.filter(|time| !time.is_zero()).collect();
        let (lattice, counts) = match times.is_empty() {
            // Nothing returns: one period holds everything.
            true => Lattice::spanned_by(&[Fraction::one()]),
            false => Lattice::spanned_by(&times.iter().copied().cloned().collect::<Vec<_>>()),
        };
        Scale { times, counts, lattice }
    }

    fn none(&self) -> Counts {
        vec![0; self.lattice.periods().len()]
    }

    fn counts(&self, time: &Fraction) -> Counts {
        let place = self.times.iter().position(|other| *other == time);
        place.map_or_else(|| self.none(), |place| self.counts[place].clone())
    }
}

fn sum_of(mut sum: Counts, part: &Counts) -> Counts {
    sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
    sum
}

/// The bars that are passed on the way from one node to another.
fn bars_between(layout: &Layout, node: usize, other: usize) -> impl Iterator<Item = usize> {
    let (low, high) = (node.min(other), node.max(other));
    (0..layout.bars.len()).filter(move |bar| {
        let [left, right] = layout.ends[*bar];
        left.is_some_and(|left| left >= low && left < high)
            && right.is_some_and(|right| right > low && right <= high)
    })
}

fn loads<'a>(layout: &Layout, model: &'a Model) -> Vec<Moment<'a>> {
    let mut loads = Vec::new();
    for (node, data) in layout.nodes.iter().enumerate() {
        for own in &data.elements {
            if let Some(load) = model.loads.get(&own.element) {
                loads.push((own.element, node, &load.from, load.until.as_ref()));
            }
        }
    }
    loads
}

/// Whether something happens at a node at the start, or later by a load.
fn starts(scaled: &ScaledScene, node: &Node<Fraction>) -> bool {
    let velocity = |run| {
        let mut all = scaled.initial_velocities(node, run);
        all.dedup();
        (all.len() <= 1).then(|| all.into_iter().next().unwrap_or_else(Fraction::zero))
    };
    let velocities: Vec<Option<Fraction>> = (0..node.runs()).map(velocity).collect();
    let uneven = velocities.iter().any(Option::is_none);
    let apart = velocities.windows(2).any(|pair| pair[0] != pair[1]);
    let forced = |side: Side| match side {
        Side::Bar(bar) => !scaled.model.bars[&scaled.layout.bars[bar]].force.is_zero(),
        _ => false,
    };
    let pressed = forced(node.left) || forced(node.right);
    let moved = velocities.iter().flatten().any(|velocity| !velocity.is_zero());
    let held = node.elements.iter().any(|own| match own.law {
        ElementLaw::Load(_) => true,
        ElementLaw::Support { .. } => moved,
        _ => false,
    });
    uneven || apart || pressed || held
}

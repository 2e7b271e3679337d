//! All charts of one quantity, with what is to be seen on each.

use super::curves::DOUBLES;
use super::harness::{Settings, Subject};
use super::loss::{Loss, first_losses, losses};
use super::map::{errors_by_order, order_law, order_map};
use super::reference::{Reference, Sampling};
use super::{at_arrivals, cost_over_order, ladder, near_confluence, near_jump, near_zeros};
use super::{over_courant, over_order, over_time, work_precision};
use crate::picture::{self, PictureError};
use num_traits::ToPrimitive as _;
use std::time::Duration;
use wavestep::answer::{self, Method};
use wavestep::problem::{Problem, number};
use wavestep::signal::instructions;
use wavestep_draw::{Axis, Caption, Chart, Curves, Listing, PlotError, Table};
use wavestep_polynomial::Rational;

const NORM: &str = "the largest |computed − exact|, in parts of the largest value";

/// How many periods, or lengths of the scene, the window has where none is asked for, and that of maps.
const PERIODS: i64 = 40;
const PERIODS_OF_MAPS: i64 = 400;

/// Values of the parameter of maps, from 1/10000 to 10000; those about 1 are closest.
const PARAMETERS: [&str; 13] = [
    "1/10000", "1/1000", "1/100", "1/10", "1/4", "1/2", "1", "2", "4", "10", "100", "1000", "10000",
];
const FEW_PARAMETERS: [&str; 3] = ["1/10000", "1", "10000"];

/// Above this, balls take thousands of bits at high orders: maps end at the last of these orders there.
const HUGE: f64 = 100.0;
const LAST_OF_HUGE: usize = 20;

const MAPPED: [Method; 6] = DOUBLES;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Effort {
    /// Little: to see whether it works.
    Quick,
    Full,
}

impl Effort {
    fn pick<T>(self, quick: T, full: T) -> T {
        if self == Effort::Quick { quick } else { full }
    }

    fn settings(self) -> Settings {
        self.pick(Settings { runs: 1, time: Duration::ZERO }, Settings::default())
    }

    fn orders(self) -> &'static [usize] {
        self.pick(&[1, 5, 10, 20], &[1, 5, 10, 15, 20, 30, 40, 60, 80, 100, 120, 140, 170, 200])
    }

    /// Orders at which exponentials underflow.
    fn high_orders(self) -> &'static [usize] {
        self.pick(&[10, 30], &[10, 30, 100, 200, 400, 800])
    }
}

#[derive(Clone, Debug)]
pub struct ToChart<'a> {
    pub quantity: &'a str,
    /// At how many times errors are measured, and the seed of these.
    pub sampling: Sampling,
    pub effort: Effort,
    /// The symbol over which maps are drawn.
    pub symbol: Option<&'a str>,
    /// The command that draws the charts again.
    pub command: &'a str,
}

pub struct Charted {
    /// What its files are called.
    pub name: String,
    pub text: &'static str,
    pub chart: Box<dyn Chart>,
    pub listing: Option<Listing>,
}

/// All charts, the table of work against precision, and what is left out for which reason.
pub struct Charts {
    pub all: Vec<Charted>,
    pub table: Table,
    pub left_out: Vec<(&'static str, PlotError)>,
}

/// The end of the window where none is asked for.
pub fn usual_end(problem: &Problem) -> Result<Rational, PictureError> {
    match problem.local_contact() {
        Some(_) => picture::usual_end(problem, &Rational::default()),
        None => Ok(problem.some_periods(PERIODS)?),
    }
}

/// Draws all charts of a quantity on a window; `tick` is told what is being measured.
pub fn charts(
    problem: &Problem,
    window: [Rational; 2],
    asked: &ToChart<'_>,
    tick: &dyn Fn(&str),
) -> Result<Charts, PictureError> {
    let subject = Subject { problem, quantity: asked.quantity };
    let question = &problem.question(asked.quantity, window)?;
    let window = question.signal.window();
    let ends = window.map(crate::nearest);
    let reference = Reference::new(question, &asked.sampling.times(ends[0], ends[1]))?;
    let effort = asked.effort;
    let settings = (effort.settings(), effort == Effort::Quick);
    let outcomes =
        ladder((subject, question), &reference, settings, |method| tick(&method.to_string()));
    let caption = caption(asked, asked.sampling.law());
    let (work, table) =
        work_precision("Work against precision", &outcomes, &reference, caption.clone())?;
    let text = "Each line is a method, each marker one of its settings. Further left is more accurate, \
                further down is faster. A segment leads from the measured error to the proven bound, where \
                there is one. Markers do not count preparation; a ring above a marker does, spread over the \
                points.";
    let (all, left_out) = (vec![Charted::new("work-precision", text, work)], Vec::new());
    let mut study =
        Study { subject, question, asked, caption, tick, unit: problem.time_unit(), all, left_out };
    study.over_the_window(&reference);
    if question.scene.is_some() {
        study.models(&reference);
    }
    if let Some(period) = period_of(question) {
        study.by_order(period);
    }
    study.near_equal_poles();
    if let Some(symbol) = asked.symbol {
        study.maps(problem, symbol);
    }
    Ok(Charts { all: study.all, table, left_out: study.left_out })
}

fn period_of(question: &answer::Question<'_>) -> Option<f64> {
    question.signal.closed_form().ok()?.period()
}

fn caption(asked: &ToChart<'_>, sampling: String) -> Caption {
    Caption {
        norm: NORM.to_owned(),
        sampling,
        versions: vec![
            ("wavestep".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
            (std::env::consts::ARCH.to_owned(), instructions()),
        ],
        seed: Some(asked.sampling.seed),
        command: asked.command.to_owned(),
        remarks: Vec::new(),
    }
}

struct Study<'s> {
    subject: Subject<'s>,
    question: &'s answer::Question<'s>,
    asked: &'s ToChart<'s>,
    caption: Caption,
    tick: &'s dyn Fn(&str),
    unit: &'static str,
    all: Vec<Charted>,
    left_out: Vec<(&'static str, PlotError)>,
}

impl Charted {
    fn new(name: &str, text: &'static str, chart: impl Chart + 'static) -> Charted {
        Charted { name: name.to_owned(), text, chart: Box::new(chart), listing: None }
    }
}

impl Study<'_> {
    fn add(&mut self, name: &'static str, text: &'static str, chart: Result<Curves, PlotError>) {
        match chart {
            Ok(chart) => self.all.push(Charted::new(name, text, chart)),
            Err(reason) => self.left_out.push((name, reason)),
        }
    }

    fn other(&self, norm: &str, sampling: &str) -> Caption {
        let (norm, sampling) = (norm.to_owned(), sampling.to_owned());
        Caption { norm, sampling, ..self.caption.clone() }
    }

    fn over_the_window(&mut self, reference: &Reference) {
        let (question, effort) = (self.question, self.asked.effort);
        (self.tick)("errors over time");
        let axis = Axis::linear("time").unit(self.unit);
        let parts = effort.pick(10, 100);
        self.add(
            "error-over-time",
            "The largest error in each of equal parts of the window. Where a line crosses the upper \
             level its method is of no use any more.",
            over_time(reference, question, axis, parts, self.caption.clone()),
        );
        let caption = self.other(NORM, "the first double at each arrival, and the next one");
        self.add(
            "error-at-arrivals",
            "Just after an echo has arrived, a rounding of its delay costs a method that rounds delays \
             as many units as echoes have arrived.",
            at_arrivals(question, effort.pick(10, 100), caption),
        );
        let caption = self.other(
            "the largest |computed − exact| / |exact| at each distance",
            "on both sides of certified roots from all over the window",
        );
        self.add(
            "error-near-zeros",
            "Relative to the value itself: methods with an absolute error lose a digit for each power \
             of ten that a time is nearer to a zero.",
            near_zeros(question, effort.pick(5, 40), caption),
        );
    }

    fn models(&mut self, reference: &Reference) {
        (self.tick)("models");
        let caption = self.other(
            "|computed − exact| in parts of the largest value: its mean over the times, and the largest, \
             as each curve says",
            &self.asked.sampling.law(),
        );
        let cells = self.asked.effort.pick(50, 800);
        self.add(
            "finite-differences",
            "At Courant's number 1 finite differences follow the characteristics; below, jumps are \
             smeared and ring, however small the cells. Above 1 they are unstable, and refused.",
            over_courant(self.question, (reference, cells), caption),
        );
        let caption = self.other(
            "|computed − exact| at each time alone, in parts of the largest value",
            "60 times after one arrival, their distances in geometric order",
        );
        self.add(
            "modes-near-a-jump",
            "After an arrival in the middle of the window. The nearer to a jump, of the quantity or of \
             its slope, the more modes it takes; at a jump of the quantity they give its mean.",
            near_jump(self.question, self.unit, caption),
        );
    }

    fn by_order(&mut self, period: f64) {
        let (subject, effort) = (self.subject, self.asked.effort);
        let problem = subject.problem;
        (self.tick)("costs");
        let caption = self.other(NORM, &order_law());
        self.add(
            "error-at-high-orders",
            "At n = 400 the exponential of an echo is below all doubles long before the echo is: methods \
             that carry its exponent apart do not notice.",
            over_order(subject, period, effort.high_orders(), caption),
        );
        let with_symbols = match problem.values().is_empty() {
            true => None,
            false => problem.without_values().ok(),
        };
        let symbolic = with_symbols.as_ref().and_then(|problem| {
            let observation = problem.wanted(self.asked.quantity).ok()?.observation()?.clone();
            Some((problem.recurrence().ok()?, observation))
        });
        let costs = cost_over_order(
            subject,
            symbolic.as_ref().map(|(recurrence, observation)| (*recurrence, observation)),
            period,
            effort.orders(),
            effort.settings(),
            self.other(
                "seconds, the least of several runs",
                "64 times on period n; derived are all periods to n",
            ),
        );
        let (values, preparation) = match costs {
            Ok([values, preparation]) => (Ok(values), Ok(preparation)),
            Err(reason) => (Err(reason.clone()), Err(reason)),
        };
        self.add(
            "cost-by-order",
            "Sums of echoes cost the square of the order in the end; polynomials cost the same at any \
             order, once they are made.",
            values,
        );
        self.add(
            "preparation-by-order",
            "Derivation gives the closed forms of all periods to n, as `derive` does; a curve ends with \
             the first one that takes more than 0.3 s. The others prepare values on period n alone, from \
             nothing.",
            preparation,
        );
    }

    fn near_equal_poles(&mut self) {
        (self.tick)("near equal poles");
        let caption = self.other(NORM, "50 times on five periods");
        self.add(
            "error-near-equal-poles",
            "With two poles the formula holds powers of one over their distance, which cancel; \
             polynomials are made from balls that have the bits for it.",
            near_confluence(self.asked.effort.pick(2, 12), caption),
        );
    }

    /// Maps over the order and the one symbol, and where the formula as printed loses its digits.
    fn maps(&mut self, problem: &Problem, symbol: &str) {
        let orders = self.asked.effort.orders();
        let mut rows: Vec<Vec<(f64, Vec<Option<f64>>)>> = vec![Vec::new(); MAPPED.len()];
        let mut refusals: Vec<Vec<String>> = vec![Vec::new(); MAPPED.len()];
        let mut lost = Vec::new();
        for parameter in self.asked.effort.pick(&FEW_PARAMETERS[..], &PARAMETERS) {
            (self.tick)(&format!("maps, {symbol} = {parameter}"));
            // Not every value of a symbol need be possible.
            let Some((value, loss, found)) = self.row(problem, symbol, parameter) else { continue };
            // Of an order that was not looked at nothing is known.
            if found[0].errors.len() == orders.len() || loss.all.is_some() {
                lost.push(loss);
            }
            for (i, mut row) in found.into_iter().enumerate() {
                if row.errors.len() < orders.len() {
                    row.errors.resize(orders.len(), None);
                    let remark = format!("not measured beyond n = {LAST_OF_HUGE}, for its cost");
                    refusals[i].push(format!("{symbol} = {parameter}: {remark}."));
                }
                rows[i].push((value, row.errors));
                refusals[i]
                    .extend(row.refusal.map(|why| format!("{symbol} = {parameter}: {why}.")));
            }
        }
        let caption = |remarks| Caption { remarks, ..caption(self.asked, order_law()) };
        for ((method, rows), refusals) in MAPPED.into_iter().zip(&rows).zip(refusals) {
            let refused = rows.iter().all(|(_, row)| row.iter().all(Option::is_none));
            let map = order_map(method, symbol, orders, rows, caption(refusals));
            if let (false, Ok(map)) = (refused, map) {
                let text = "Colours are powers of ten of the error. The lines are where half of the digits \
                            are lost, and where nothing of use is left.";
                self.all.push(Charted::new(&format!("map-{}", method.name()), text, map));
            }
        }
        let last = orders.last().copied().unwrap_or(0);
        let between = "Near each of the two levels every order is looked at.".to_owned();
        let losses = losses(MAPPED[0], symbol, last, &lost, caption(vec![between]));
        if let Ok((chart, listing)) = losses {
            let text = "The formula as printed, order by order where its digits go.";
            let charted = Charted::new("orders-of-loss", text, chart);
            self.all.push(Charted { listing: Some(listing), ..charted });
        }
    }

    /// The errors of all methods by order at one value of the symbol, and where digits are lost.
    fn row(
        &self,
        problem: &Problem,
        symbol: &str,
        parameter: &str,
    ) -> Option<(f64, Loss, Vec<super::OrderRow>)> {
        let problem = problem.substituted(symbol, parameter).ok()?;
        let end = problem.some_periods(PERIODS_OF_MAPS).ok()?;
        let value = number("a parameter", parameter).ok()?.to_f64()?;
        let subject = Subject { problem: &problem, quantity: self.asked.quantity };
        let period =
            period_of(&problem.question(subject.quantity, [Rational::default(), end]).ok()?)?;
        let is_seen = |order: &&usize| value <= HUGE || **order <= LAST_OF_HUGE;
        let orders = self.asked.effort.orders();
        let seen: Vec<usize> = orders.iter().take_while(is_seen).copied().collect();
        let found = errors_by_order(subject, period, &seen, &MAPPED);
        let known = (&seen[..], &found[0].errors[..]);
        Some((value, first_losses(subject, MAPPED[0], (value, period), known), found))
    }
}

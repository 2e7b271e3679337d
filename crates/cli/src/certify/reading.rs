//! Certificates of values and extrema that are no sums of pieces: where contacts open, in scenes with units, where rates have no
//! formula, and of displacements. A checker follows the line, and reads the value off its elements.

use super::motion::{Line, Precision, written};
use super::window::{around, place, taken, undecided};
use super::writer::Writer;
use super::{Quantity, rounded};
use crate::failure::Failure;
use num_rational::BigRational;
use num_traits::Zero as _;
use serde_json::{Map, Value as Json, json};
use wavestep::ball::{Ball, Bound, Decimal};
use wavestep::expression::Fraction;
use wavestep::network::{
    Contacts, ElementLaw, Face, Field, Lump, MeasuredValue, Passage, Reading, Term,
};
use wavestep::problem::{Problem, number};
use wavestep::scene::Kind;
use wavestep::signal::{At, Limit, Place, Root, Signal, Value};

/// The bits of times that are not claimed.
const SPARE_BITS: u64 = 64;

/// Digits of zeros beyond those asked for.
const SPARE_DIGITS: usize = 3;

/// A time is told by 10^(-ASIDE·digits) later or earlier, so that it is on one side of an arrival.
const ASIDE: i32 = 2;

/// What is read off a motion in a window, or off two, in the unit of an observable.
pub struct Read<'a> {
    line: Line<'a>,
    precision: Precision,
    /// The first and the last time, between two numbers each.
    ends: [[BigRational; 2]; 2],
    digits: usize,
    /// Whether a force at the end of a bar or in a damper is read: beside an open contact it is zero because its parts cancel,
    /// which a checker cannot tell.
    is_beside_contact: bool,
    /// Whether a local contact is in the line: a checker's cells are short beside it, and need no other cuts.
    pub is_beside_local: bool,
    /// Whether it never jumps, so that a checker goes on across an arrival at which it is zero.
    is_continuous: bool,
    document: Map<String, Json>,
}

impl<'a> Read<'a> {
    /// An observable on a window; `None` where it is no sum of readings.
    pub fn of(
        of: &Quantity<'a>,
        [from, to]: [&BigRational; 2],
        digits: usize,
    ) -> Result<Option<Read<'a>>, Failure> {
        let line_of = |problem: &'a Problem, beside| {
            let Ok(network) = problem.network() else { return Ok(None) };
            Line::of(problem, Contacts::of(network.scene()), beside).map(Some)
        };
        let Some(line) = line_of(of.problem, None)? else { return Ok(None) };
        let second = match of.minus {
            None => None,
            Some(other) => match line_of(other, Some(&line))? {
                None => return Ok(None),
                second => second,
            },
        };
        let lines: Vec<&Line<'_>> = std::iter::once(&line).chain(&second).collect();
        // The motion is followed a little further, so that it is known from the last time on.
        let [_, end] = line.in_units(to, SPARE_BITS)?;
        let one = BigRational::from_integer(1.into());
        let share = if end.is_zero() { one } else { end.clone().min(one) };
        let is_beside_local = lines.iter().any(|own| own.network.local_contact().is_some());
        let end = end + share / BigRational::from_integer(8.into());
        let end = Decimal::bound(&end, 6, Bound::Upper).to_rational();
        let unit = line.unit(&line.network.model().scale.time, SPARE_BITS)?;
        let until = &end * &Value::of(&unit, 1).bounds()[1];
        let mut precision = line.precision(&until, digits)?;
        if let Some(second) = &second {
            precision = precision.for_both(second.precision(&until, digits)?);
        }
        let (mut writer, mut is_beside_contact, mut is_continuous) =
            (Writer::default(), false, true);
        let (mut unit, mut documents) = (None, Vec::new());
        for own in &lines {
            let measures = &own.network.measures;
            let measured = measures.iter().find(|measured| measured.name == of.name);
            let Some(measured) = measured else { return Ok(None) };
            let observed = rows(own, &measured.value, &mut writer)?;
            let mut document = own.document([&end, &until], digits, precision.bits, &mut writer)?;
            document.insert("observed".into(), observed);
            documents.push(document);
            unit.get_or_insert(&measured.unit);
            is_beside_contact |=
                own.network.scene().contacts_open && is_force_at_end(own, &measured.value);
            is_continuous &= never_jumps(own, &measured.value);
        }
        let unit = line.unit(unit.expect("there is a line"), precision.bits)?;
        let unit = Value::of(&unit, 1).bounds();
        if let [own, other] = &documents[..]
            && shares_event(own, other)
        {
            let message = "there are no certificates of differences where contacts of both scenes change at one time that is not rational";
            return Err(Failure::usage(message, "ask for an earlier end"));
        }
        let mut documents = documents.into_iter();
        let mut document = documents.next().expect("there is a line");
        document.extend(lines[lines.len() - 1].followed(&end, &precision, &writer));
        document.insert("quantity".into(), json!(of.name));
        document.insert("unit".into(), json!(written(unit, precision.bits as usize / 3)));
        document.extend(documents.next().map(|second| ("minus".into(), Json::Object(second))));
        let ends = [line.in_units(from, precision.bits)?, line.in_units(to, precision.bits)?];
        Ok(Some(Read {
            line,
            precision,
            ends,
            digits,
            is_beside_contact,
            is_beside_local,
            is_continuous,
            document,
        }))
    }

    fn claiming(mut self, kind: &str, claims: Json) -> Map<String, Json> {
        let Json::Object(claims) = claims else { unreachable!("claims have names") };
        self.document.insert("kind".into(), json!(kind));
        self.document.extend(claims);
        self.document
    }

    fn told(&self, time: &[BigRational; 2]) -> Json {
        json!(written(time.clone(), self.precision.bits as usize / 3))
    }

    /// The value at the last time.
    pub fn value(self, value: &Value) -> Map<String, Json> {
        let (decimal, last_place) = rounded(value, self.digits);
        let at = self.told(&self.ends[1]);
        let value = decimal.to_string();
        self.claiming("reading", json!({ "at": at, "value": value, "last_place": last_place }))
    }

    /// Values at evenly spaced times, each with a bound of its error.
    pub fn values(self, values: Vec<Json>) -> Map<String, Json> {
        let [from, until] = self.ends.each_ref().map(|end| self.told(end));
        let points = values.len();
        let claims = json!({ "from": from, "until": until, "points": points, "values": values });
        self.claiming("readings", claims)
    }

    /// A largest or smallest value that is taken at the first place of these, with the times that cut the window.
    pub fn extreme(
        self,
        mut claims: Json,
        times: &[BigRational],
        place: &Place,
    ) -> Result<Map<String, Json>, Failure> {
        let [from, until] = &self.ends;
        let aside = BigRational::from_integer(10.into()).pow(-ASIDE * self.digits as i32);
        let aside = aside.min((&until[0] - &from[1]) / BigRational::from_integer(4.into()));
        let times = self.hints(times)?;
        let (time, before) = taken(place)?;
        let [low, high] = self.in_units(&time.bounds())?;
        let after = |[low, high]: [BigRational; 2]| if low == high { high } else { high + &aside };
        let time = if before { low - &aside } else { after([low, high]) };
        let time = time.max(after(from.clone())).min(&until[0] - &aside);
        claims["from"] = self.told(from);
        claims["until"] = self.told(until);
        claims["times"] = json!(times);
        claims["attained"] = json!(time.to_string());
        Ok(self.claiming("extreme", claims))
    }

    /// All zeros in the window, with the times that cut it.
    pub fn zeros(
        mut self,
        signal: &dyn Signal,
        roots: &[Root],
        mut times: Vec<BigRational>,
    ) -> Result<Map<String, Json>, Failure> {
        let (mut zeros, mut rests) = (Vec::new(), Vec::new());
        let sides = Sides::of(signal, self.digits)?;
        let refuse_flat = |rest: &Value| {
            if !self.is_beside_local || sides.is_steep_after(&around(rest, self.digits))? {
                return Ok(());
            }
            let message =
                "beside a local contact there are no certificates of zeros of what begins flat";
            Err(Failure::usage(message, "certify the zeros of its compression"))
        };
        let told = |window: &[BigRational; 2]| {
            Ok::<_, Failure>(written(self.in_units(window)?, self.digits + SPARE_DIGITS))
        };
        for root in roots {
            match root {
                Root::Interval { from, to, .. } => {
                    let is_first = self.in_units(&from.bounds())?[0] <= self.ends[0][1];
                    if self.is_beside_contact && !is_first {
                        let message = "there are no certificates of values that are zero beside an open contact";
                        let remedy = "observe a spring there, or ask for an earlier end";
                        return Err(Failure::usage(message, remedy));
                    }
                    refuse_flat(to)?;
                    // Just before a rest a checker cannot tell a small value from zero.
                    let told_by = |time: &Value, is_known: bool| match time.exact() {
                        Some(_) if is_known => time.bounds(),
                        _ => around(time, self.digits),
                    };
                    let (from, to) = (told_by(from, is_first), told_by(to, true));
                    rests.push([told(&from)?, told(&to)?]);
                }
                // At the last time there is a limit alone.
                Root::End { time } if time.exact() != Some(signal.window()[1]) => {
                    refuse_flat(time)?;
                    rests.push([told(&time.bounds())?, told(&time.bounds())?]);
                }
                Root::End { .. } => return Err(undecided("the sign at the end of the window")),
                _ => {
                    let window = match root {
                        Root::Arrival { time, .. } => Some(around(time, self.digits)),
                        _ => place(root, self.digits)?,
                    };
                    let Some(window) = &window else { continue };
                    if sides.has_arrival(window) && !(self.is_continuous && sides.differ(window)?) {
                        return Err(undecided("the sign where a wave arrives"));
                    }
                    times.retain(|time| *time <= window[0] || window[1] <= *time);
                    zeros.push(told(window)?);
                }
            }
        }
        let claims = json!({
            "from": self.told(&self.ends[0]),
            "until": self.told(&self.ends[1]),
            "times": self.hints(&times)?,
            "zeros": zeros,
            "rests": rests,
        });
        let is_exact =
            |root: &Root| matches!(root, Root::Simple { time, .. } if time.exact().is_some());
        if roots.iter().any(is_exact) {
            // A checker's steps are not to end there.
            let step = unusual(&self.document["step"]);
            self.document.insert("step".into(), json!(step));
        }
        // Zero is zero in every unit.
        self.document.remove("unit");
        Ok(self.claiming("zeros", claims))
    }

    /// A time between two, in the unit of the line.
    fn in_units(&self, [low, high]: &[BigRational; 2]) -> Result<[BigRational; 2], Failure> {
        let bits = self.precision.bits;
        let [low, _] = self.line.in_units(low, bits)?;
        let [_, high] = self.line.in_units(high, bits)?;
        Ok([low, high])
    }

    /// Times near these, at which a checker may cut the window.
    fn hints(&self, times: &[BigRational]) -> Result<Vec<String>, Failure> {
        let digits = (1 + ASIDE as usize) * self.digits;
        let near = |time: &BigRational| {
            let [low, high] = self.line.in_units(time, self.precision.bits)?;
            let exact = low.to_string();
            Ok(match low == high && exact.len() <= digits {
                true => exact,
                false => Decimal::bound(&low, digits, Bound::Lower).to_string(),
            })
        };
        times.iter().map(near).collect()
    }
}

/// What is read on both sides of a time.
struct Sides<'a> {
    signal: &'a dyn Signal,
    bits: u64,
    /// When its stretches begin, about, but for the first.
    arrivals: Vec<BigRational>,
}

impl<'a> Sides<'a> {
    fn of(signal: &'a dyn Signal, digits: usize) -> Result<Sides<'a>, Failure> {
        let bits = SPARE_BITS + 4 * digits as u64;
        let time = |stretch| Ok(signal.time(stretch, Limit::Right, bits)?.midpoint().into());
        let arrivals = (1..signal.count()?).map(time).collect::<Result<_, Failure>>()?;
        Ok(Sides { signal, bits, arrivals })
    }

    fn value(&self, time: &BigRational) -> Result<Ball, Failure> {
        let stretch = self.signal.stretch_at(time, Limit::Right)?;
        let stretch = stretch.expect("it is in the window");
        Ok(self.signal.enclose(stretch, 0, At::Time(time), self.bits)?)
    }

    fn has_arrival(&self, [low, high]: &[BigRational; 2]) -> bool {
        self.arrivals.iter().any(|time| low <= time && time <= high)
    }

    /// Whether the signs at both ends differ: what never jumps goes through zero there.
    fn differ(&self, [low, high]: &[BigRational; 2]) -> Result<bool, Failure> {
        let signs = [self.value(low)?.sign(), self.value(high)?.sign()];
        Ok(
            matches!(signs, [Some(before), Some(after)] if before.is_ne() && after == before.reverse()),
        )
    }

    /// Whether it begins like t at a time between two, and not flatter, or ends there: twice as late it is less than three times
    /// as large. A checker's first cell beside a local contact has one order, and tells no more from zero.
    fn is_steep_after(&self, [low, high]: &[BigRational; 2]) -> Result<bool, Failure> {
        let integer = |number: u32| BigRational::from_integer(number.into());
        let later = |widths: u32| low + (high - low) * integer(widths);
        let [once, twice] = [1 << 10, 1 << 11].map(later);
        if twice >= *self.signal.window()[1] {
            return Ok(true);
        }
        let thrice = self.value(&once)?.multiply_rational(&integer(3), self.bits);
        let more = thrice.subtract(&self.value(&twice)?, self.bits).sign();
        Ok(more.is_some() && more == thrice.sign())
    }
}

/// Whether events of two motions cannot be told apart.
fn shares_event(own: &Map<String, Json>, other: &Map<String, Json>) -> bool {
    let times = |document: &Map<String, Json>| -> Vec<[BigRational; 2]> {
        let end = |end: &Json| number("an event", end.as_str().unwrap_or("0")).expect("a number");
        let events = document["events"].as_array().into_iter().flatten();
        events.map(|event| [end(&event[2]), end(&event[3])]).collect()
    };
    let others = times(other);
    let meets = |[low, high]: &[BigRational; 2]| {
        others.iter().any(|[from, to]| low < high && from <= high && low <= to)
    };
    times(own).iter().any(meets)
}

/// What is read of the elements of a line.
fn rows(line: &Line<'_>, value: &MeasuredValue, writer: &mut Writer) -> Result<Json, Failure> {
    let (held, passed) = match value {
        MeasuredValue::Linear(terms) => {
            return Ok(terms.iter().map(|term| read(line, term, writer)).collect());
        }
        MeasuredValue::Energy { held, passed } => (held, passed),
    };
    let (elements, layout) = (&line.network.scene().elements, &line.network.layout);
    let is_load = |element: usize| matches!(elements[element].kind, Kind::Load(_));
    let mut rows = Vec::new();
    let is_local = |own: usize| matches!(elements[own].kind, Kind::Hertz(_));
    if held.iter().any(|own| is_local(own.1)) {
        let message = "there are no certificates of the energy of local contacts";
        let remedy = "observe its force and its compression";
        return Err(Failure::usage(message, remedy));
    }
    // Loads hold none.
    for (c, own) in held.iter().filter(|own| !is_load(own.1)) {
        rows.push(json!([writer.function(c), "energy", elements[*own].name]));
    }
    for (c, passage) in passed {
        let c = writer.function(c);
        rows.push(match passage {
            Passage::Section(section) => {
                let delays = section
                    .delays
                    .each_ref()
                    .map(|own| own.as_ref().map(|own| writer.function(own)));
                let bar = layout.bars[section.bar];
                json!([c, "work", elements[bar].name, delays[0], delays[1]])
            }
            Passage::Damper(lump) => {
                let element = layout.nodes[lump.node].elements[lump.place].element;
                json!([c, "loss", elements[element].name])
            }
            Passage::Load(_) => {
                let message = "there are no certificates of the work of loads";
                let remedy = "observe the work at the end of a bar next to it";
                return Err(Failure::usage(message, remedy));
            }
        });
    }
    Ok(Json::Array(rows))
}

/// Whether only displacements are read, velocities of masses, and how far springs and local contacts are pressed.
fn never_jumps(line: &Line<'_>, value: &MeasuredValue) -> bool {
    let nodes = &line.network.layout.nodes;
    let law = |own: &Lump| &nodes[own.node].elements[own.place].law;
    let MeasuredValue::Linear(terms) = value else { return false };
    terms.iter().all(|term| match &term.of {
        Reading::InBar(field, _) => matches!(field, Field::Displacement),
        Reading::Displacement(_) => true,
        Reading::Velocity(face) => matches!(law(&face.lump()), ElementLaw::Mass { .. }),
        Reading::Compression(own) => law(own).is_link(),
        _ => false,
    })
}

/// Whether a force at the end of a bar or in a damper is read.
fn is_force_at_end(line: &Line<'_>, value: &MeasuredValue) -> bool {
    let layout = &line.network.layout;
    let is_at_end = |term: &Term| match &term.of {
        Reading::InBar(Field::Force, section) => section.end(Fraction::is_zero).is_some(),
        Reading::Force(Lump { node, place }) => {
            let resistance = layout.nodes[*node].elements[*place].law.resistance();
            resistance.is_some_and(|[_, damping]| !damping.is_zero())
        }
        _ => false,
    };
    matches!(value, MeasuredValue::Linear(terms) if terms.iter().any(is_at_end))
}

/// A shorter step, of which the times that people write are no multiples.
fn unusual(step: &Json) -> String {
    let step = step.as_str().and_then(|text| text.parse::<BigRational>().ok());
    let share = BigRational::new(997.into(), 1024.into());
    (step.expect("a step is a number") * share).to_string()
}

/// `[coefficient, what, element, …]`: of bars with the delays of both waves, of springs with a side.
fn read(line: &Line<'_>, term: &Term, writer: &mut Writer) -> Json {
    let layout = &line.network.layout;
    let name = |element: usize| &line.network.scene().elements[element].name;
    let lump = |lump: &Lump| &layout.nodes[lump.node].elements[lump.place];
    let coefficient = writer.function(&term.coefficient);
    let beside = |what: &str, face: &Face| {
        let own = lump(&face.lump());
        let mut row = vec![coefficient.clone(), json!(what), json!(name(own.element))];
        if own.law.is_link() {
            row.push(json!(if matches!(face, Face::Left(_)) { "left" } else { "right" }));
        }
        json!(row)
    };
    match &term.of {
        Reading::InBar(field, section) => {
            let what = match field {
                Field::Velocity => "velocity",
                Field::Displacement => "displacement",
                Field::Force => "force",
            };
            let mut delay = |own: &Option<Fraction>| own.as_ref().map(|own| writer.function(own));
            let [right, left] = &section.delays;
            let delays = [delay(right), delay(left)];
            json!([coefficient, what, name(layout.bars[section.bar]), delays[0], delays[1]])
        }
        Reading::Velocity(face) => beside("velocity", face),
        Reading::Displacement(face) => beside("displacement", face),
        Reading::Compression(own) => json!([coefficient, "compression", name(lump(own).element)]),
        Reading::Force(own) => json!([coefficient, "force", name(lump(own).element)]),
        Reading::Momentum(bar) => json!([coefficient, "momentum", name(layout.bars[*bar])]),
    }
}

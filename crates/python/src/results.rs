//! Results as dataclasses of the package.

use crate::value::Value;
use numpy::{PyArray1, PyArrayMethods as _};
use pyo3::IntoPyObjectExt as _;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use wavestep::{
    BarFields, Body, Bounded, ContactSummary, Doubles, Ending, Event, EventKind, Extremum, Fields,
    History, Place, Quantity, Root, Value as Proven,
};

type Object<'py> = PyResult<Bound<'py, PyAny>>;

/// An object of a dataclass from its fields in order.
fn make<'py>(
    py: Python<'py>,
    class: &str,
    fields: impl IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>, Error = PyErr>,
) -> Object<'py> {
    let fields = fields.into_pyobject(py)?;
    py.import("wavestep._results")?.getattr(class)?.call1(fields)
}

/// A tuple of what is made of each.
fn all<'py, T>(
    py: Python<'py>,
    items: &[T],
    each: impl Fn(Python<'py>, &T) -> Object<'py>,
) -> PyResult<Bound<'py, PyTuple>> {
    let items = items.iter().map(|item| each(py, item)).collect::<PyResult<Vec<_>>>()?;
    PyTuple::new(py, items)
}

fn value(value: &Proven) -> Value {
    Value(value.clone())
}

fn perhaps(value: &Option<Proven>) -> Option<Value> {
    value.clone().map(Value)
}

pub fn root<'py>(py: Python<'py>, root: &Root) -> Object<'py> {
    let (kind, from, to) = match root {
        Root::Simple { time, .. } => ("simple", time.clone(), time.clone()),
        Root::Double { time } => ("double", time.clone(), time.clone()),
        Root::End { time } => ("end", time.clone(), time.clone()),
        Root::Arrival { time, .. } => ("arrival", time.clone(), time.clone()),
        Root::Jump { time, .. } => ("jump", time.clone(), time.clone()),
        Root::Interval { from, to, .. } => ("interval", from.clone(), to.clone()),
        Root::Undecided { from, to, .. } => {
            ("undecided", Proven::Exact(from.clone()), Proven::Exact(to.clone()))
        }
    };
    make(py, "Root", (kind, Value(from), Value(to), root.rises()))
}

fn place<'py>(py: Python<'py>, place: &Place) -> Object<'py> {
    let (kind, from, to) = match place {
        Place::Critical(time) => ("critical", time.clone(), time.clone()),
        Place::End(time) => ("end", time.clone(), time.clone()),
        Place::Arrival { time, .. } => ("arrival", time.clone(), time.clone()),
        Place::Plateau { from, to, .. } => ("plateau", from.clone(), to.clone()),
        Place::Undecided { from, to } => {
            ("undecided", Proven::Exact(from.clone()), Proven::Exact(to.clone()))
        }
    };
    make(py, "Place", (kind, Value(from), Value(to), place.is_attained()))
}

pub fn extremum<'py>(py: Python<'py>, found: &Extremum) -> Object<'py> {
    make(py, "Extremum", (value(&found.value), all(py, &found.places, place)?))
}

fn body<'py>(py: Python<'py>, body: &Body) -> Object<'py> {
    let Body { elements, energy, momentum, velocity, vibration } = body;
    let elements = PyTuple::new(py, elements)?;
    let numbers = [energy, momentum, velocity, vibration].map(perhaps);
    let [energy, momentum, velocity, vibration] = numbers;
    make(py, "Body", (elements, energy, momentum, velocity, vibration))
}

fn event<'py>(py: Python<'py>, event: &Event) -> Object<'py> {
    let kind = match event.kind {
        EventKind::Impact => "impact",
        EventKind::Opening => "opening",
        EventKind::Release => "release",
        EventKind::Closing => "closing",
    };
    let between = (&event.between[0], &event.between[1]);
    let pair = |[before, after]: &[Proven; 2]| (value(before), value(after));
    let velocities = (pair(&event.velocities[0]), pair(&event.velocities[1]));
    let bodies = all(py, &event.bodies, body)?;
    make(py, "Event", (kind, between, value(&event.time), pair(&event.forces), velocities, bodies))
}

fn contact<'py>(py: Python<'py>, contact: &ContactSummary) -> Object<'py> {
    let between = (&contact.between[0], &contact.between[1]);
    let durations = PyTuple::new(py, contact.durations.iter().map(perhaps))?;
    let impulses = PyTuple::new(py, contact.impulses.iter().map(value))?;
    make(py, "Contact", (between, durations, impulses, perhaps(&contact.restitution)))
}

pub fn history<'py>(py: Python<'py>, history: &History) -> Object<'py> {
    let (ending, until) = match &history.ending {
        Ending::Parted => ("parted", None),
        Ending::Followed(until) => ("followed", Some(value(until))),
        Ending::NoContact => ("no contact", None),
    };
    let events = all(py, &history.events, event)?;
    let contacts = all(py, &history.contacts, contact)?;
    let assumptions = PyTuple::new(py, &history.assumptions)?;
    make(py, "History", (events, contacts, ending, until, assumptions))
}

fn bar<'py>(py: Python<'py>, bar: &BarFields) -> Object<'py> {
    let array = |read: &dyn Fn(&Bounded) -> f64, quantity| {
        PyArray1::from_iter(py, bar.of(quantity).iter().map(read))
    };
    let [velocity, strain, displacement, force] =
        Quantity::ALL.map(|quantity| array(&|field| field.value, quantity));
    let bounds = pyo3::types::PyDict::new(py);
    for quantity in Quantity::ALL {
        bounds.set_item(quantity.name(), array(&|field| field.bound, quantity))?;
    }
    let x = PyArray1::from_slice(py, &bar.x);
    make(py, "BarField", (&bar.name, x, velocity, strain, displacement, force, bounds))
}

pub fn fields<'py>(py: Python<'py>, fields: &Fields) -> Object<'py> {
    make(py, "Field", (fields.time.clone(), all(py, &fields.bars, bar)?))
}

/// Values in an array of a shape.
pub fn doubles<'py>(py: Python<'py>, found: Doubles, shape: &[usize]) -> Object<'py> {
    let values = PyArray1::from_vec(py, found.values).reshape(shape)?.into_bound_py_any(py)?;
    make(py, "Values", (values, found.bound, found.method.to_string(), found.law))
}

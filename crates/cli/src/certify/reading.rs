//! Certificates of values that are no sums of pieces: where contacts open, in scenes with units, where rates have no formula, and
//! of displacements. A checker follows the line, and reads the value off its elements.

use super::motion::{Line, written};
use super::rounded;
use super::writer::Writer;
use crate::failure::Failure;
use num_rational::BigRational;
use serde_json::{Map, Value as Json, json};
use wavestep::ball::{Bound, Decimal};
use wavestep::expression::Fraction;
use wavestep::network::{Contacts, Face, Field, Lump, MeasuredValue, Reading, Term};
use wavestep::problem::Problem;
use wavestep::signal::Value;

/// The bits of times that are not claimed.
const SPARE_BITS: u64 = 64;

/// A value of an observable at a time; `None` where it is no sum of readings.
pub fn certificate(
    problem: &Problem,
    name: &str,
    (at, value): (&BigRational, &Value),
    digits: usize,
) -> Result<Option<Map<String, Json>>, Failure> {
    let Ok(network) = problem.network() else { return Ok(None) };
    let line = Line::of(problem, Contacts::of(network.scene()))?;
    let measured = network.as_ref().measures.iter().find(|measured| measured.name == name);
    let Some((measured, MeasuredValue::Linear(terms))) = measured.map(|own| (own, &own.value))
    else {
        return Ok(None);
    };
    let mut writer = Writer::default();
    let rows: Option<Vec<Json>> = terms.iter().map(|term| read(&line, term, &mut writer)).collect();
    let Some(rows) = rows else { return Ok(None) };
    // The motion is followed a little further, so that it is known from this time on.
    let end = &line.in_units(at, SPARE_BITS)?[1] + BigRational::new(1.into(), 8.into());
    let end = Decimal::bound(&end, 6, Bound::Upper).to_rational();
    let unit = line.unit(&line.network.model().scale.time, SPARE_BITS)?;
    let until = &end * &Value::of(&unit, 1).bounds()[1];
    let precision = line.precision(&until, digits)?;
    let at = line.in_units(at, precision.bits)?;
    let places = precision.bits as usize / 3;
    let unit = Value::of(&line.unit(&measured.unit, precision.bits)?, 1).bounds();
    let (decimal, last_place) = rounded(value, digits);
    let mut document = line.document("reading", &end, &until, digits, &precision, &mut writer)?;
    document.insert("quantity".into(), json!(name));
    document.insert("observed".into(), json!(rows));
    document.insert("unit".into(), json!(written(unit, places)));
    document.insert("at".into(), json!(written(at, places)));
    document.insert("value".into(), json!(decimal.to_string()));
    document.insert("last_place".into(), json!(last_place));
    Ok(Some(document))
}

/// `[coefficient, what, element, …]`: of bars with the delays of both waves, of springs with a side.
fn read(line: &Line<'_>, term: &Term, writer: &mut Writer) -> Option<Json> {
    let layout = &line.network.as_ref().layout;
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
    Some(match &term.of {
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
        Reading::Momentum(_) => return None,
    })
}

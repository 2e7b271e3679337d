//! Questions that have an answer, each of which was once refused, or not answered in time.

use wavestep::{Error, Problem};

/// A ram, a cushion and a helmet on a pile with dashpots along it: two dashpots and a bar between two
/// bars of one impedance divide by `(δ + 2)² (4δ + 1)`.
const PILE: &str = r#"scene "A pile with dashpots"
material concrete { modulus = 40 GPa, density = 2400 kg/m^3 }
mass    ram    { mass = 5000 kg, velocity = sqrt(2*9.81*0.8) m/s }
spring  packing { stiffness = 1 GN/m }
mass    helmet { mass = 900 kg }
bar     upper  { material = concrete, diameter = 400 mm, length = 8 m }
support side1  { damping = 60 kN*s/m }
bar     middle { material = concrete, diameter = 400 mm, length = 8 m }
support side2  { damping = 60 kN*s/m }
bar     lower  { material = concrete, diameter = 400 mm, length = 8 m }
support toe    { damping = 150 kN*s/m, stiffness = 80 MN/m }
line free - ram | packing - helmet - upper - side1 - middle - side2 - lower - toe - free
observe head = force(upper.left)
observe set  = displacement(lower.right)
"#;

#[test]
fn dashpots_along_a_pile_divide_by_what_is_positive() -> Result<(), Error> {
    let closed = Problem::read("pile.wave", PILE)?;
    let open = Problem::read("pile.wave", format!("{PILE}contacts open\n"))?;
    for (quantity, time) in [("head", "4 ms"), ("head", "8 ms"), ("set", "9 ms")] {
        let value = |pile: &Problem| pile.signal(quantity)?.at(time, 12).map(|v| v.to_text(12));
        assert_eq!(value(&closed)?, value(&open)?, "{quantity} at {time}");
    }
    Ok(())
}

#[test]
fn roots_of_numbers_are_positive() -> Result<(), Error> {
    let text = "scene \"A\"\nmass m { mass = sqrt(2)/10, velocity = 1 }\n\
        bar b { impedance = 1, travel = 1 }\nline free - m - b - fixed\nobserve v = velocity(m)";
    // Until the first echo v = exp(−t/m).
    let value = Problem::read("root.wave", text)?.signal("v")?.at(1, 12)?.to_f64();
    assert!((value - (-10.0 / 2_f64.sqrt()).exp()).abs() < 1e-12);
    Ok(())
}

//! The example of the README: the first four functions of a wave as LaTeX, and thirty proven digits.

use wavestep::Problem;

fn main() -> Result<(), wavestep::Error> {
    let p = Problem::builtin("rigid-mass")?;
    for f in p.derive("f", 0..=3)? {
        println!("{}", f.latex());
    }
    let p = p.with("mu", "1/4")?;
    let f = p.signal("f")?;
    println!("{}", f.at("33/10", 30)?); // 0.305385264408791064086396952466
    Ok(())
}

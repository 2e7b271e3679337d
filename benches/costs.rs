//! The costs of `src/answer/costs.txt`, measured: prints such a file. Run `cargo bench --bench costs` on a quiet machine;
//! the clock counts.

use std::time::Duration;
use wavestep_studies::study::measured_costs;

fn main() {
    print!("{}", measured_costs(Duration::from_millis(300)).expect("methods with values").text());
}

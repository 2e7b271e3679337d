//! Prints errors and orders, and draws them: `cargo run -p verify-finite-difference -- errors.svg`.

use std::error::Error;
use verify_finite_difference::{CASES, Errors, errors, figure, order};
use wavestep_draw::Chart;

const CELLS: [usize; 6] = [40, 80, 160, 320, 640, 1280];

fn main() -> Result<(), Box<dyn Error>> {
    for (end, _) in CASES {
        println!("{end:?}: cells, errors (mean, root of the mean square, largest), orders");
        let mut before: Option<Errors> = None;
        for cells in CELLS {
            let found = errors(end, cells)?;
            let Errors { mean, square, largest, .. } = found;
            print!("{cells:>6} {mean:>10.2e} {square:>10.2e} {largest:>10.2e}");
            if let Some(before) = before {
                for (coarse, fine) in
                    [(before.mean, mean), (before.square, square), (before.largest, largest)]
                {
                    print!(" {:>6.2}", order((before.cells, coarse), (cells, fine)));
                }
            }
            println!();
            before = Some(found);
        }
    }
    if let Some(file) = std::env::args().nth(1) {
        std::fs::write(file, figure(&CELLS)?.svg())?;
    }
    Ok(())
}

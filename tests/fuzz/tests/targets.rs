//! Every target holds for seeds that are altered, the same ones in every run.

use std::time::Duration;
use wavestep_fuzz::{TARGETS, Target};

fn holds(name: &str) {
    let target = Target::find(name).expect("a target");
    let (count, longest) = target.try_many(target.cases, Duration::MAX, 1);
    println!("{name}: {count} inputs, the longest took {longest:?}");
    assert_eq!(count, target.cases);
}

macro_rules! targets {
    ($($name:ident)*) => {
        $(#[test] fn $name() { holds(stringify!($name)); })*

        #[test]
        fn every_target_is_tried() {
            assert_eq!(TARGETS.map(|target| target.name), [$(stringify!($name)),*]);
        }
    };
}

targets!(scenes recurrences expressions locks values certificates tables decimals balls kernels);

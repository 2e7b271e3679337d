//! What is held of a march.

use wavestep::signal::method::marched_response::Held;
use wavestep_kernels::march::{March, MarchOptions, Reflection};

#[test]
fn what_is_held_is_what_the_march_had() {
    let reflection = Reflection::exact(2.0, 2.0, -0.5).unwrap();
    let mut march = March::new(&reflection, MarchOptions::default()).unwrap();
    let (mut held, mut expected) = (Held::default(), Vec::new());
    for _ in 0..20 {
        held = held.with_period(march.coefficients()).unwrap();
        expected.push(march.coefficients().to_vec());
        march.advance().unwrap();
    }
    for (period, expected) in expected.iter().enumerate() {
        assert_eq!(held.period(period), expected);
    }
    assert!(held.with_period(&vec![0.0; Held::MOST]).is_none());
}

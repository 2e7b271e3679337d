//! The loop that raises the precision.

use wavestep::ball::{Attempt, Precisions};

#[test]
fn precisions_double_up_to_the_limit() {
    let all = |precisions: Precisions| precisions.iter().collect::<Vec<_>>();
    assert_eq!(all(Precisions::doubling(82, 400)), [82, 164, 328, 400]);
    assert_eq!(all(Precisions::doubling(64, 256)), [64, 128, 256]);
    assert_eq!(all(Precisions::doubling(64, 8)), [8]);
    assert_eq!(all(Precisions::growing_by_half(164, 2048)), [164, 246, 369, 553, 829, 1243, 1864]);
    assert_eq!(all(Precisions::growing_by_half(512, 1152)), [512, 768, 1152]);
    assert_eq!(all(Precisions::growing_by_half(3000, 2048)), [3000]);
}

#[test]
fn attempts_end_when_one_is_done_or_fails() {
    let precisions = Precisions::doubling(10, 100);
    let raise =
        |enough: u64| precisions.raise(|bits| Ok::<_, u64>(Attempt::of(bits, bits >= enough)));
    assert_eq!(raise(40), Ok(Attempt::Done(40)));
    assert_eq!(raise(200), Ok(Attempt::NotYet(100)));
    let failed =
        precisions.raise(|bits| if bits > 10 { Err(bits) } else { Ok(Attempt::of(bits, false)) });
    assert_eq!(failed, Err(20));
}

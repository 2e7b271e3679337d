//! Lines of formulas.

use wavestep::export::lines::Writing;

fn writing(text: &str) -> Writing {
    let mut writing = Writing::default();
    for word in text.split_inclusive(' ') {
        if word.trim() == "+" {
            writing.allow_break(0);
        }
        writing.push(word, word.chars().count());
    }
    writing
}

#[test]
fn lines_break_before_signs_and_lose_nothing() {
    let text = "aaaa + bbbb + cccc + dddddddddddddddddddddd + e";
    let lines = ["aaaa + bbbb", "+ cccc", "+ dddddddddddddddddddddd", "+ e"];
    assert_eq!(writing(text).lines(14, 0, 2), lines);
    assert_eq!(writing(text).lines(100, 0, 2), [text]);
    assert!(Writing::default().lines(10, 0, 0).is_empty());
}

#[test]
fn lines_break_outside_of_brackets_in_their_second_half() {
    let mut writing = Writing::default();
    for (text, depth) in [("aaaa", 0), ("+bbb", 0), ("+(cc", 0), ("+dd)", 1), ("+eee", 0)] {
        writing.allow_break(depth);
        writing.push(text, 4);
    }
    assert_eq!(writing.lines(15, 0, 0), ["aaaa+bbb", "+(cc+dd)+eee"]);
}

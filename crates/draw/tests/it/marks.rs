//! Marks of charts: rings for preparation, labels beside lines, points above a ceiling; what is clipped, and
//! pixels.

use wavestep_draw::{
    Axis, Caption, Cell, Chart, Curve, Curves, Line, Method, Point, WorkPrecision, png,
};

fn point(setting: &str, error: f64, seconds: f64) -> Point {
    Point { setting: setting.into(), error, bound: None, seconds, prepared: None }
}

fn number(text: &str) -> f64 {
    let end = text.find(|c: char| !(c.is_ascii_digit() || ".-".contains(c))).unwrap_or(text.len());
    text[..end].parse().unwrap()
}

/// The place of the marker with this text.
fn marker(svg: &str, about: &str) -> (f64, f64) {
    let title = svg.find(&format!("<title>{about}")).expect(about);
    let place = svg[..title].rsplit("translate(").next().unwrap();
    let (x, y) = place.split_once(' ').unwrap();
    (number(x), number(y))
}

/// A dotted line leads up to a ring at the time with preparation.
#[test]
fn preparations_stand_above_their_points() {
    let prepared = Point { prepared: Some(1e-3), ..point("rough", 1e-6, 1e-6) };
    // Less than a tenth more is not seen.
    let alike = Point { prepared: Some(1.05e-5), ..point("fine", 1e-9, 1e-5) };
    let method = Method { name: "march".into(), points: vec![prepared, alike] };
    let chart = WorkPrecision::new("Prepared", vec![method.clone()], Caption::default()).unwrap();
    let svg = chart.svg();
    let lines: Vec<&str> = svg.split("class=\"prepared c0\" d=\"M").skip(1).collect();
    assert_eq!(lines.len(), 1);
    let (from, to) = lines[0].split_once('L').unwrap();
    let [from, to] = [from, to].map(|at| at.split_once(' ').map(|(x, y)| (number(x), number(y))));
    let (from, to) = (from.unwrap(), to.unwrap());
    assert_eq!(from, marker(&svg, "march (rough)"));
    // From 1e-6 to 1e-3 are three decades, but for the radius of the ring; to "fine" it is one.
    let decade = from.1 - marker(&svg, "march (fine)").1;
    assert!((from.1 - to.1 + 3.5 - 3.0 * decade).abs() < 0.05, "{from:?} {to:?} {decade}");
    assert!(svg.contains("0.001 with preparation") && to.1 > 40.0);
    assert_eq!(chart.json()["methods"][0]["points"][0]["seconds_with_preparation"], 1e-3);
    let nothing = Point { prepared: Some(0.0), ..method.points[0].clone() };
    let bad = Method { points: vec![nothing], ..method };
    assert!(WorkPrecision::new("Prepared", vec![bad], Caption::default()).is_err());
}

/// Labels of settings lie on no line, and are left out where they would.
#[test]
fn labels_lie_on_no_line() {
    let points = (0..12).map(|i| point(&format!("N = {i}"), 10f64.powi(-i), 1e-6));
    let method = Method { name: "flat".into(), points: points.collect() };
    let chart = WorkPrecision::new("Flat", vec![method], Caption::default()).unwrap();
    let svg = chart.svg();
    let height = marker(&svg, "flat (N = 3)").1;
    let labels = svg.split("class=\"label\"").skip(1);
    let bases: Vec<f64> =
        labels.map(|label| number(label.split_once(" y=\"").unwrap().1)).collect();
    assert!(bases.len() > 6, "{bases:?}");
    // A base line is 11 pixels below the upper edge of its label at most.
    assert!(bases.iter().all(|y| *y < height || *y > height + 8.0), "{bases:?} {height}");
}

/// Above a ceiling points stand in a row at the upper edge, the infinite ones too, and are counted.
#[test]
fn what_is_above_the_ceiling_stands_at_the_upper_edge() {
    let points = vec![(1.0, 1e-9), (2.0, 1e-3), (3.0, 1e80), (4.0, f64::INFINITY)];
    let curve = |points| vec![Curve { name: "steep".into(), points }];
    let (x, y) = (Axis::linear("order"), Axis::logarithmic("error"));
    let chart = |points| {
        Curves::new("Steep", x.clone(), y.clone(), curve(points), Caption::default()).unwrap()
    };
    let clipped = chart(points.clone()).ceiling(100.0).unwrap();
    let svg = clipped.svg();
    let abouts = ["steep: 10⁻⁹", "steep: 0.001", "steep: 10⁸⁰", "steep: infinite"];
    let places = abouts.map(|about| marker(&svg, about));
    assert_eq!(places[2].1, places[3].1);
    assert!(places[2].1 < places[1].1 && places[1].1 < places[0].1);
    // Six of the eleven decades lie between the first two points.
    assert!(places[0].1 - places[1].1 > 150.0, "{places:?}");
    assert!(svg.contains("off the scale: above 100 (2"), "{svg}");
    assert_eq!(clipped.json()["ceiling"], 100.0);
    assert_eq!(clipped.json()["left_out"], 0);
    assert_eq!(chart(points.clone()).json()["left_out"], 1);
    // Where nothing is above, a ceiling changes nothing in the picture.
    let low = points[..2].to_vec();
    assert_eq!(chart(low.clone()).ceiling(100.0).unwrap().svg(), chart(low).svg());
}

#[test]
fn shapes_are_clipped_to_the_window() {
    let window = [(0.0, 1.0), (0.0, 1.0)];
    let line = Line { from: (0.0, 0.0), to: (2.0, 2.0), jumps: true };
    let seen = line.clipped([(0.0, 1.0), (0.5, 3.0)]).unwrap();
    assert_eq!((seen.from, seen.to), ((0.5, 0.5), (1.0, 1.0)));
    assert_eq!(line.clipped([(3.0, 4.0), (0.0, 1.0)]), None);
    // A square that stands on its corner.
    let square = [(1.0, 0.0), (2.0, 1.0), (1.0, 2.0), (0.0, 1.0)];
    let cell = Cell::clipped(&square, 0.5, window).unwrap();
    assert_eq!((cell.value(), cell.outline().len()), (0.5, 3));
    assert_eq!(Cell::clipped(&square, 0.5, [(3.0, 4.0), (0.0, 1.0)]), None);
}

/// The signature of PNG; width and height stand in the first chunk.
#[test]
fn pixels_have_the_resolution_asked_for() {
    let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='3'><text>A</text></svg>";
    let picture = png(svg, 90).unwrap();
    assert_eq!(&picture[1..4], b"PNG");
    assert_eq!((picture[19], picture[23]), (90, 30));
    assert!(png("<p>", 90).is_err());
}

//! Charts: places and labels are right, texts are escaped and do not overlap, data survive, and
//! equal data give equal bytes. The data are made up.

use crate::snapshot::snapshot;
use proptest::prelude::*;
use std::collections::BTreeSet;
use wavestep_draw::{
    Axis, Caption, Cell, Chart, Curve, Curves, Diagram, Figure, Listing, Map, Method, Panel, Part,
    PlotError, Point, Row, Section, Series, Shape, Table, WorkPrecision, frontier, page,
};

/// The plotting area from side to side, and the room for zeros in it.
const LEFT: f64 = 88.0;
const RIGHT: f64 = 650.0;
const GUTTER: f64 = 34.0;
const WIDTH: f64 = 900.0;

// ---- Data -------------------------------------------------------------------------------------

fn caption() -> Caption {
    Caption {
        norm: "greatest error over the largest value".into(),
        sampling: "1000 points, uniform".into(),
        versions: vec![("wavestep".into(), "0.1.0".into())],
        seed: Some(7),
        command: "cargo bench --bench accuracy".into(),
        remarks: vec!["The data are made up.".into()],
    }
}

fn point(setting: &str, error: f64, bound: Option<f64>, seconds: f64) -> Point {
    Point { setting: setting.into(), error, bound, seconds, prepared: None }
}

fn methods() -> Vec<Method> {
    let method = |name: &str, points| Method { name: name.into(), points };
    vec![
        method(
            "modes",
            vec![
                point("N = 10", 1e-1, None, 1e-6),
                point("N = 100", 1e-3, None, 1e-5),
                point("N = 1000", 1e-4, None, 1e-4),
            ],
        ),
        method(
            "march",
            vec![point("rough", 1e-6, Some(1e-5), 2e-7), point("fine", 1e-12, Some(1e-10), 1e-6)],
        ),
        method("certified", vec![point("", 0.0, Some(1e-16), 5e-6)]),
    ]
}

fn work_precision() -> WorkPrecision {
    let chart = WorkPrecision::new("Accuracy against speed", methods(), caption());
    chart.expect("finite data").reference_radius(1e-15).expect("above zero")
}

/// Three columns and two rows; the lower row is 1e-12, 1e-9, refused, the upper 1e-6, 1, infinite.
fn map() -> Map {
    let cells = vec![Some(1e-12), Some(1e-9), None, Some(1e-6), Some(1.0), Some(f64::INFINITY)];
    let x = (Axis::linear("order n"), vec![10.0, 20.0, 30.0]);
    let y = (Axis::logarithmic("mass ratio"), vec![0.1, 10.0]);
    let map = Map::new("Digits lost", x, y, cells, caption()).expect("a map");
    map.level(1e-8, "8 digits lost").unwrap().level(1e-2, "useless").unwrap()
}

fn curves() -> Curves {
    let curve =
        |name: &str, points: &[(f64, f64)]| Curve { name: name.into(), points: points.into() };
    let curves = vec![
        curve("expanded form", &[(0.0, 1e-16), (20.0, 1e-8), (40.0, 1.0)]),
        curve("three-term recurrence", &[(0.0, 1e-16), (20.0, f64::NAN), (40.0, 1e-13)]),
        curve("certified", &[(0.0, 0.0), (20.0, 0.0), (40.0, 0.0)]),
    ];
    let (x, y) = (Axis::linear("time").unit("s"), Axis::logarithmic("error"));
    let chart = Curves::new("Error against time", x, y, curves, caption()).expect("finite data");
    chart.level(1e-2, "useful no longer").expect("a place on the axis")
}

fn table() -> Table {
    let row = |method: &str, error, bound, seconds, speed_up| Row {
        method: method.into(),
        setting: "N = 10".into(),
        error,
        bound,
        seconds,
        speed_up,
    };
    let rows = vec![
        row("modes", 1e-1, None, 1e-6, None),
        row("certified", 0.0, Some(1e-16), 5e-7, Some(2.0)),
    ];
    Table { compared_with: "modes <N = 10>".into(), rows }
}

fn whole_page() -> String {
    let (work, map, curves) = (work_precision(), map(), curves());
    let section =
        |heading, explanation, chart| Section { heading, explanation, chart, listing: None };
    let sections = [
        section("Methods", "Left is more accurate, down is faster.", &work as &dyn Chart),
        section("Map", "Digits are lost from left to right.", &map),
        section("Curves", "The same along one line.", &curves),
    ];
    page("Accuracy & speed", &sections, &table())
}

fn charts() -> Vec<Box<dyn Chart>> {
    vec![Box::new(work_precision()), Box::new(map()), Box::new(curves())]
}

// ---- Markup -----------------------------------------------------------------------------------

/// An element of the markup: its name, its attributes, and the text right behind its opening.
struct Element<'a> {
    name: &'a str,
    attributes: &'a str,
    text: &'a str,
}

impl Element<'_> {
    fn attribute(&self, name: &str) -> Option<&str> {
        let from = self.attributes.find(&format!(" {name}=\""))? + name.len() + 3;
        self.attributes[from..].split('"').next()
    }

    fn number(&self, name: &str) -> f64 {
        self.attribute(name).expect(name).parse().expect("a number")
    }

    fn class(&self) -> &str {
        self.attribute("class").unwrap_or("")
    }
}

/// The elements of well-formed markup; panics where tags do not match, or where a character stands
/// unescaped.
fn elements(markup: &str) -> Vec<Element<'_>> {
    const EMPTY: [&str; 1] = ["meta"];
    let mut open = Vec::new();
    let mut found = Vec::new();
    for part in markup.trim_start_matches("<!DOCTYPE html>").split('<').skip(1) {
        let (tag, text) = part.split_once('>').expect("a tag is closed");
        assert!(!text.contains('>') || open.last() == Some(&"style"), "{text}");
        for entity in text.split('&').skip(1) {
            let name = entity.split(';').next().expect("a name");
            assert!(["amp", "lt", "gt", "quot", "#39"].contains(&name), "{entity}");
        }
        assert!(text.chars().all(|c| !c.is_control() || c == '\n'), "{text:?}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{tag}");
            continue;
        }
        let end = tag.find([' ', '/']).unwrap_or(tag.len());
        let (name, attributes) = tag.split_at(end);
        assert_eq!(attributes.matches('"').count() % 2, 0, "{tag}");
        if !attributes.ends_with('/') && !EMPTY.contains(&name) {
            open.push(name);
        }
        found.push(Element { name, attributes, text });
    }
    assert_eq!(open, [""; 0]);
    found
}

/// Texts that read across, with their corners: left, top, right, bottom.
fn texts(svg: &str) -> Vec<(String, [f64; 4])> {
    let texts =
        elements(svg).into_iter().filter(|e| e.name == "text" && e.attribute("x").is_some());
    let corners = |element: &Element<'_>| {
        let size = match element.class() {
            "title" => 17.0,
            "small" | "label" => 11.0,
            _ => 12.0,
        };
        let text = element.text.replace("&quot;", "\"").replace("&amp;", "&");
        // About the widths of DejaVu Sans, wide among sans serifs.
        let em = |c: char| if " ijlftr.,:;'()-".contains(c) { 0.34 } else { 0.6 };
        let wide = size * text.chars().map(em).sum::<f64>();
        let x = element.number("x");
        let left = match element.attribute("text-anchor") {
            Some("middle") => x - wide / 2.0,
            Some("end") => x - wide,
            _ => x,
        };
        let base = element.number("y");
        [left, base - 0.75 * size, left + wide, base + 0.2 * size]
    };
    texts.map(|element| (element.text.to_owned(), corners(&element))).collect()
}

/// The small print in one line.
fn small_print(svg: &str) -> String {
    let elements = elements(svg);
    let lines = elements.iter().filter(|e| e.name == "text" && e.class() == "small");
    lines.map(|element| element.text).collect::<Vec<_>>().join(" ")
}

/// The labels of the ticks below the plotting area, in the order drawn.
fn labels_below(svg: &str) -> Vec<String> {
    let texts: Vec<_> =
        elements(svg).into_iter().filter(|element| element.name == "text").collect();
    let lowest = texts.iter().filter(|element| element.attribute("text-anchor") == Some("middle"));
    let lowest = lowest.filter_map(|element| element.attribute("y"));
    let rows: BTreeSet<&str> = lowest.collect();
    // Of the two rows of centred texts, the upper has the labels of ticks, the lower the name.
    let row = rows.iter().min_by(|a, b| a.parse::<f64>().unwrap().total_cmp(&b.parse().unwrap()));
    let row = *row.expect("an axis");
    let on_row = texts.iter().filter(|element| element.attribute("y") == Some(row));
    on_row.map(|element| element.text.to_owned()).collect()
}

/// The corners of a path of straight lines.
fn corners(path: &str) -> Vec<(f64, f64)> {
    let pairs = path.trim_start_matches('M').split('L');
    let number = |text: &str| text.parse::<f64>().expect("a number");
    pairs
        .map(|pair| pair.split_once(' ').map(|(x, y)| (number(x), number(y))).expect("two"))
        .collect()
}

fn paths<'a>(elements: &'a [Element<'_>], class: &str) -> Vec<&'a str> {
    let of_class = elements.iter().filter(|e| e.name == "path" && e.class() == class);
    of_class.map(|element| element.attribute("d").expect("an outline")).collect()
}

// ---- How they look ----------------------------------------------------------------------------

/// The data of pictures, and the page without its pictures: nobody reviews paths.
#[test]
fn data_and_page_are_as_recorded() {
    for (name, chart) in ["work-precision", "map", "curves"].iter().zip(charts()) {
        snapshot(
            "plot",
            name,
            "made-up data",
            &serde_json::to_string_pretty(&chart.json()).unwrap(),
        );
    }
    let page = whole_page();
    let mut parts = page.split("<svg");
    let first = parts.next().unwrap().to_owned();
    let after = |part: &str| part.split_once("</svg>").unwrap().1.to_owned();
    snapshot(
        "plot",
        "page",
        "made-up data",
        &parts.fold(first, |page, part| page + "(picture)" + &after(part)),
    );
}

#[test]
fn equal_data_give_equal_bytes() {
    for (chart, again) in charts().iter().zip(charts()) {
        assert_eq!(chart.svg(), again.svg());
        assert_eq!(chart.json().to_string(), again.json().to_string());
        assert_eq!(chart.csv(), again.csv());
    }
    assert_eq!(whole_page(), whole_page());
}

#[test]
fn pictures_are_well_formed_and_say_what_they_are() {
    for chart in charts() {
        let svg = chart.svg();
        let elements = elements(&svg);
        assert_eq!(elements[0].name, "svg");
        assert_eq!(elements[0].attribute("viewBox").unwrap().split(' ').nth(2), Some("900"));
        let text = |name| elements.iter().find(|element| element.name == name).unwrap().text;
        assert_eq!(text("title"), chart.title());
        assert!(text("desc").len() > 40);
        let coordinates = elements.iter().flat_map(|element| element.attribute("d"));
        assert!(!coordinates.into_iter().any(|path| path.contains("NaN") || path.contains("inf")));
        for sentence in caption().sentences() {
            assert!(small_print(&svg).contains(&sentence), "{sentence}");
        }
        for size in svg.split("font-size:").skip(1) {
            let size: f64 = size.split("px").next().unwrap().parse().unwrap();
            assert!(size >= 11.0);
        }
        assert!(!svg.contains("http") || svg.matches("http").count() == 1);
    }
}

#[test]
fn texts_do_not_overlap_and_stay_inside() {
    let mut compared = 0;
    for chart in charts().iter().chain(&pictures()).chain(&[crowded(), far_from_zero()]) {
        let svg = chart.svg();
        let height = elements(&svg)[0].number("height");
        let texts = texts(&svg);
        for (i, (text, a)) in texts.iter().enumerate() {
            assert!(a[0] >= 0.0 && a[1] >= 0.0 && a[2] <= WIDTH && a[3] <= height, "{text}: {a:?}");
            for (other, b) in &texts[..i] {
                compared += 1;
                let apart = a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1];
                assert!(apart, "\"{text}\" {a:?} lies over \"{other}\" {b:?}");
            }
        }
        for method in ["modes", "march", "certified", "expanded form", "useless"] {
            if let Some((_, corners)) = texts.iter().find(|(text, _)| text == method) {
                assert!(corners[0] > RIGHT, "{method} stands in the plotting area");
            }
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// A figure of two panels with many levels, and a diagram with many names below.
fn pictures() -> Vec<Box<dyn Chart>> {
    let line = |name: &str| Series::new(name, (0..50).map(|i| (f64::from(i), 1.0)).collect());
    let panel = |name: &str| {
        let levels = (1..9).map(|i| (1.0 + 0.1 * f64::from(i), "limit".to_owned())).collect();
        Panel { levels, ..Panel::new(Axis::linear(name), vec![line("one"), line("two")]) }
    };
    let panels = vec![panel("velocity"), panel("force")];
    let figure = Figure::new("Figure", Axis::linear("time"), panels, caption()).unwrap();
    let figure = figure.mark(10.0, "first").unwrap().mark(11.0, "second").unwrap();
    let window = [(0.0, 12.0), (0.0, 1.0)];
    let corners = [(0.0, 0.0), (12.0, 0.0), (12.0, 1.0)];
    let cells = vec![Cell::clipped(&corners, -3.0, window).unwrap()];
    let axes = ["place", "time", "strain"].map(Axis::linear);
    let part = |i: i32| {
        let (name, at) = (format!("element {i}"), f64::from(i));
        let shape = if i % 2 == 0 { Shape::Lump } else { Shape::Bar(1.0) };
        Part { name, from: at, to: at + f64::from(i % 2), shape }
    };
    let diagram = Diagram::new("Diagram", axes, window, cells, caption()).unwrap();
    let diagram = diagram.parts((0..12).map(part).collect()).level(0.5, "half").unwrap();
    vec![Box::new(figure), Box::new(diagram)]
}

/// Sixty labelled points within two decades.
fn crowded() -> Box<dyn Chart> {
    let settings = |method: usize| {
        (0..10).map(move |i| {
            let (i, method) = (i as f64, method as f64);
            let error = 10f64.powf(-4.0 + 0.05 * i + 0.03 * method);
            point(&format!("N = {i}"), error, None, 10f64.powf(-6.0 - 0.03 * i + 0.05 * method))
        })
    };
    let method = |i: usize| Method { name: format!("method {i}"), points: settings(i).collect() };
    let methods = (0..6).map(method).collect();
    Box::new(WorkPrecision::new("Crowded", methods, caption()).unwrap())
}

/// Places that differ in the ninth figure: the labels of the axis are long.
fn far_from_zero() -> Box<dyn Chart> {
    let points = vec![(1e9 + 10.0, 0.1), (1e9 + 17.0, 0.2)];
    let curve = Curve { name: "one".into(), points };
    let (x, y) = (Axis::linear("time"), Axis::linear("value"));
    Box::new(Curves::new("Far from zero", x, y, vec![curve], caption()).unwrap())
}

#[test]
fn labels_without_room_are_counted() {
    let svg = crowded().svg();
    let shown = elements(&svg).iter().filter(|element| element.class() == "label").count();
    let missing = 60 - shown;
    assert!(missing > 1 && shown >= 10, "{shown} shown");
    assert!(small_print(&svg).contains(&format!("{missing} settings are not labelled")));
    assert!(work_precision().svg().matches("class=\"label\"").count() == 5);
}

#[test]
fn captions_say_everything_in_order() {
    assert_eq!(
        caption().sentences(),
        [
            "Norm: greatest error over the largest value.",
            "Sampling: 1000 points, uniform.",
            "Versions: wavestep 0.1.0.",
            "Seed: 7.",
            "The data are made up.",
            "Drawn again by: cargo bench --bench accuracy",
        ]
    );
    assert_eq!(Caption::default().sentences(), [""; 0]);
}

// ---- Places -----------------------------------------------------------------------------------

#[test]
fn axes_are_labelled_in_powers_of_ten() {
    assert_eq!(
        labels_below(&work_precision().svg()),
        ["10⁻¹⁶", "10⁻¹⁴", "10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "0"]
    );
    assert_eq!(labels_below(&map().svg()), ["5", "10", "15", "20", "25", "30", "35"]);
    assert_eq!(labels_below(&curves().svg()), ["0", "5", "10", "15", "20", "25", "30", "35", "40"]);
}

/// The place across of the marker with this text.
fn marker(elements: &[Element<'_>], about: &str) -> (f64, f64) {
    let at = elements.iter().position(|e| e.name == "title" && e.text.starts_with(about));
    let place = elements[at.expect(about) - 1].attribute("transform").expect("a place");
    let place = place.trim_start_matches("translate(").trim_end_matches(')');
    place.split_once(' ').map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap())).unwrap()
}

#[test]
fn places_are_logarithmic() {
    let svg = work_precision().svg();
    let elements = elements(&svg);
    let [ten, hundred, thousand] =
        ["modes (N = 10)", "modes (N = 100)", "modes (N = 1000)"].map(|m| marker(&elements, m));
    // Errors 1e-1, 1e-3, 1e-4; seconds 1e-6, 1e-5, 1e-4.
    assert!((ten.0 - hundred.0 - 2.0 * (hundred.0 - thousand.0)).abs() < 0.03);
    assert!((ten.1 - hundred.1 - (hundred.1 - thousand.1)).abs() < 0.03);
    assert!(ten.0 > hundred.0 && ten.1 > hundred.1);
    // An error of exactly zero stands in the gutter, with an arrow.
    assert_eq!(marker(&elements, "certified").0, LEFT + GUTTER / 2.0);
    assert_eq!(paths(&elements, "arrow c2").len(), 1);
    // The bound of "rough" ends where an error of 1e-5 stands: one decade further right.
    let rough = marker(&elements, "march (rough)");
    let decade = hundred.0 - thousand.0;
    let bound = corners(paths(&elements, "bound c1")[0]);
    assert_eq!(bound[0], rough);
    assert!((bound[1].0 - rough.0 - decade).abs() < 0.03);
    assert_eq!(bound[1].1, rough.1);
}

#[test]
fn the_region_below_the_reference_ends_at_its_radius() {
    let svg = work_precision().svg();
    let elements = elements(&svg);
    let region = elements.iter().find(|e| e.name == "rect" && e.class() == "region").unwrap();
    let (fine, rough) = (marker(&elements, "march (fine)").0, marker(&elements, "march (rough)").0);
    // 1e-15 lies half as far left of 1e-12 as 1e-6 lies right of it.
    let radius = fine - (rough - fine) / 2.0;
    assert!((region.number("x") + region.number("width") - radius).abs() < 0.03);
    assert_eq!(region.number("x"), LEFT);
    assert!(svg.contains("radius is 10⁻¹⁵"));

    let far = WorkPrecision::new("Far", methods(), caption()).unwrap().reference_radius(1e-60);
    let svg = far.unwrap().svg();
    let legend: Vec<String> = texts(&svg).into_iter().map(|(text, _)| text).collect();
    assert!(legend.join(" ").contains("radius, 10⁻⁶⁰, lies left of the picture"));
    assert!(!svg.contains("class=\"region\""));
}

#[test]
fn the_frontier_is_drawn_as_descending_steps() {
    let chart = work_precision();
    let json = chart.json();
    let names: Vec<_> =
        json["frontier"].as_array().unwrap().iter().map(|at| at["setting"].clone()).collect();
    assert_eq!(names, ["", "fine", "rough"]);
    let svg = chart.svg();
    let elements = elements(&svg);
    let steps = corners(paths(&elements, "frontier")[0]);
    for name in ["certified", "march (fine)", "march (rough)"] {
        assert!(steps.contains(&marker(&elements, name)), "{name}");
    }
    assert_eq!(steps.len(), 7);
    assert_eq!(steps[6].0, RIGHT);
    for pair in steps.windows(2) {
        let (across, down) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        assert!(across >= 0.0 && down >= 0.0 && (across == 0.0 || down == 0.0));
    }
}

proptest! {
    /// The frontier against its definition, on a coarse grid so that points coincide and tie.
    #[test]
    fn the_frontier_is_what_no_point_beats(
        points in prop::collection::vec((0u8..6, 0u8..6, 0u8..20), 0..12)
    ) {
        let value = |(error, seconds, odd): (u8, u8, u8)| match odd {
            0 => (f64::NAN, f64::from(seconds)),
            1 => (f64::from(error), f64::INFINITY),
            _ => (f64::from(error), f64::from(seconds)),
        };
        let points: Vec<(f64, f64)> = points.into_iter().map(value).collect();
        let finite = |p: (f64, f64)| p.0.is_finite() && p.1.is_finite();
        let beats = |a: (f64, f64), b: (f64, f64)| a.0 <= b.0 && a.1 <= b.1 && a != b;
        let kept = |i: &usize| {
            finite(points[*i])
                && !points.iter().any(|other| finite(*other) && beats(*other, points[*i]))
                && !points[..*i].contains(&points[*i])
        };
        let mut expected: Vec<usize> = (0..points.len()).filter(kept).collect();
        expected.sort_by(|&i, &j| points[i].0.total_cmp(&points[j].0));
        prop_assert_eq!(frontier(&points), expected);
    }
}

#[test]
fn cells_of_a_map_lie_between_their_edges() {
    let svg = map().svg();
    let elements = elements(&svg);
    let hundredths = |value: f64| (value * 100.0).round() / 100.0;
    let wide = (RIGHT - LEFT) / 3.0;
    // The first cell, 1e-12, is the darkest: between the left edge and a third, in the lower half.
    let edge = |column: f64| hundredths(LEFT + column * wide);
    let fill = |colour: &str| {
        let cell = elements.iter().find(|e| e.attribute("fill") == Some(colour)).expect(colour);
        cell.attribute("d").unwrap()
    };
    let dark = fill("#440154");
    let bottom: f64 = dark[1..].split(['H', ' ']).nth(1).unwrap().parse().unwrap();
    let (middle, top) = (hundredths(bottom - 210.0), hundredths(bottom - 420.0));
    assert_eq!(dark, format!("M88 {bottom}H{}V{middle}H88z", edge(1.0)));
    assert_eq!(fill("#FDE725"), {
        format!("M{} {middle}H{}V{}H{}z", edge(1.0), edge(2.0), top, edge(1.0))
    });
    assert_eq!(
        fill("url(#chart-refused)"),
        format!("M{} {bottom}H650V{middle}H{}z", edge(2.0), edge(2.0))
    );
    assert!(svg.contains("no value: refused, or") && svg.contains("(1 cell)"));
    // Levels: 1e-8 between the rows, in the two columns known; 1e-2 between the upper two columns
    // and under the second. Each stands on its casing; samples in the legend are shorter.
    let lines = |class| -> Vec<Vec<(f64, f64)>> {
        let drawn = paths(&elements, class).into_iter().map(corners);
        drawn.filter(|line| line[0].0 >= LEFT).collect()
    };
    assert_eq!(lines("level d0"), [vec![(LEFT, middle), (edge(2.0), middle)]]);
    let upper = [(edge(1.0), top), (edge(1.0), middle), (edge(2.0), middle)];
    let mut useless = lines("level d1").remove(0);
    useless.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(useless, upper);
    assert_eq!(lines("casing").len(), 2);
}

#[test]
fn colours_beyond_the_scale_are_said_to_be_beyond() {
    let svg = map().decades(-10, -2).unwrap().svg();
    assert!(svg.contains(">≤ 10⁻¹⁰<") && svg.contains(">≥ 10⁻²<"));
    assert!(!map().svg().contains('≤'));
    let zeros = vec![Some(0.0), Some(1e-3)];
    let axis = |places: &[f64]| (Axis::linear("n"), places.to_vec());
    let map = Map::new("Zeros", axis(&[1.0, 2.0]), axis(&[5.0]), zeros, caption()).unwrap();
    assert!(small_print(&map.svg()).contains("1 error is exactly zero, in the colour of 10⁻³."));
}

#[test]
fn curves_have_gaps_and_levels() {
    let svg = curves().svg();
    let elements = elements(&svg);
    // The second curve has one point on either side of its gap: no stroke, but two markers.
    let strokes = |class: &str| {
        paths(&elements, class).iter().filter(|path| corners(path)[0].0 >= LEFT).count()
    };
    assert_eq!(["line c0 d0", "line c1 d1", "line c2 d2"].map(strokes), [1, 0, 1]);
    assert!(small_print(&svg).contains("1 point is not finite and left out."));
    let level = corners(paths(&elements, "rule")[0]);
    assert_eq!((level[0].0, level[1].0), (LEFT, RIGHT));
    let (high, low) =
        (marker(&elements, "expanded form: 1 at").1, marker(&elements, "expanded form: 10⁻⁸").1);
    assert!((level[0].1 - (high + (low - high) / 4.0)).abs() < 0.02);
    // The label stands beside its line, not on it.
    let texts = texts(&svg);
    let (_, label) = texts.iter().find(|(text, _)| text == "useful no longer").expect("a label");
    assert!(label[3] < level[0].1 || label[1] > level[0].1, "{label:?}");
}

// ---- Odd data ---------------------------------------------------------------------------------

#[test]
fn any_data_are_drawn_or_refused_with_a_reason() {
    let work = |points: Vec<Point>| {
        let methods = vec![Method { name: "one".into(), points }];
        WorkPrecision::new("Odd", methods, Caption::default())
    };
    let drawn = [
        vec![point("", 1e-3, None, 1.0)],
        vec![point("", 0.0, None, 1.0)],
        vec![point("", 0.0, Some(0.0), 1.0), point("", 0.0, Some(f64::INFINITY), 1.0)],
        vec![point("a", 1e-3, Some(1e-3), 1.0); 3],
        vec![point("a", 5e-324, Some(f64::MAX), 5e-324), point("b", f64::MAX, None, f64::MAX)],
        vec![point("a", f64::NAN, None, 1.0), point("b", 1.0, Some(f64::NAN), 1.0)],
    ];
    for points in drawn {
        let svg = work(points.clone()).expect("drawn").svg();
        elements(&svg);
        assert!(!svg.contains("NaN") && !svg.contains("inf "), "{points:?}");
    }
    let refused = [
        (vec![], "at least one point"),
        (vec![point("", f64::NAN, None, 1.0)], "at least one point"),
        (vec![point("", -1.0, None, 1.0)], "less than zero"),
        (vec![point("", 1.0, Some(-1.0), 1.0)], "less than zero"),
        (vec![point("N = 1", 1.0, None, 0.0)], "the time of one (N = 1) is 0e0"),
    ];
    for (points, reason) in refused {
        let message = work(points).expect_err(reason).to_string();
        assert!(message.contains(reason), "{message}");
    }
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = work_precision().reference_radius(radius).unwrap_err();
        assert!(matches!(error, PlotError::NotPositive { .. }));
    }
}

#[test]
fn odd_curves_are_drawn_or_refused() {
    let one = |x: Axis, y: Axis, points: &[(f64, f64)]| {
        let curve = Curve { name: "one".into(), points: points.to_vec() };
        Curves::new("Odd", x, y, vec![curve], Caption::default())
    };
    let (linear, logarithmic) = (Axis::linear("x"), Axis::logarithmic("y"));
    for points in [
        vec![(1.0, 1.0)],
        vec![(1.0, 0.0)],
        vec![(2.0, 3.0); 5],
        vec![(1e300, 1e-300), (1.0, 1e300)],
    ] {
        for (x, y) in [(&linear, &linear), (&linear, &logarithmic), (&logarithmic, &logarithmic)] {
            let svg = one(x.clone(), y.clone(), &points).expect("drawn").svg();
            elements(&svg);
            assert!(!svg.contains("NaN"), "{points:?}");
        }
    }
    let refusal = |x: &Axis, points| one(x.clone(), logarithmic.clone(), points).unwrap_err();
    assert!(matches!(refusal(&linear, &[(1.0, -1.0)]), PlotError::NotPositive { .. }));
    assert!(matches!(refusal(&logarithmic, &[(0.0, 1.0)]), PlotError::NotPositive { .. }));
    assert!(matches!(refusal(&linear, &[(2e300, 1.0)]), PlotError::TooLarge { .. }));
    assert!(matches!(refusal(&linear, &[]), PlotError::Empty { .. }));
    assert!(curves().level(0.0, "").is_err() && curves().level(f64::NAN, "").is_err());
}

#[test]
fn odd_maps_are_drawn_or_refused() {
    let map = |x: &[f64], y: &[f64], cells: &[Option<f64>]| {
        let (x, y) = ((Axis::linear("x"), x.to_vec()), (Axis::logarithmic("y"), y.to_vec()));
        Map::new("Odd", x, y, cells.to_vec(), Caption::default())
    };
    for cell in [None, Some(0.0), Some(1.0), Some(f64::NAN), Some(5e-324), Some(f64::MAX)] {
        let svg = map(&[0.0], &[5e-324], &[cell]).expect("drawn").svg();
        elements(&svg);
        assert!(!svg.contains("NaN"), "{cell:?}");
    }
    let error = |x: &[f64], y: &[f64], cells: &[Option<f64>]| map(x, y, cells).unwrap_err();
    assert_eq!(error(&[1.0], &[1.0], &[]), PlotError::CellCount { expected: 1, found: 0 });
    assert!(matches!(error(&[], &[], &[]), PlotError::Empty { .. }));
    assert!(matches!(error(&[2.0, 2.0], &[1.0], &[None, None]), PlotError::NotAscending { .. }));
    assert!(matches!(error(&[f64::NAN], &[1.0], &[None]), PlotError::NotAscending { .. }));
    assert!(matches!(error(&[1.0], &[0.0], &[None]), PlotError::NotPositive { .. }));
    assert!(matches!(error(&[1.0], &[1.0], &[Some(-1.0)]), PlotError::Negative { .. }));
    let drawn = map(&[1.0], &[1.0], &[Some(1.0)]).unwrap();
    for (low, high) in [(1, 1), (2, 1), (-401, 0), (0, i32::MAX)] {
        let error = drawn.clone().decades(low, high).unwrap_err();
        assert_eq!(error, PlotError::EmptyColourScale { low, high });
    }
    assert!(drawn.level(f64::NAN, "").is_err());
}

#[test]
fn texts_are_escaped_everywhere() {
    const BAD: &str = "</svg><script>alert(\"1\")</script> & 'x' \u{1b}[0m \u{0}";
    let bad = || BAD.to_owned();
    let caption = Caption {
        norm: bad(),
        sampling: bad(),
        versions: vec![(bad(), bad())],
        seed: None,
        command: bad(),
        remarks: vec![bad()],
    };
    let method = Method { name: bad(), points: vec![point(BAD, 0.1, None, 1.0)] };
    let work = WorkPrecision::new(BAD, vec![method], caption.clone()).unwrap();
    let axis = || (Axis::linear(BAD).unit(BAD), vec![1.0, 2.0]);
    let cells = vec![Some(1e-3), None, Some(f64::NAN), Some(1.0)];
    let map = Map::new(BAD, axis(), axis(), cells, caption.clone()).unwrap();
    let map = map.level(0.1, &bad()).unwrap();
    let curve = Curve { name: bad(), points: vec![(1.0, 1.0)] };
    let curves = Curves::new(BAD, axis().0, axis().0, vec![curve], caption).unwrap();
    let curves = curves.level(1.0, BAD).unwrap();
    let charts: [&dyn Chart; 3] = [&work, &map, &curves];
    let listing = Listing { caption: bad(), heads: vec![bad()], rows: vec![vec![bad()]] };
    let section =
        |chart| Section { heading: BAD, explanation: BAD, chart, listing: Some(&listing) };
    let row = Row {
        method: bad(),
        setting: bad(),
        error: 1.0,
        bound: None,
        seconds: 1.0,
        speed_up: None,
    };
    let table = Table { compared_with: bad(), rows: vec![row] };
    let page = page(BAD, &charts.map(section), &table);
    let pictures = charts.map(|chart| chart.svg_named(BAD));
    for markup in pictures.iter().chain([&page]) {
        elements(markup);
        assert!(!markup.contains("<script") && !markup.contains('\u{1b}'));
        assert!(markup.contains("&lt;/svg&gt;&lt;script&gt;alert(&quot;1&quot;)"));
    }
}

// ---- Data out ---------------------------------------------------------------------------------

#[test]
fn json_survives_being_written_and_read() {
    for chart in charts() {
        let value = chart.json();
        let text = serde_json::to_string_pretty(&value).unwrap();
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), value);
        assert_eq!(value["title"], chart.title());
        assert_eq!(value["caption"]["versions"]["wavestep"], "0.1.0");
        assert_eq!(value["caption"]["seed"], 7);
        assert_eq!(value["caption"]["command"], caption().command.as_str());
    }
    let work = work_precision().json();
    let point = &work["methods"][1]["points"][1];
    let expected = r#"{"setting":"fine","error":1e-12,"bound":1e-10,"seconds":1e-6,"seconds_with_preparation":null}"#;
    assert_eq!(*point, serde_json::from_str::<serde_json::Value>(expected).unwrap());
    assert_eq!(work["reference_radius"], 1e-15);
    assert_eq!(map().json()["rows"].to_string(), r#"[[1e-12,1e-9,null],[1e-6,1.0,"inf"]]"#);
    assert_eq!(map().json()["y"]["scale"], "logarithmic");
    assert_eq!(curves().json()["curves"][1]["points"][1][1], "not a number");
}

#[test]
fn csv_has_every_number_exactly() {
    let csv = work_precision().csv();
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("method,setting,error,bound,seconds,seconds with preparation"));
    let points: Vec<(Method, Point)> = methods()
        .into_iter()
        .flat_map(|method| method.points.clone().into_iter().map(move |p| (method.clone(), p)))
        .collect();
    for ((method, point), line) in points.iter().zip(lines) {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields[..2], [method.name.as_str(), &point.setting]);
        assert_eq!(fields[2].parse(), Ok(point.error));
        assert_eq!(fields[3].parse().ok(), point.bound);
        assert_eq!(fields[4].parse(), Ok(point.seconds));
        assert_eq!(fields[5].parse().ok(), point.prepared);
    }
    assert_eq!(map().csv().lines().nth(3), Some("3e1,1e-1,"));
    assert_eq!(map().csv().lines().nth(6), Some("3e1,1e1,inf"));
    assert_eq!(curves().csv().lines().next(), Some("curve,time (s),error"));
    let quoted = Method { name: "a, \"b\"".into(), points: vec![point("", 0.1 + 0.2, None, 1.0)] };
    let csv = WorkPrecision::new("", vec![quoted], Caption::default()).unwrap().csv();
    assert_eq!(csv.lines().nth(1), Some("\"a, \"\"b\"\"\",,3.0000000000000004e-1,,1e0,"));
}

#[test]
fn a_page_is_complete_in_itself() {
    let page = whole_page();
    let elements = elements(&page);
    let identifiers: Vec<&str> = elements.iter().filter_map(|e| e.attribute("id")).collect();
    assert_eq!(identifiers.iter().collect::<BTreeSet<_>>().len(), identifiers.len());
    for reference in page.split("url(#").skip(1) {
        let name = reference.split(')').next().unwrap();
        assert!(identifiers.contains(&name), "{name}");
    }
    for outside in ["<script", "src=", "href=", "@import", "url(h"] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert_eq!(page.matches("http").count(), page.matches("http://www.w3.org/2000/svg").count());
    let count = |name| elements.iter().filter(|element| element.name == name).count();
    assert_eq!((count("figure"), count("h1"), count("h2"), count("table")), (3, 1, 4, 1));
    let headings = elements.iter().filter(|e| e.attribute("scope") == Some("col"));
    assert_eq!(
        headings.map(|element| element.text).collect::<Vec<_>>(),
        ["method", "setting", "error", "bound", "seconds a point", "points a second", "speed-up"]
    );
    let cells: Vec<&str> = elements.iter().filter(|e| e.name == "td").map(|e| e.text).collect();
    assert_eq!(
        cells,
        [
            "N = 10", "1.00e-1", "–", "1.00e-6", "1.00e6", "–", "N = 10", "0", "1.00e-16",
            "5.00e-7", "2.00e6", "2.00×"
        ]
    );
    assert!(page.contains("time of modes &lt;N = 10&gt; over"));
    assert!(page.contains("prefers-color-scheme:dark") && page.contains("@media print"));
}

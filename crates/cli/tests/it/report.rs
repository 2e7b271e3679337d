//! Pages about scenes: complete in themselves, well formed, readable in light and dark, and what they show
//! under a pointer is what `eval` and `field` give.

use super::{command, folder, run};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// Scenes of all kinds: on a grid, on a lattice, with units and without, with contacts that open, with a local
/// contact, with symbols, and equations alone.
const SCENES: [&[&str]; 12] = [
    &["hopkinson"],
    &["stepped-striker"],
    &["incommensurate"],
    &["hopkinson-with-release"],
    &["mass-that-bounces"],
    &["bars-of-unequal-length"],
    &["cushioned-impact"],
    &["pulse-shape"],
    &["mass-on-fixed-bar"],
    &["mass-on-fixed-bar", "--set", "mu=1"],
    &["rigid-mass", "--set", "mu=1/4"],
    &["local-contact"],
];

const FILE: &str = "a page.html";

/// The page about a scene.
fn page(folder: &Path, scene: &[&str]) -> String {
    let (code, stdout, stderr) = run(folder, &[&["report"], scene, &["-o", FILE]].concat());
    assert_eq!(code, 0, "{scene:?}: {stderr}");
    let page = fs::read_to_string(folder.join(FILE)).unwrap();
    assert_eq!(stdout, format!("{FILE}: {} bytes\n", page.len()));
    page
}

/// The scenes with their pages.
static PAGES: LazyLock<Vec<(&[&str], String)>> = LazyLock::new(|| {
    let folder = folder("report-pages");
    SCENES.into_iter().map(|scene| (scene, page(&folder, scene))).collect()
});

/// Elements of a page, each with its name and attributes; all that are opened are closed in turn.
fn elements(page: &str) -> Vec<(&str, Vec<(&str, &str)>)> {
    let (mut rest, mut open, mut all) = (page, Vec::new(), Vec::new());
    while let Some((_, after)) = rest.split_once('<') {
        let (tag, after) = after.split_once('>').expect("a tag ends");
        rest = after;
        let name = tag.trim_start_matches('/').split([' ', '/', '\n']).next().unwrap();
        if let Some(closed) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(closed));
            continue;
        }
        let quoted: Vec<&str> = tag[name.len()..].trim_end_matches('/').split('"').collect();
        assert_eq!(quoted.len() % 2, 1, "{tag}");
        let attributes = quoted.chunks_exact(2).map(|pair| (pair[0].trim(), pair[1]));
        let attributes: Vec<(&str, &str)> =
            attributes.map(|(name, value)| (name.trim_end_matches('='), value)).collect();
        let names: BTreeSet<&str> = attributes.iter().map(|(name, _)| *name).collect();
        assert_eq!(names.len(), attributes.len(), "{tag}");
        // What is in these is no markup.
        if let "script" | "style" = name {
            rest = rest.split_once(&format!("</{name}>")).expect("an end").1;
        } else if !tag.ends_with('/') && !["meta", "!DOCTYPE"].contains(&name) {
            open.push(name);
        }
        all.push((name, attributes));
    }
    assert!(open.is_empty(), "{open:?}");
    all
}

#[test]
fn pages_are_complete_and_well_formed() {
    let mut pictures = 0;
    for (scene, page) in &*PAGES {
        assert!(page.len() < 3 << 20, "{scene:?}: {} bytes", page.len());
        let all = elements(page);
        let values = |wanted: &str| -> Vec<&str> {
            let attributes = all.iter().flat_map(|(_, attributes)| attributes);
            attributes.filter(|(name, _)| *name == wanted).map(|(_, value)| *value).collect()
        };
        // Nothing is loaded: a certificate is a part of the page.
        let elsewhere = |to: &&&str| !to.starts_with("data:application/json,");
        let links = values("href");
        assert!(values("src").is_empty() && !links.iter().any(|to| elsewhere(&to)), "{scene:?}");
        assert!(!page.contains("@import") && !page.contains("fetch("), "{scene:?}");
        let name_of_svg = page.matches("http://www.w3.org/2000/svg").count();
        assert_eq!(page.matches("http").count(), name_of_svg, "{scene:?}");
        assert_eq!(page.matches("url(").count(), page.matches("url(#").count(), "{scene:?}");
        // What is referred to is there, once.
        let ids = values("id");
        let known: BTreeSet<&str> = ids.iter().copied().collect();
        assert_eq!(ids.len(), known.len(), "{scene:?}: {ids:?}");
        let labels = values("aria-labelledby");
        let labels = labels.iter().flat_map(|names| names.split(' '));
        let fills = page.split("url(#").skip(1).map(|rest| rest.split_once(')').unwrap().0);
        for name in labels.chain(fills) {
            assert!(known.contains(name), "{scene:?}: {name}");
        }
        // Pictures have names, what scrolls can be reached by the keyboard, headings have no gaps.
        let mut level = 0;
        for (name, attributes) in &all {
            let has = |name| attributes.iter().any(|(own, _)| *own == name);
            let role = attributes.iter().find(|(own, _)| *own == "role").map(|(_, role)| *role);
            if let Some("img" | "group") = role {
                assert!(has("aria-label") || has("aria-labelledby"), "{scene:?}: {attributes:?}");
            }
            if attributes.contains(&("class", "wide")) || *name == "pre" {
                assert!(has("tabindex"), "{scene:?}: {attributes:?}");
            }
            if let Some(own) = name.strip_prefix('h').and_then(|level| level.parse().ok()) {
                assert!(own <= level + 1, "{scene:?}");
                level = own;
            }
            pictures += usize::from(role == Some("img"));
        }
        assert!(!page.contains("NaN") && !page.contains("=\"-inf"), "{scene:?}");
    }
    assert!(pictures > 30, "{pictures}");
}

/// Formulas in MathML say what they say as text, and their parts are elements.
#[test]
fn formulas_are_those_of_the_text() {
    let (_, page) = &PAGES[10];
    let text = |markup: &str| -> String {
        let parts =
            markup.split('<').map(|part| part.split_once('>').map_or(part, |(_, text)| text));
        parts.collect::<String>().replace('\u{2062}', "")
    };
    let formulas: Vec<&str> =
        page.split("<math ").skip(1).map(|rest| rest.split_once("</math>").unwrap().0).collect();
    let texts: Vec<String> = formulas.iter().map(|formula| text(&format!("<{formula}"))).collect();
    for wanted in ["gn=−fn−1", "fn′+fn=fn−1′−fn−1", "f0(s)=e−s", "g1(s)=−e−s"] {
        let found = texts.iter().position(|text| text == wanted);
        let found = formulas[found.unwrap_or_else(|| panic!("{wanted}: {texts:?}"))];
        assert!(found.contains("<msub>") && found.contains("<mo>=</mo>"), "{found}");
        assert_eq!(found.contains("<msup><mrow><mi>e</mi></mrow>"), wanted.contains("e−s"));
    }
}

/// The data of a figure.
fn data(page: &str, name: &str) -> Value {
    let (_, rest) = page.split_once(&format!("id=\"{name}-data\">")).expect("data");
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

/// A column of what the command gives as CSV, in the order of its lines.
fn column(folder: &Path, arguments: &[&str], name: &str) -> Vec<f64> {
    let (code, stdout, stderr) = run(folder, &[arguments, &["--format", "csv"]].concat());
    assert_eq!(code, 0, "{arguments:?}: {stderr}");
    let mut lines = stdout.lines();
    let at = lines
        .next()
        .unwrap()
        .split(',')
        .position(|head| head.split(" [").next() == Some(name))
        .unwrap();
    lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
}

#[test]
fn values_under_a_pointer_are_those_of_eval_and_field() {
    let folder = folder("report-values");
    let mut compared = [0, 0];
    for (scene, page) in &*PAGES {
        if !page.contains("-data\">") {
            continue;
        }
        let samples = data(page, "observables");
        let times = samples["times"].as_array().unwrap();
        let timed = |i: usize| {
            format!("{} {}", times[i].as_str().unwrap(), samples["unit"].as_str().unwrap())
        };
        let chosen = [0, 1, times.len() / 3, times.len() / 2, times.len() - 1];
        for quantity in samples["quantities"].as_array().unwrap() {
            let name = quantity["name"].as_str().unwrap();
            // As the page has them: reading JSON here would round them.
            let text = page.split_once(&format!("\"name\":\"{name}\"")).unwrap().1;
            let text = text.split_once("\"values\":[").unwrap().1.split_once(']').unwrap().0;
            let shown: Vec<&str> = text.split(',').collect();
            let asked: Vec<String> = chosen.iter().map(|i| timed(*i)).collect();
            let mut arguments = vec!["eval"];
            arguments.extend(*scene);
            arguments.extend(["--quantity", name, "--digits", "25"]);
            arguments.extend(asked.iter().flat_map(|time| ["--at", time.trim()]));
            let evaluated = column(&folder, &arguments, "value");
            assert_eq!(evaluated.len(), chosen.len());
            for (i, value) in chosen.iter().zip(evaluated) {
                let shown: f64 = shown[*i].parse().unwrap();
                assert_eq!(shown, value, "{scene:?}: {name} at {}", timed(*i));
                compared[0] += usize::from(shown != 0.0);
            }
        }
        if !page.contains("id=\"field-velocity-data\"") {
            continue;
        }
        let fields = ["velocity", "force"].map(|name| data(page, &format!("field-{name}")));
        let last = fields[0]["times"].as_array().unwrap().len() - 1;
        for i in [last / 2, last] {
            let [time, unit] = ["times", "unit"].map(|key| &fields[0][key]);
            let time = format!("{} {}", time[i].as_str().unwrap(), unit.as_str().unwrap());
            let arguments = [&["field"], *scene, &["--mesh", "24", "--time", time.trim()]].concat();
            let places = column(&folder, &arguments, "x");
            for field in &fields {
                let quantity = field["quantity"].as_str().unwrap();
                let values = column(&folder, &arguments, quantity);
                let nodes = field["rows"][i].as_array().unwrap();
                assert_eq!(nodes.len(), values.len(), "{scene:?}");
                for (node, (place, value)) in nodes.iter().zip(places.iter().zip(values)) {
                    // Reading JSON may round the last digit.
                    for (shown, value) in [(&node[1], *place), (&node[3], value)] {
                        let off = (shown.as_f64().unwrap() - value).abs();
                        let about = format!("{scene:?}: {quantity} at {time}: {shown}, {value}");
                        assert!(off <= 2.0 * f64::EPSILON * value.abs(), "{about}");
                    }
                    compared[1] += 1;
                }
            }
        }
    }
    assert!(compared[0] > 100 && compared[1] > 1000, "{compared:?}");
}

/// The relative luminance of a colour, as the Web Content Accessibility Guidelines define it.
fn luminance(colour: &str) -> f64 {
    let digits = colour.strip_prefix('#').expect("a colour");
    let part = |i: usize| {
        let text = match digits.len() {
            3 => digits[i..=i].repeat(2),
            _ => digits[2 * i..2 * i + 2].to_owned(),
        };
        let share = f64::from(u8::from_str_radix(&text, 16).unwrap()) / 255.0;
        if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2)
}

fn contrast(one: &str, other: &str) -> f64 {
    let [one, other] = [one, other].map(luminance);
    (one.max(other) + 0.05) / (one.min(other) + 0.05)
}

/// Texts have a contrast of 4.5 at least, lines that carry meaning one of 3, in both themes.
#[test]
fn contrast_is_enough_in_light_and_dark() {
    assert!((contrast("#000", "#ffffff") - 21.0).abs() < 1e-9);
    let page = page(&folder("report-contrast"), &["hopkinson"]);
    let rules: Vec<&str> = page.split(":root{").skip(1).collect();
    let [light, dark] = rules[..] else { panic!("two themes") };
    for theme in [light, dark] {
        let theme = theme.split_once('}').unwrap().0;
        let colour = |name: &str| {
            theme.split(';').find_map(|rule| rule.strip_prefix(&format!("--{name}:"))).unwrap()
        };
        for text in ["ink", "soft"] {
            for paper in ["paper", "field"] {
                let found = contrast(colour(text), colour(paper));
                assert!(found >= 4.5, "{text} on {paper}: {found}");
            }
        }
        for paper in ["paper", "field"] {
            assert!(contrast(colour("accent"), colour(paper)) >= 3.0);
        }
        assert!(contrast(colour("ink"), colour("bar")) >= 3.0);
    }
    // The texts of figures, light and then dark.
    let figure = page.split_once(".plot text{").unwrap().1.split_once("</style>").unwrap().0;
    let (light, dark) = figure.split_once("prefers-color-scheme:dark){").unwrap();
    for (theme, before) in [(light, ""), (dark, ".plot text{fill:")] {
        let colour = |class: &str| {
            let rule = theme.split_once(class).unwrap().1.split_once("fill:").unwrap().1;
            rule.split([';', '}']).next().unwrap()
        };
        for text in [before, ".plot .small{"] {
            assert!(contrast(colour(text), colour(".plot .paper{")) >= 4.5, "{theme}");
        }
    }
}

/// The command at the end of a page makes the same bytes again; blanks are quoted.
#[test]
fn the_command_makes_the_page_again() {
    let folder = folder("report-again");
    for scene in [
        &["rigid-mass", "--set", "mu=1/4"][..],
        &["stepped-striker"],
        &["mass-that-bounces", "--to", "5/2"],
    ] {
        let first = page(&folder, scene);
        let (_, rest) = first.split_once("<footer>").unwrap();
        let line =
            rest.split_once("<pre tabindex=\"0\">").unwrap().1.split_once("</pre>").unwrap().0;
        let line = line.replace("&#39;", "'");
        assert!(line.ends_with(&format!("-o '{FILE}'")), "{line}");
        // Each second part stands between quotes.
        let parts = line.split('\'').enumerate();
        let words: Vec<&str> = parts
            .flat_map(
                |(i, part)| if i % 2 == 0 { part.split_whitespace().collect() } else { vec![part] },
            )
            .collect();
        fs::remove_file(folder.join(FILE)).unwrap();
        assert_eq!(words[0], "wavestep");
        assert!(command(&folder, &words[1..]).output().unwrap().status.success());
        assert_eq!(fs::read_to_string(folder.join(FILE)).unwrap(), first);
        // Standard output carries the page alone.
        let (_, stdout, _) = run(&folder, &[&["report"], scene, &["-o", "-"]].concat());
        assert_eq!(stdout, first.replace(&format!("&#39;{FILE}&#39;"), "-"));
    }
}

/// Plots, events and extrema end where it is asked.
#[test]
fn the_last_time_is_that_asked_for() {
    let folder = folder("report-until");
    let [all, part] = [&[][..], &["--to", "5/2"]]
        .map(|to| page(&folder, &[&["mass-that-bounces"][..], to].concat()));
    let section = |page: &str, id: &str| {
        let (_, rest) = page.split_once(&format!("<section aria-labelledby=\"{id}\">")).unwrap();
        rest.split_once("</section>").unwrap().0.to_owned()
    };
    let events = [&all, &part].map(|page| section(page, "events").matches("<li>t = ").count());
    assert!(events[0] > events[1] && events[1] > 0, "{events:?}");
    assert!(section(&part, "energies").contains("at t = 5/2<"), "{}", section(&part, "energies"));
    assert!(part.contains("later events are not known"), "{}", section(&part, "events"));
}

/// What has no meaning is left out with its reason.
#[test]
fn what_cannot_be_shown_is_named() {
    let folder = folder("report-left-out");
    let page = |scene: &[&str]| page(&folder, scene);
    let symbols = page(&["rigid-mass"]);
    assert!(symbols.contains("Omitted: the picture of the line, since equations have no bars"));
    assert!(
        symbols.contains("Omitted: the symbol mu has no value.") && !symbols.contains("-data\">")
    );
    assert!(symbols.contains("<math"));
    let (_, local) = PAGES.iter().find(|(scene, _)| **scene == ["local-contact"]).unwrap();
    assert!(local.contains("is a power of its compression, so this scene"));
    assert!(local.contains("-data\">") && local.contains("<h3>The first contact</h3>"));
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    let bar = "bar a { impedance = 1, travel = 1, velocity = 1 }\nline free - a - fixed\n";
    write("unseen.wave", &format!("scene \"Unseen\"\n{bar}"));
    let unseen = page(&["unseen.wave"]);
    assert!(unseen.contains("Omitted: this scene has no observables."));
    assert!(unseen.contains("field-force-data"));
    let spring = "mass m { mass = 1, velocity = 1 }\nspring s { stiffness = 1 }\nline free - m - s - fixed\n";
    write("barless.wave", &format!("scene \"No bars\"\n{spring}observe v = velocity(m)\n"));
    let barless = page(&["barless.wave"]);
    assert!(barless.contains("Omitted: the scene has no bar to draw."));
    assert!(barless.contains("observables-data"));
}

/// A page that cannot be made or written leaves no file.
#[test]
fn errors_leave_no_file() {
    let folder = folder("report-errors");
    fs::write(folder.join("wrong.wave"), "scene \"Wrong\"\nbar a { impedance = 1 \n").unwrap();
    fs::write(
        folder.join("rest.wave"),
        "scene \"At rest\"\nmass m { mass = 1 }\nline free - m - free\n",
    )
    .unwrap();
    for (arguments, message) in [
        (&["report", "rigid-mass", "-o", "nowhere/page.html"][..], "cannot be written"),
        (&["report", "rigid-mass", "-o", "."], "does not end in .html"),
        (&["report", "wrong.wave", "-o", "page.html"], "wrong.wave"),
        (&["report", "rest.wave", "-o", "page.html"], "rest.wave"),
        (&["report", "rigid-mass", "--to", "0", "-o", "page.html"], "a time after 0"),
        (&["report", "rigid-mass", "--to", "-1", "-o", "page.html"], "before the start"),
        (&["report", "rigid-mass"], "--output"),
    ] {
        let (code, stdout, stderr) = run(&folder, arguments);
        assert!(code != 0 && stdout.is_empty(), "{arguments:?}");
        assert!(stderr.contains(message), "{stderr}");
        assert_eq!(stderr.matches("error: ").count(), 1, "{stderr}");
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
}

/// However many elements there are, each keeps its place, the bars have room, and the page stays small.
#[test]
fn long_lines_are_drawn_to_scale() {
    let folder = folder("report-line");
    let mut scene = "scene \"A long line\"\n".to_owned();
    let mut line = "line free".to_owned();
    for i in 0..30 {
        scene += &format!(
            "mass m{i} {{ mass = 1, velocity = 1 }}\nbar b{i} {{ impedance = 1, travel = {} }}\n",
            1 + i % 2
        );
        line += &format!(" - m{i} - b{i}");
    }
    fs::write(folder.join("long.wave"), format!("{scene}{line} - fixed\n")).unwrap();
    let page = page(&folder, &["long.wave"]);
    assert!(page.len() < 3 << 20, "{} bytes", page.len());
    assert!(page.contains("Omitted: the figure field-velocity, which has"));
    let svg = page.split_once("class=\"line-of-scene\"").unwrap().1.split_once("</svg>").unwrap().0;
    let svg = format!("<svg{svg}</svg>");
    let widths: Vec<f64> = elements(&svg)
        .iter()
        .filter(|(name, attributes)| *name == "rect" && attributes.contains(&("class", "bar")))
        .map(|(_, attributes)| attributes.iter().find(|(name, _)| *name == "width").unwrap().1)
        .map(|width| width.parse().unwrap())
        .collect();
    assert_eq!(widths.len(), 30);
    assert!(widths.iter().all(|width| *width > 1.0), "{widths:?}");
    for pair in widths.chunks(2) {
        assert!((pair[1] / pair[0] - 2.0).abs() < 0.01, "{pair:?}");
    }
}

/// A value that is kept for a while is told as one interval, ends with their values.
#[test]
fn intervals_of_extrema_are_joined() {
    let folder = folder("report-extrema");
    let page = page(&folder, &["hopkinson"]);
    let rows: Vec<&str> = page.split("<tr>").filter(|row| row.contains("smallest")).collect();
    let force = rows.iter().find(|row| row.contains(">force<")).unwrap();
    assert!(
        force.contains("<td>0 N</td><td>for 0 s ≤ t ≤ 0.0002900123150 s (constant)</td>"),
        "{force}"
    );
    assert!(page.contains("Proven for the whole window 0 s ≤ t ≤ 0.0011 s"));
}

//! Trees of whole texts as text again, which is read back to the same tree.

use std::fmt::{Display, Write as _};
use wavestep::language::syntax::{
    Condition, Declaration, Line, Listing, Node, ObservedTerm, Operator, Property, Recurrence,
    Rewriting, Scene, SceneStatementKind, Section, Sign, Spanned, StatementKind, Symbol, Text,
    Unit,
};
use wavestep::scene::Joint;

pub fn recurrence(tree: &Recurrence) -> String {
    text("recurrence", tree, statement)
}

pub fn scene(tree: &Scene) -> String {
    text("scene", tree, statement_of_scene)
}

pub fn listing(tree: &Listing) -> String {
    let line = |formula: &Spanned<_>| {
        let wavestep::language::syntax::Formula { wave, counts, argument, value } = &formula.value;
        let counts = listed(counts, ToString::to_string);
        format!("{wave}[{counts}]({argument}) = {value}\n")
    };
    tree.formulas.iter().map(line).collect()
}

fn text<K>(whole: &str, tree: &Text<K>, print: impl Fn(&K) -> String) -> String {
    let statements = tree.statements.iter().map(|statement| print(&statement.value) + "\n");
    format!("{whole} \"{}\"\n", tree.title) + &statements.collect::<String>()
}

/// Things with commas between them.
fn listed<T>(items: &[T], print: impl Fn(&T) -> String) -> String {
    items.iter().map(print).collect::<Vec<_>>().join(", ")
}

fn symbols(symbols: &[Symbol]) -> String {
    let symbol = |Symbol { name, condition }: &Symbol| match condition {
        None => name.to_string(),
        Some(Condition { relation, bound }) => format!("{name} {relation} {bound}"),
    };
    format!("symbol {}", listed(symbols, symbol))
}

fn statement(kind: &StatementKind) -> String {
    match kind {
        StatementKind::Symbols(all) => symbols(all),
        StatementKind::Nonzero(expression) => format!("nonzero {expression}"),
        StatementKind::Period { length, local, time } => {
            format!("period {length}, local {local}, time {time}")
        }
        StatementKind::Waves(names) => format!("wave {}", listed(names, Spanned::to_string)),
        StatementKind::Equation { left, right } => format!("equation {left} = {right}"),
        StatementKind::Continuous { quantity, start } => {
            format!("continuous {quantity} starts at {start}")
        }
        StatementKind::Written(items) => format!("written {}", listed(items, rewriting)),
        StatementKind::Observe { name, value } => format!("observe {name} = {value}"),
    }
}

fn rewriting(item: &Rewriting) -> String {
    match item {
        Rewriting::Unit { quantity, unit } => format!("{quantity} in {unit}"),
        Rewriting::Name { name, written } => format!("{name} as {written}"),
        Rewriting::Constants { wave, name } => format!("constants of {wave} as {name}"),
        Rewriting::Ends(wave) => format!("ends of {wave}"),
    }
}

fn statement_of_scene(kind: &SceneStatementKind) -> String {
    match kind {
        SceneStatementKind::Symbols(all) => symbols(all),
        SceneStatementKind::Nonzero(expression) => format!("nonzero {expression}"),
        SceneStatementKind::Declaration(Declaration { kind, name, properties }) => {
            match properties.is_empty() {
                true => format!("{kind} {name} {{}}"),
                false => format!("{kind} {name} {{ {} }}", listed(properties, property)),
            }
        }
        SceneStatementKind::Line(own) => line(own),
        SceneStatementKind::ContactsOpen => "contacts open".to_owned(),
        SceneStatementKind::Observe { name, terms } => {
            let mut out = format!("observe {name} =");
            for (place, Spanned { value, .. }) in terms.iter().enumerate() {
                let text = term(value);
                out += match (place, value.sign) {
                    // A minus here would be the sign of the term.
                    (0, Sign::Plus) if text.starts_with('-') => " +",
                    (0, Sign::Plus) => " ",
                    (0, Sign::Minus) => " -",
                    (_, Sign::Plus) => " + ",
                    (_, Sign::Minus) => " - ",
                };
                out += &text;
            }
            out
        }
    }
}

fn property(Property { name, value, unit }: &Property) -> String {
    format!("{name} = {}", with_unit(value, unit.as_ref()))
}

fn with_unit(value: impl Display, unit: Option<&Unit>) -> String {
    let mut out = value.to_string();
    for (place, factor) in unit.into_iter().flat_map(|unit| &unit.value).enumerate() {
        out.push(match (place, factor.operator) {
            (0, _) => ' ',
            (_, Operator::Multiply) => '*',
            (_, Operator::Divide) => '/',
        });
        out += &factor.name.value;
        if factor.power != 1 {
            write!(out, "^{}", factor.power).unwrap();
        }
    }
    out
}

fn line(line: &Line) -> String {
    let [left, right] =
        [line.left, line.right].map(|end| format!("{:?}", end.value).to_lowercase());
    let mut out = format!("line {left}");
    let names = line.elements.iter().map(|name| &name.value).chain([&right]);
    for ((place, joint), name) in line.joints.iter().enumerate().zip(names) {
        let sign = if joint.value == Joint::Contact { '|' } else { '-' };
        let gap = line.gaps.iter().find(|(joint, ..)| *joint == place);
        // A width begins with a number or a parenthesis.
        let gap = gap.map(|(_, width, unit)| {
            let (value, all) = (width.value.to_string(), with_unit(width, unit.as_ref()));
            match value.starts_with(|c: char| c.is_ascii_digit()) {
                true => all + "|",
                false => format!("({value}){}|", &all[value.len()..]),
            }
        });
        write!(out, " {sign}{} {name}", gap.unwrap_or_default()).unwrap();
    }
    out
}

/// Without the sign, which depends on the place in the sum.
fn term(term: &ObservedTerm) -> String {
    let place = &term.place.value;
    let section = match &place.section {
        None => String::new(),
        Some(Section::Left) => ".left".to_owned(),
        Some(Section::Right) => ".right".to_owned(),
        Some(Section::At { position, unit }) => {
            format!(".at({})", with_unit(position, unit.as_ref()))
        }
    };
    let reading = format!("{}({}{section})", term.measure.value.word(), place.element);
    let factors = Node::Product(term.factors.clone()).to_string();
    match term.factors.first().map(|factor| factor.operator) {
        None => reading,
        Some(Operator::Multiply) => format!("{factors}*{reading}"),
        // A product that begins with a divisor, `1/a`, is written behind what it divides.
        Some(Operator::Divide) => format!("{reading}{}", &factors[1..]),
    }
}

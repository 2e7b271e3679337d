//! Symbols that are written otherwise than by their own names.

use crate::export::arrangement::{Node, Sign};
use crate::export::notation::{Latex, Notation, Text, write_flat};
use crate::recurrence::SourceProduct;
use num_traits::{One, Signed};
use std::collections::BTreeMap;
use wavestep_polynomial::{Integer, Rational, Symbol};

/// What is written for a symbol, in each notation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Name {
    /// In plain text.
    pub text: String,
    /// In LaTeX.
    pub latex: String,
    /// Whether it is an expression, which takes brackets as a base or before a factor.
    pub compound: bool,
    /// Whether it begins with a number or a sign, which takes brackets after a factor as well.
    pub leads: bool,
}

/// What is written for symbols; others keep their names.
pub(crate) type Names = BTreeMap<Symbol, Name>;

impl Name {
    /// A product in place of a symbol. In LaTeX a quotient stays on the line: `μz/L`.
    pub fn of(product: &SourceProduct) -> Name {
        let node = product_node(product);
        let minus = if product.coefficient().is_negative() { "-" } else { "" };
        let flat = |node: &Node, notation: &dyn Notation| {
            write_flat(&[(Sign::Plus, node.clone())], notation)
        };
        let latex = match &node {
            Node::Quotient(top, bottom) => {
                let single = matches!(**bottom, Node::Symbol(_) | Node::Number(_));
                let (top, bottom) = (flat(top, &Latex), flat(bottom, &Latex));
                if single { format!("{top}/{bottom}") } else { format!("{top}/({bottom})") }
            }
            node => flat(node, &Latex),
        };
        let simple = matches!(node, Node::Symbol(_)) && minus.is_empty();
        let text = flat(&node, &Text);
        Name {
            text: format!("{minus}{text}"),
            latex: format!("{minus}{latex}"),
            compound: !simple,
            leads: !minus.is_empty() || text.starts_with(|first: char| first.is_ascii_digit()),
        }
    }
}

/// A product in its own order and without its sign, as one quotient.
pub(crate) fn product_node(product: &SourceProduct) -> Node {
    let side = |number: &Integer, sign: i32| {
        let number = (!number.is_one()).then(|| Node::Number(Rational::from(number.clone())));
        let powers = product.powers().iter().filter(|(_, power)| power.signum() == sign);
        let powers =
            powers.map(|(x, power)| Node::power(Node::Symbol(x.clone()), power.unsigned_abs()));
        number.into_iter().chain(powers).collect::<Vec<Node>>()
    };
    let coefficient = product.coefficient().abs();
    let top = Node::product(side(coefficient.numer(), 1));
    match side(coefficient.denom(), -1) {
        bottom if bottom.is_empty() => top,
        bottom => Node::Quotient(Box::new(top), Box::new(Node::product(bottom))),
    }
}

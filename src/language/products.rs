//! Observables lowered to sums of products of two waves.

use super::constant::constant;
use super::linear::{Linear, Lowering, Place};
use super::scope::Scope;
use super::source::Source;
use super::syntax::{Expression as Tree, Factor, Node, Operator, Sign};
use crate::expression::Expression;
use num_traits::ToPrimitive;

type Outcome<T> = Result<T, super::diagnostic::Diagnostic>;

/// What is linear in the waves, and products of two such, each with a coefficient that is free of time.
#[derive(Default)]
pub(super) struct Products {
    pub linear: Linear,
    pub pairs: Vec<(Expression, [Linear; 2])>,
}

impl Scope {
    /// Lowers an observable.
    pub fn lower_products(&self, tree: &Tree) -> Outcome<Products> {
        let mut found = Products::default();
        let lowering = Lowering::new(self, Place::Observable);
        lowering.collect(tree, &Expression::one(), &mut found)?;
        Ok(found)
    }
}

impl Lowering<'_> {
    /// Adds a coefficient times an expression.
    fn collect(&self, tree: &Tree, coefficient: &Expression, found: &mut Products) -> Outcome<()> {
        let degree = degree(tree, &self.scope.source);
        match &tree.value {
            _ if degree < 2 => {
                let mut own = self.lower(tree)?;
                if !coefficient.is_one() {
                    own = self.scaled(own, coefficient, tree.span)?;
                }
                let Linear { rest, waves } = &mut found.linear;
                *rest = self.sum_of(vec![std::mem::take(rest), own.rest], tree.span)?;
                waves.append(&mut own.waves);
                Ok(())
            }
            Node::Sum(terms) => terms.iter().try_for_each(|term| match term.sign {
                Sign::Plus => self.collect(&term.value, coefficient, found),
                Sign::Minus => self.collect(&term.value, &-coefficient, found),
            }),
            Node::Negate(operand) => self.collect(operand, &-coefficient, found),
            _ if degree > 2 => Err(self
                .error("a product of more than two waves", tree.span, "more than two")
                .with_remedy("observe sums of products of two waves, such as `1/2*f(t)^2`")),
            Node::Product(factors) => self.collect_product(factors, coefficient.clone(), found),
            Node::Power { base, .. } if self.is_linear(base) => {
                let base = self.lower(base)?;
                found.pairs.push((coefficient.clone(), [base.clone(), base]));
                Ok(())
            }
            Node::Power { base, .. } => self.collect(base, coefficient, found),
            _ => unreachable!("sums, products and powers alone hold more than one wave"),
        }
    }

    fn is_linear(&self, tree: &Tree) -> bool {
        degree(tree, &self.scope.source) < 2
    }

    /// The same of a product with two waves.
    fn collect_product(
        &self,
        factors: &[Factor],
        mut coefficient: Expression,
        found: &mut Products,
    ) -> Outcome<()> {
        let (mut waves, mut products) = (Vec::new(), None);
        for Factor { operator, value: tree } in factors {
            let plain = match (operator, degree(tree, &self.scope.source)) {
                (Operator::Divide, _) => self.inverse(tree)?,
                (Operator::Multiply, 0) => self.plain(tree, "this factor")?,
                (Operator::Multiply, 1) => {
                    waves.push(self.lower(tree)?);
                    continue;
                }
                (Operator::Multiply, _) => {
                    products = Some(tree);
                    continue;
                }
            };
            if self.depends_on_time(&plain) {
                return Err(self
                    .error(
                        "the factor of a product of waves depends on time",
                        tree.span,
                        "depends on time",
                    )
                    .with_remedy("coefficients are numbers and symbols"));
            }
            coefficient = self.times(&coefficient, &plain, tree.span)?;
        }
        match (products, <[Linear; 2]>::try_from(waves)) {
            (Some(tree), _) => self.collect(tree, &coefficient, found),
            (None, Ok(pair)) => {
                found.pairs.push((coefficient, pair));
                Ok(())
            }
            (None, Err(_)) => unreachable!("two factors hold a wave"),
        }
    }
}

/// How many waves are multiplied with each other; what has no meaning is counted somehow.
fn degree(tree: &Tree, source: &Source) -> u32 {
    let of = |tree: &Tree| degree(tree, source);
    match &tree.value {
        Node::Wave(_) | Node::Call { .. } | Node::Summation { .. } => 1,
        Node::Number(_) | Node::Name(_) | Node::Exponential(_) | Node::Function { .. } => 0,
        Node::Sum(terms) => terms.iter().map(|term| of(&term.value)).max().unwrap_or(0),
        Node::Product(factors) => {
            let factors = factors.iter().filter(|factor| factor.operator == Operator::Multiply);
            factors.fold(0, |sum, factor| sum.saturating_add(of(&factor.value)))
        }
        Node::Negate(operand) => of(operand),
        Node::Power { base, exponent } => {
            let count = constant(exponent, source).ok().filter(|count| count.is_integer());
            // Other powers of waves are refused.
            let count = count.and_then(|count| count.to_u32()).unwrap_or(0);
            of(base).saturating_mul(count)
        }
    }
}

//! Two polynomials over one list of symbols.

use crate::symbol::Symbol;
use crate::term::Monomial;
use std::sync::Arc;

/// Where the symbols of a list stand in a longer one, or `None` where the lists are the same.
/// Spreading exponents keeps the order of terms.
pub(crate) struct Places(Option<Vec<usize>>, usize);

impl Places {
    /// Where the symbols of `list` stand in `union`, which has them all. O(symbols · log).
    pub fn new(list: &[Symbol], union: &[Symbol]) -> Places {
        let place = |symbol| union.binary_search(symbol).expect("the union has every symbol");
        let places = (list.len() < union.len()).then(|| list.iter().map(place).collect());
        Places(places, union.len())
    }

    /// `exponents` with each entry moved to its place in the longer list. O(symbols).
    pub fn spread(&self, exponents: &Monomial) -> Monomial {
        let mut spread = Monomial::from_slice(exponents);
        self.widen(&mut spread);
        spread
    }

    /// [`Places::spread`] in place; nothing to do where the lists are the same.
    pub fn widen(&self, exponents: &mut Monomial) {
        if let Some(places) = &self.0 {
            let mut wide = Monomial::from_elem(0, self.1);
            places.iter().zip(exponents.iter()).for_each(|(place, e)| wide[*place] = *e);
            *exponents = wide;
        }
    }
}

/// The union of two lists of symbols; one of them itself where it has the other's symbols. O(symbols · log);
/// O(1) where they are one allocation.
pub(crate) fn common_symbols(left: &Arc<[Symbol]>, right: &Arc<[Symbol]>) -> Arc<[Symbol]> {
    if Arc::ptr_eq(left, right) || left == right {
        return left.clone();
    }
    let mut union: Vec<Symbol> = left.iter().chain(right.iter()).cloned().collect();
    union.sort();
    union.dedup();
    match union.len() {
        length if length == left.len() => left.clone(),
        length if length == right.len() => right.clone(),
        _ => union.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn union_of_every_pair_of_lists() {
        let list = |names: &str| -> Arc<[Symbol]> {
            names.chars().map(|c| Symbol::new(&c.to_string()).unwrap()).collect()
        };
        for (left, right, union) in
            [("", "", ""), ("", "a", "a"), ("ac", "bd", "abcd"), ("abc", "bcd", "abcd")]
        {
            let (left, right) = (list(left), list(right));
            let symbols = common_symbols(&left, &right);
            assert_eq!(symbols, list(union));
            assert_eq!(common_symbols(&right, &left), symbols);
            for list in [&left, &right] {
                let places = Places::new(list, &symbols);
                let exponents: Monomial = (1..=list.len() as u32).collect();
                let wide = places.spread(&exponents);
                let kept = symbols.iter().zip(&wide).filter(|(_, e)| **e > 0);
                assert!(kept.map(|(x, e)| (x, *e)).eq(list.iter().zip(exponents)));
            }
        }
    }

    #[test]
    fn a_list_that_has_all_symbols_is_shared() {
        let long: Arc<[Symbol]> = ["a", "b"].map(|name| Symbol::new(name).unwrap()).into();
        let short: Arc<[Symbol]> = long[1..].into();
        assert!(Arc::ptr_eq(&common_symbols(&long, &short), &long));
        assert!(Arc::ptr_eq(&common_symbols(&short, &long), &long));
    }
}

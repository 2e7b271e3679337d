//! Times of the ring operations and of calculus, on polynomials in two symbols like those that a
//! recurrence in time makes: every `mu^i s^j` with `i + j ≤ degree`, numerators of 100–300 bits.
//!
//! `cargo bench --bench ring`

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol, factorial};

/// Degrees that give 990 and 89,676 terms.
const DEGREES: [u32; 2] = [43, 422];

fn symbol(name: &str) -> Symbol {
    Symbol::new(name).expect("a name")
}

fn times(factor: i64, symbol: &Symbol) -> Polynomial {
    Polynomial::monomial(&Rational::from_integer(factor.into()), &[(symbol, 1)])
}

/// A linear congruential generator: the same polynomials on every run.
struct Random(u64);

impl Random {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 >> 32
    }

    /// A non-zero integer of 100 to 300 bits.
    fn integer(&mut self) -> Integer {
        let words = 3 + self.word() % 6;
        let size = (0..words).fold(Integer::from(1), |value, _| (value << 32) + self.word());
        if self.word().is_multiple_of(2) { size } else { -size }
    }
}

/// All monomials up to a total degree with random integer numerators of the divided powers.
fn dense(degree: u32, seed: u64) -> Polynomial {
    let mut random = Random(seed);
    let (mu, s) = (symbol("mu"), symbol("s"));
    let factorials: Vec<Integer> = (0..=degree).map(factorial).collect();
    let term = |(i, j): (u32, u32)| {
        let scale = &factorials[i as usize] * &factorials[j as usize];
        let coefficient = Rational::new(random.integer(), scale);
        Polynomial::monomial(&coefficient, &[(&mu, i), (&s, j)])
    };
    let places = (0..=degree).flat_map(|i| (0..=degree - i).map(move |j| (i, j)));
    places.map(term).sum()
}

fn calculus(criterion: &mut Criterion) {
    let (mu, s) = (symbol("mu"), symbol("s"));
    let mut group = criterion.benchmark_group("calculus");
    group.sample_size(20);
    for degree in DEGREES {
        let p = dense(degree, 1);
        let terms = p.term_count();
        let twice_mu = times(2, &mu);
        let at = |name| BenchmarkId::new(name, terms);
        group.bench_function(at("substitute s -> 2*mu"), |b| {
            b.iter(|| black_box(&p).substitute(&s, &twice_mu))
        });
        group.bench_function(at("derivative in s"), |b| b.iter(|| black_box(&p).derivative(&s)));
        group.bench_function(at("antiderivative in s"), |b| {
            b.iter(|| black_box(&p).antiderivative(&s))
        });
        group.bench_function(at("evaluate"), |b| {
            let half = Rational::new(1.into(), 2.into());
            b.iter(|| black_box(&p).evaluate(|_| Some(half.clone())))
        });
        group.bench_function(at("derivative in mu"), |b| b.iter(|| black_box(&p).derivative(&mu)));
    }
    group.finish();
}

fn ring(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("ring");
    group.sample_size(20);
    for degree in DEGREES {
        let (p, q) = (dense(degree, 1), dense(degree, 2));
        let third = &q / &Rational::from_integer(3.into());
        let terms = p.term_count();
        let at = |name| BenchmarkId::new(name, terms);
        group.bench_function(at("add"), |b| b.iter(|| black_box(&p) + black_box(&q)));
        group.bench_function(at("add assign"), |b| {
            let add = |mut sum: Polynomial| {
                sum += black_box(&q);
                sum
            };
            b.iter_batched(|| p.clone(), add, BatchSize::LargeInput)
        });
        group.bench_function(at("subtract with a denominator"), |b| {
            b.iter(|| black_box(&p) - black_box(&third))
        });
        group.bench_function(at("times 2*mu - s"), |b| {
            let factor = &times(2, &symbol("mu")) - &times(1, &symbol("s"));
            b.iter(|| black_box(&p) * black_box(&factor))
        });
    }
    let (p, q) = (dense(12, 1), dense(12, 2));
    let product = &p * &q;
    group.bench_function("product of 91 by 91 terms", |b| b.iter(|| black_box(&p) * &q));
    group.bench_function("quotient of 91 terms", |b| b.iter(|| black_box(&product).divide(&q)));
    group.finish();
}

fn text(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("text");
    group.sample_size(10);
    let p = dense(DEGREES[0], 1);
    group.bench_function("print 990 terms", |b| b.iter(|| black_box(&p).to_string()));
    group.finish();
}

criterion_group!(benches, calculus, ring, text);
criterion_main!(benches);

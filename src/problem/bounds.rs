//! Work that would explode is refused before it starts.

use super::ProblemError;
use crate::limits::{MAX_DERIVED_ECHOES, MAX_DERIVED_TERMS};
use crate::network::Network;
use crate::recurrence::{Recurrence, WaveIndex};
use crate::solution::{Demand, EchoByEcho, SolveError};
use wavestep_polynomial::Symbol;

/// The most constants that are counted.
const MAX_FURTHER: usize = 10;

/// About how many terms the n-th piece has: of a wave with one pole n³/6, n² times as many for each
/// further constant with a name. A sequence in symbols has n, and takes the work of n².
pub(super) fn terms_of_piece(recurrence: &Recurrence, n: usize) -> u128 {
    let n = n as u128 + 1;
    let differential = recurrence.steps().iter().any(|step| step.start.is_some());
    match (differential, recurrence.symbols().next()) {
        (true, _) => {
            let further = constants_in_equations(recurrence).saturating_sub(1).min(MAX_FURTHER);
            (n.saturating_pow(3) / 6 + 1).saturating_mul(n.saturating_pow(2 * further as u32))
        }
        (false, Some(_)) => n.saturating_pow(2),
        (false, None) => n,
    }
}

/// How many constants with names the equations hold.
fn constants_in_equations(recurrence: &Recurrence) -> usize {
    let holds = |symbol: &Symbol| {
        recurrence.steps().iter().any(|step| {
            let mut rows = step
                .equation
                .operators()
                .flat_map(|(_, operator)| operator.value.values().chain(operator.slope.values()));
            rows.any(|value| value.contains(symbol))
        })
    };
    recurrence.constants().iter().filter(|constant| holds(&constant.symbol)).count()
}

/// About how many terms there are in `parts` waves with all pieces to the n-th, where that has
/// `last` terms: a sum of cubes, `Σ k³ ≈ n n³/4`.
pub(super) fn terms_through(last: u128, n: usize, parts: usize) -> u128 {
    last.saturating_mul(n as u128 / 4 + 1).saturating_mul(parts.max(1) as u128)
}

/// Refuses more terms than are derived at once.
pub(super) fn refuse_terms(terms: u128) -> Result<(), ProblemError> {
    if terms <= MAX_DERIVED_TERMS { Ok(()) } else { Err(ProblemError::TooManyTerms(terms as f64)) }
}

/// Refuses too many pieces of all waves.
pub(super) fn refuse_pieces(recurrence: &Recurrence, through: usize) -> Result<(), ProblemError> {
    let last = terms_of_piece(recurrence, through);
    refuse_terms(terms_through(last, through, recurrence.statement().waves.len()))
}

/// The most terms of echoes with names for rates after which a further one is derived: each has ten to a thousand
/// times as many as the one before.
pub(super) const MAX_NAMED_TERMS: usize = 10_000;

/// The first order, before the last that is wanted, of which the echoes of some waves have more than so many terms, and how
/// many it has at least.
pub(super) fn first_long_echo(
    recurrence: &Recurrence,
    waves: &[WaveIndex],
    last: usize,
    most: usize,
) -> Result<Option<(usize, usize)>, SolveError> {
    let mut demand = Demand::none(recurrence);
    for wave in waves {
        (0..last).for_each(|k| demand.add(recurrence, *wave, k));
    }
    let mut by_echo = EchoByEcho::new(recurrence).wanting(demand);
    for n in 0..last {
        let mut terms = 0;
        let is_short = by_echo.advance_while(|echo| {
            terms += echo.term_count();
            terms <= most
        })?;
        if !is_short {
            return Ok(Some((n, terms)));
        }
    }
    Ok(None)
}

/// How many numbers of a lattice cost no more than an echo: most are of echoes beyond those that are wanted.
const NUMBERS_OF_ECHO: usize = 40;

/// Refuses the echoes of so many waves on a lattice, `C(n + p, p)` of each through order `n` with `p` periods, where there are too
/// many, or too many numbers among which they stand.
pub(super) fn refuse_echoes(
    network: &Network,
    waves: usize,
    through: usize,
) -> Result<(), ProblemError> {
    let (mut echoes, mut numbers) = (waves, waves);
    for count in 1..=network.lattice().periods().len() {
        echoes = echoes.saturating_mul(through.saturating_add(count)) / count;
        numbers = numbers.saturating_mul(through.saturating_add(1));
    }
    let limit = MAX_DERIVED_ECHOES;
    match (echoes > limit, numbers > NUMBERS_OF_ECHO * limit) {
        (true, _) => Err(ProblemError::TooManyEchoes { echoes, limit }),
        (_, true) => Err(ProblemError::TooManyEchoes { echoes: numbers, limit }),
        _ => Ok(()),
    }
}

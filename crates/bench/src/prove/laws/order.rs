//! The order of costs: by k, and by rules that allow more.

use mediant::{CornerRule, DiagonalGap, Error, K, Motion, Rules, moves::bound_at_corners};

use super::{CASES, Case, asker, ks};
use crate::prove::{outcome::Outcome, tally::Tally, terrain::Instance};

/// Motions, each with the costs of all instances.
type Costs = Vec<(Motion, Vec<Outcome>)>;

/// The costs of all instances under a motion.
fn costs(case: Case<'_>, motion: Motion) -> Result<Vec<Outcome>, Error> {
    let mut asker = asker(&case.terrain.map, motion)?;
    Ok(case.terrain.instances.iter().map(|instance| asker.cost(instance.ends)).collect())
}

/// Counts, for each instance, that the one cost is at most `factor` times the other.
fn expect(
    case: Case<'_>,
    (less, of_less): (&[Outcome], Motion),
    (more, of_more): (&[Outcome], Motion),
    factor: f64,
    tally: &mut Tally,
) {
    let holds = |(_, less, more): &(&Instance, &Outcome, &Outcome)| less.is_at_most(factor, more);
    let all = case.terrain.instances.iter().zip(less).zip(more);
    for found in all.map(|((instance, less), more)| (instance, less, more)) {
        tally.count(CASES);
        tally.expect(holds(&found), || {
            let (instance, less, more) = found;
            let words = case.words(instance, of_less);
            format!("{words}: {less} is not at most {factor} times {more} of {of_more}")
        });
    }
}

/// At corners: any ≤ k + 1 ≤ k ≤ Γ_k · any, and an open gap makes no path longer.
pub(super) fn at_corners(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    // The costs of the k before, with closed and with open gaps, and those at any angle.
    let (mut before, mut any): (Costs, Costs) = Default::default();
    for k in ks().rev() {
        let motions = [DiagonalGap::Open, DiagonalGap::Closed].map(|gap| Motion::new(k, gap));
        let found = motions.map(|motion| costs(case, motion));
        let found: Costs = motions
            .into_iter()
            .zip(found)
            .map(|(motion, found)| Ok((motion, found?)))
            .collect::<Result<_, Error>>()?;
        expect(case, (&found[0].1, found[0].0), (&found[1].1, found[1].0), 1.0, tally);
        for ((less, few), (more, many)) in before.iter().zip(&found) {
            expect(case, (few, *less), (many, *more), 1.0, tally);
        }
        match k.finite() {
            None => any.clone_from(&found),
            Some(finite) => {
                for ((of_any, any), (more, many)) in any.iter().zip(&found) {
                    expect(case, (many, *more), (any, *of_any), bound_at_corners(finite), tally);
                }
            }
        }
        before = found;
    }
    Ok(())
}

/// Between centers: any ≤ k + 1 ≤ k, with closed gaps where corners are not always cut; and a rule that
/// allows more makes no path longer.
pub(super) fn at_centers(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    let ks: Vec<K> = ks().rev().filter(|&k| k != K::Any).collect();
    let mut of_rules: Vec<Costs> = Vec::new();
    for rule in [CornerRule::Always, CornerRule::One, CornerRule::Never] {
        let gap = if rule == CornerRule::Always { DiagonalGap::Open } else { DiagonalGap::Closed };
        let of_any = Motion::new(K::Any, Rules::CenterGap(gap));
        let mut found = vec![(of_any, costs(case, of_any)?)];
        for &k in &ks {
            let motion = Motion::new(k, rule);
            let next = costs(case, motion)?;
            if let Some((of_best, best)) = found.last() {
                expect(case, (best, *of_best), (&next, motion), 1.0, tally);
            }
            found.push((motion, next));
        }
        if let Some(before) = of_rules.last() {
            for ((less, few), (more, many)) in before.iter().zip(&found) {
                expect(case, (few, *less), (many, *more), 1.0, tally);
            }
        }
        of_rules.push(found);
    }
    Ok(())
}

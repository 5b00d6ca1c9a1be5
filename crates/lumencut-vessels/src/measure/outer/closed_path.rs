//! The cheapest closed path through the costs of a polar map, by dynamic programming.

use crate::measure::section::rays::RAYS;

/// Maximum change of the distance from one ray to the next, in samples.
const MAX_CHANGE: usize = 8;

/// The sample of each ray on the path with the smallest sum of costs and `change` times squared changes of distance.
/// The rays are passed three times; the second time does not depend on where the path begins.
pub(crate) fn closed_path(costs: &[f64], count: usize, change: f64) -> Vec<usize> {
    let row = |turn: usize| &costs[turn % RAYS * count..][..count];
    let mut sums = row(0).to_vec();
    let mut back: Vec<Vec<u16>> = Vec::with_capacity(3 * RAYS);
    for turn in 1..3 * RAYS {
        let mut from = vec![0_u16; count];
        let mut next = vec![0.0; count];
        for n in 0..count {
            let near = n.saturating_sub(MAX_CHANGE)..(n + MAX_CHANGE + 1).min(count);
            let (mut best, mut least) = (n, f64::INFINITY);
            for m in near {
                let sum = sums[m] + change * (n.abs_diff(m) as f64).powi(2);
                if sum < least {
                    (best, least) = (m, sum);
                }
            }
            (from[n], next[n]) = (best as u16, least + row(turn)[n]);
        }
        back.push(from);
        sums = next;
    }
    let mut at = (0..count).min_by(|a, b| sums[*a].total_cmp(&sums[*b])).unwrap_or(0);
    let mut path = vec![at; 3 * RAYS];
    for turn in (1..3 * RAYS).rev() {
        at = usize::from(back[turn - 1][at]);
        path[turn - 1] = at;
    }
    path[RAYS..2 * RAYS].to_vec()
}

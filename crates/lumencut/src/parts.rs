//! Finds groups of connected lines, and the parent of each line. Two lines connect if one ends at a point of the other.

use std::collections::{HashMap, VecDeque};

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::math::same_place::VESSEL_END;

/// Indices of connected lines in ascending order, the longest group first. An end matches points within [`VESSEL_END`].
pub fn parts(lines: &[&[DVec3]]) -> Vec<Vec<usize>> {
    let mut heads: Vec<usize> = (0..lines.len()).collect();
    touching(lines, |number, _, owner| join(&mut heads, number, owner));
    let mut parts: HashMap<usize, Vec<usize>> = HashMap::new();
    for number in 0..lines.len() {
        parts.entry(head(&mut heads, number)).or_default().push(number);
    }
    let length = |part: &Vec<usize>| -> f64 {
        part.iter().filter_map(|number| arc_lengths(lines[*number]).last().copied()).sum()
    };
    let mut ranked: Vec<(f64, Vec<usize>)> = parts.into_values().map(|part| (length(&part), part)).collect();
    ranked.sort_by(|(a, first), (b, second)| b.total_cmp(a).then(first[0].cmp(&second[0])));
    ranked.into_iter().map(|(_, part)| part).collect()
}

/// The parent of each line, found breadth first from the widest line of each part, which has no parent. A line of unknown width
/// counts as narrowest.
pub(crate) fn parents(lines: &[&[DVec3]], widths: &[Option<f64>]) -> Vec<Option<usize>> {
    let mut neighbors = vec![Vec::new(); lines.len()];
    touching(lines, |number, _, owner| {
        neighbors[number].push(owner);
        neighbors[owner].push(number);
    });
    let mut parents = vec![None; lines.len()];
    let mut is_reached = vec![false; lines.len()];
    let width = |number: usize| widths[number].unwrap_or(0.0);
    while let Some(root) =
        (0..lines.len()).rev().filter(|n| !is_reached[*n]).max_by(|a, b| width(*a).total_cmp(&width(*b)))
    {
        is_reached[root] = true;
        let mut way = VecDeque::from([root]);
        while let Some(from) = way.pop_front() {
            for to in neighbors[from].iter().copied() {
                if !std::mem::replace(&mut is_reached[to], true) {
                    parents[to] = Some(from);
                    way.push_back(to);
                }
            }
        }
    }
    parents
}

/// Calls `visit(a, n, b)` for each end of line b that is point n of line a.
pub(crate) fn touching(lines: &[&[DVec3]], mut visit: impl FnMut(usize, usize, usize)) {
    let ends = ends(lines);
    for (number, line) in lines.iter().enumerate() {
        for (place, point) in line.iter().enumerate() {
            for (end, owner) in ends.get(&cell(*point)).into_iter().flatten() {
                if end.distance_squared(*point) <= VESSEL_END * VESSEL_END {
                    visit(number, place, *owner);
                }
            }
        }
    }
}

type Cell = [i64; 3];

fn cell(point: DVec3) -> Cell {
    (point / VESSEL_END).floor().to_array().map(|side| side as i64)
}

fn ends(lines: &[&[DVec3]]) -> HashMap<Cell, Vec<(DVec3, usize)>> {
    let mut ends: HashMap<Cell, Vec<(DVec3, usize)>> = HashMap::new();
    for (number, line) in lines.iter().enumerate() {
        for end in [line.first(), line.last()].into_iter().flatten() {
            let [x, y, z] = cell(*end);
            for near in 0..27 {
                let near = [x + near % 3 - 1, y + near / 3 % 3 - 1, z + near / 9 - 1];
                ends.entry(near).or_default().push((*end, number));
            }
        }
    }
    ends
}

fn head(heads: &mut [usize], mut number: usize) -> usize {
    while heads[number] != number {
        heads[number] = heads[heads[number]];
        number = heads[number];
    }
    number
}

fn join(heads: &mut [usize], one: usize, other: usize) {
    let [one, other] = [head(heads, one), head(heads, other)];
    heads[one.max(other)] = one.min(other);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight(from: [f64; 3], to: [f64; 3]) -> Vec<DVec3> {
        let [from, to] = [from, to].map(DVec3::from_array);
        (0..=10).map(|n| from.lerp(to, f64::from(n) / 10.0)).collect()
    }

    #[test]
    fn lines_hang_together_by_their_ends_and_by_ends_on_points_between() {
        let trunk = straight([0.0; 3], [0.0, 0.0, 100.0]);
        // Lines from a trunk point, from the trunk's end as rounded by a file, from a branch, and one next to the trunk.
        let branch = straight([0.0, 0.0, 50.0], [30.0, 0.0, 50.0]);
        let leg = straight([0.0, 0.0006, 100.0006], [0.0, 20.0, 130.0]);
        let twig = straight([30.0, 5.0, 50.0], [30.0, 0.0, 50.0]);
        let beside = straight([0.0, 0.1, 30.0], [0.0, 40.0, 30.0]);
        let alone = straight([0.0, 40.0, 30.0], [0.0, 340.0, 30.0]);
        let lines = [&branch, &beside, &trunk, &alone, &leg, &twig].map(Vec::as_slice);
        assert_eq!(parts(&lines), [vec![1, 3], vec![0, 2, 4, 5]]);
        assert_eq!(parts(&lines[..2]), [vec![1], vec![0]]);
        assert!(parts(&[]).is_empty());
    }

    #[test]
    fn a_line_hangs_on_the_wider_one_that_it_leads_back_to() {
        let trunk = straight([0.0; 3], [0.0, 0.0, 100.0]);
        let branch = straight([0.0, 0.0, 50.0], [30.0, 0.0, 50.0]);
        let twig = straight([30.0, 5.0, 50.0], [30.0, 0.0, 50.0]);
        let leg = straight([0.0, 0.0, 100.0], [0.0, 20.0, 130.0]);
        let alone = straight([0.0, 40.0, 30.0], [0.0, 340.0, 30.0]);
        let lines = [&twig, &branch, &trunk, &leg, &alone].map(Vec::as_slice);
        let widths = [Some(2.0), Some(5.0), Some(20.0), Some(9.0), None];
        assert_eq!(parents(&lines, &widths), [Some(1), Some(2), None, Some(2), None]);
        // If no width is known, the first line is the root.
        assert_eq!(parents(&lines, &[None; 5]), [None, Some(0), Some(1), Some(2), None]);
        assert!(parents(&[], &[]).is_empty());
    }

    #[test]
    fn lines_that_cross_without_an_end_there_do_not_hang_together() {
        let along = straight([-10.0, 0.0, 0.0], [10.0, 0.0, 0.0]);
        let across = straight([0.0, -10.0, 0.0], [0.0, 10.0, 0.0]);
        assert_eq!(parts(&[&along, &across]), [vec![0], vec![1]]);
    }
}

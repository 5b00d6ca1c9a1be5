//! Parts a section into lumens by flooding: water rises from the middle of each lumen, and where two lumens meet at a dark
//! sheet, a dam keeps them apart (watershed; Vincent and Soille 1991, doi:10.1109/34.87344).

use std::collections::{HashMap, HashSet};

use super::plane_map::PlaneMap;
use lumencut_core::math::statistics::median;

/// What keeps two basins apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dams {
    /// Brighter values are lumen.
    pub bright: f64,
    /// Weaker sheets part nothing.
    pub least_sheet: f64,
    /// Smaller basins are noise (number of values).
    pub least_size: usize,
    /// Two basins are one if at least this number of values between them shows no sheet; fewer are noise.
    pub least_gap: usize,
}

/// Number of the basin of each value of the map; `NONE` in the dark.
pub(crate) struct Basins {
    pub of: Vec<u32>,
}

pub(crate) const NONE: u32 = u32::MAX;

struct Joined {
    parent: Vec<u32>,
    size: Vec<usize>,
}

impl Joined {
    fn root(&mut self, n: usize) -> Option<usize> {
        if self.parent[n] == NONE {
            return None;
        }
        let mut at = n;
        while self.parent[at] as usize != at {
            self.parent[at] = self.parent[self.parent[at] as usize];
            at = self.parent[at] as usize;
        }
        Some(at)
    }

    fn join(&mut self, root: usize, other: usize) {
        self.parent[other] = root as u32;
        self.size[root] += self.size[other];
    }
}

impl Basins {
    /// Floods the bright values of a smoothed map in the order of their sheets.
    pub(crate) fn of(smooth: &PlaneMap, sheets: &[f64], dams: &Dams) -> Self {
        let mut order: Vec<usize> = (0..sheets.len()).filter(|n| smooth.values[*n] > dams.bright).collect();
        order.sort_by(|a, b| sheets[*a].max(0.0).total_cmp(&sheets[*b].max(0.0)).then(a.cmp(b)));
        let mut joined = Joined { parent: vec![NONE; sheets.len()], size: vec![1; sheets.len()] };
        let mut gaps: HashMap<[usize; 2], usize> = HashMap::new();
        for n in order {
            let mut roots: Vec<usize> = neighbors(n, smooth.count).filter_map(|m| joined.root(m)).collect();
            roots.sort_by(|a, b| joined.size[*b].cmp(&joined.size[*a]).then(a.cmp(b)));
            roots.dedup();
            joined.parent[n] = n as u32;
            let Some(largest) = roots.first().copied() else { continue };
            joined.join(largest, n);
            for other in &roots[1..] {
                let gap = gaps.entry([largest.min(*other), largest.max(*other)]).or_default();
                *gap += usize::from(sheets[n] < dams.least_sheet);
                if *gap >= dams.least_gap || joined.size[*other] < dams.least_size {
                    joined.join(largest, *other);
                }
            }
        }
        let root = |n: usize| joined.root(n).map_or(NONE, |root| root as u32);
        Self { of: (0..sheets.len()).map(root).collect() }
    }

    /// Reduces a basin to the largest connected part in which a smoothed map exceeds a fraction of its contrast to the level
    /// `dark`. Returns how many of the other values lie farther than `near` steps from this part.
    pub(crate) fn trim(
        &mut self,
        smooth: &PlaneMap,
        basin: u32,
        (dark, share): (f64, f64),
        near: isize,
    ) -> usize {
        let all: Vec<usize> = (0..self.of.len()).filter(|n| self.of[*n] == basin).collect();
        let mut values: Vec<f64> = all.iter().map(|n| smooth.values[*n]).collect();
        let least = dark + share * (median(&mut values).unwrap_or(dark) - dark);
        for n in &all {
            self.of[*n] = NONE;
        }
        let mut left: HashSet<usize> = all.iter().copied().filter(|n| smooth.values[*n] > least).collect();
        let mut largest = Vec::new();
        for n in &all {
            let mut part: Vec<usize> = left.take(n).into_iter().collect();
            let mut at = 0;
            while at < part.len() {
                part.extend(neighbors(part[at], smooth.count).filter_map(|m| left.take(&m)));
                at += 1;
            }
            largest = if part.len() > largest.len() { part } else { largest };
        }
        for n in &largest {
            self.of[*n] = basin;
        }
        let is_far = |n: &&usize| self.of[**n] == NONE && !self.is_within(**n, basin, (near, smooth.count));
        all.iter().filter(is_far).count()
    }

    /// Whether a basin has a value within this number of steps of value `n`, in rows of `count` values.
    fn is_within(&self, n: usize, basin: u32, (steps, count): (isize, usize)) -> bool {
        let (i, j, count) = ((n % count) as isize, (n / count) as isize, count as isize);
        let mut around =
            (-steps..=steps).flat_map(|y| (-steps..=steps).map(move |x| (i + x, j + y, x * x + y * y)));
        around.any(|(x, y, square)| {
            let is_inside = x >= 0 && y >= 0 && x < count && y < count && square <= steps * steps;
            is_inside && self.of[(y * count + x) as usize] == basin
        })
    }

    pub(crate) fn size(&self, basin: u32) -> usize {
        self.of.iter().filter(|of| **of == basin).count()
    }
}

/// The values above, left, right and below, if they lie in the map.
pub(crate) fn neighbors(n: usize, count: usize) -> impl Iterator<Item = usize> {
    let (i, j) = (n % count, n / count);
    let all = [(j > 0).then(|| n - count), (i > 0).then(|| n - 1)];
    let more = [(i + 1 < count).then_some(n + 1), (j + 1 < count).then_some(n + count)];
    all.into_iter().chain(more).flatten()
}

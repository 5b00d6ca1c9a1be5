//! SWC trees: a node per point, each behind its parent.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::check_all;
use crate::centerlines::Line;
use crate::error::Result;

/// What two points share that are the same place.
type Place = [u64; 3];

/// A `.swc` file of vessels (mm, LPS), which the format cannot state.
///
/// A vessel that begins at a point of another one continues from its node, whose radius stays that of the
/// other vessel. The format has no names, and no vessels: a reader has a branch from each forking to the next.
/// A vessel that ends at a point of another one ends at a node of its own there, because a node has only one
/// parent. Radii that are not known are 0.
///
/// # Errors
/// Where there is no vessel, or one is not what a [`Line`] is.
pub fn write_swc(vessels: &[Line]) -> Result<Vec<u8>> {
    check_all(vessels)?;
    let mut out = String::from("# vessels in mm, LPS\n# id type x y z radius parent\n");
    let mut nodes: HashMap<Place, usize> = HashMap::new();
    let mut last = 0;
    for index in parents_first(vessels) {
        let vessel = &vessels[index];
        let mut parent = nodes.get(&place(vessel.points[0])).copied();
        let begin = usize::from(parent.is_some());
        for (i, point) in vessel.points.iter().enumerate().skip(begin) {
            last += 1;
            let radius = vessel.radius.as_ref().map_or(0.0, |radius| radius[i]);
            let behind = parent.map_or_else(|| "-1".to_owned(), |parent| parent.to_string());
            out += &format!("{last} 0 {:?} {:?} {:?} {radius:?} {behind}\n", point.x, point.y, point.z);
            nodes.entry(place(*point)).or_insert(last);
            parent = Some(last);
        }
    }
    Ok(out.into_bytes())
}

/// The bits of the coordinates; zeros of either sign are one place.
fn place(point: DVec3) -> Place {
    (point + DVec3::ZERO).to_array().map(f64::to_bits)
}

/// The vessels, each behind one that holds its first point; where they go around in a circle, one begins.
fn parents_first(vessels: &[Line]) -> Vec<usize> {
    let mut starting: HashMap<Place, Vec<usize>> = HashMap::new();
    for (index, vessel) in vessels.iter().enumerate() {
        starting.entry(place(vessel.points[0])).or_default().push(index);
    }
    let inner: HashSet<Place> =
        vessels.iter().flat_map(|vessel| &vessel.points[1..]).map(|point| place(*point)).collect();
    let is_root = |index: &usize| !inner.contains(&place(vessels[*index].points[0]));
    let (roots, others): (Vec<usize>, Vec<usize>) = (0..vessels.len()).partition(is_root);
    let mut written = vec![false; vessels.len()];
    let mut out = Vec::with_capacity(vessels.len());
    for first in roots.into_iter().chain(others) {
        let mut waiting = vec![first];
        while let Some(index) = waiting.pop() {
            if std::mem::replace(&mut written[index], true) {
                continue;
            }
            out.push(index);
            for point in vessels[index].points.iter().rev() {
                // Each place hands its vessels over once.
                waiting.extend(starting.remove(&place(*point)).unwrap_or_default().into_iter().rev());
            }
        }
    }
    out
}

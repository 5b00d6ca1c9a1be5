//! Writes SWC trees, with one node per point; each node comes after its parent.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::check_all;
use crate::centerlines::Line;
use crate::error::Result;

type Place = [u64; 3];

/// Writes a `.swc` of vessels. Coordinates are in mm and LPS, which the format cannot state. A vessel that starts on
/// another one continues from its node there, with the radius of that node. A vessel that ends on another one gets a
/// separate node there, because a node has only one parent. Names and the ends of vessels are lost, and unknown radii
/// are 0. Fails if no vessel is valid.
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

/// Bits of the coordinates; 0 and -0 are treated as equal.
fn place(point: DVec3) -> Place {
    (point + DVec3::ZERO).to_array().map(f64::to_bits)
}

/// An order in which each vessel follows one that contains its first point. A loop starts at any vessel.
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
                // All vessels that start at this point are added now, so the point is removed.
                waiting.extend(starting.remove(&place(*point)).unwrap_or_default().into_iter().rev());
            }
        }
    }
    out
}

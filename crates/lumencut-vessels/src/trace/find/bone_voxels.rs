//! Finds the bone of a CT angiography voxel by voxel, so that views can hide it. Bright voxels between vessels and bone belong to
//! the one that reaches them first through bright voxels. No voxel of a vessel or its wall is bone.

mod closing;

use std::collections::VecDeque;

use crate::trace::find::bone_voxels::closing::{closed, spread};
use crate::trace::lines::centerline::Centerline;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, filled, go_on};

/// Bone exceeds the level of the vessels by this fraction of their contrast somewhere; everything bright is brighter than halfway.
const HARD_ABOVE: f64 = 0.4;
const BRIGHT_BELOW: f64 = 0.5;

/// Smaller hard parts (mm³) are not bone, but plaque or noise.
const LEAST_BONE_MM3: f64 = 300.0;

/// Bone grows from its hard parts at most this far (mm), so that a vessel that nobody traced is not lost as a whole.
const BONE_REACH_MM: f64 = 12.0;

/// Thickness of vessel wall, plaque and struts (mm) around the lumen.
const WALL_MM: f64 = 2.0;

/// Marrow and gaps narrower than twice this (mm) belong to the bone.
const MARROW_MM: f64 = 4.0;

/// Distance between balls along a vessel, as a fraction of the radius.
const BALL_STEP: f64 = 0.25;

/// Which bone to find.
pub struct BoneRequest<'a> {
    /// The usual value of the vessels.
    pub level: f64,
    /// The usual contrast of the vessels to their surroundings.
    pub contrast: f64,
    /// The vessels of the scan.
    pub vessels: &'a [Centerline],
    /// Called often; returns whether to stop.
    pub stop: Stop<'a>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Label {
    Dark,
    Bright,
    Hard,
    Lumen,
    Wall,
    Bone,
}

/// For each voxel, i fastest, whether it is bone.
pub fn bone(voxels: &Voxels, request: &BoneRequest) -> Result<Vec<bool>> {
    let mut labels = brightness(voxels, request)?;
    for vessel in request.vessels {
        go_on(request.stop)?;
        mark_vessel(voxels, vessel, &mut labels);
    }
    let seeds = hard_parts(voxels, &mut labels, request.stop)?;
    grow(voxels, &mut labels, seeds, request.stop)?;
    with_marrow(voxels, &labels, request.stop)
}

/// Calls `at` with the number of each voxel of a vessel and its wall, i fastest, some of them several times, and with the distance
/// from the lumen (mm, negative inside).
pub fn for_each_voxel(voxels: &Voxels, vessel: &Centerline, at: &mut dyn FnMut(usize, f64)) {
    let [ni, nj, _] = voxels.size;
    for (center, radius) in balls(voxels, vessel) {
        let (first, count) = voxels.around(center, radius + WALL_MM);
        let rows = (0..count[2]).flat_map(|k| (0..count[1]).map(move |j| [j, k]));
        for [j, k] in rows {
            for i in 0..count[0] {
                let voxel = [first[0] + i, first[1] + j, first[2] + k];
                let beyond = voxels.center(voxel).distance(center) - radius;
                if beyond <= WALL_MM {
                    let [i, j, k] = voxel.map(|c| c as usize);
                    at(i + ni * (j + nj * k), beyond);
                }
            }
        }
    }
}

/// Balls that fill the vessel: centre and radius (mm), 0 if unknown.
fn balls<'a>(voxels: &Voxels, vessel: &'a Centerline) -> impl Iterator<Item = (glam::DVec3, f64)> + 'a {
    let side = voxels.smallest_side;
    let known = |radius: &f64| if radius.is_finite() { *radius } else { 0.0 };
    let ends = vessel.points.windows(2).zip(vessel.radius.windows(2));
    let first = vessel.points.first().copied().zip(vessel.radius.first().map(known));
    let between = ends.flat_map(move |(points, radii)| {
        let radii = [known(&radii[0]), known(&radii[1])];
        let (from, way) = (points[0], points[1] - points[0]);
        let steps = (way.length() / (BALL_STEP * radii[0].min(radii[1])).max(side)).ceil().max(1.0);
        (1..=steps as usize).map(move |n| {
            let share = n as f64 / steps;
            (from + way * share, radii[0] + (radii[1] - radii[0]) * share)
        })
    });
    first.into_iter().chain(between)
}

fn brightness(voxels: &Voxels, request: &BoneRequest) -> Result<Vec<Label>> {
    let [ni, nj, nk] = voxels.size;
    let mut labels = filled(ni * nj * nk, Label::Dark, request.stop)?;
    let bright = request.level - BRIGHT_BELOW * request.contrast;
    let hard = request.level + HARD_ABOVE * request.contrast;
    for (k, plane) in labels.chunks_mut((ni * nj).max(1)).enumerate() {
        go_on(request.stop)?;
        for (n, label) in plane.iter_mut().enumerate() {
            let value = f64::from(voxels.voxel([n % ni, n / ni, k].map(|c| c as i32)));
            *label = match value {
                value if value > hard => Label::Hard,
                value if value > bright => Label::Bright,
                _ => Label::Dark,
            };
        }
    }
    Ok(labels)
}

fn mark_vessel(voxels: &Voxels, vessel: &Centerline, labels: &mut [Label]) {
    for_each_voxel(voxels, vessel, &mut |n, beyond| {
        if beyond <= 0.0 {
            labels[n] = Label::Lumen;
        } else if labels[n] != Label::Lumen {
            labels[n] = Label::Wall;
        }
    });
}

/// Labels hard parts as bone if they are large enough; returns their voxels.
fn hard_parts(voxels: &Voxels, labels: &mut [Label], stop: Stop) -> Result<Vec<u32>> {
    let least = LEAST_BONE_MM3 / voxels.mean_side().powi(3);
    let (mut seeds, mut part) = (Vec::new(), Vec::new());
    for n in 0..labels.len() {
        if n % voxels.size[0] == 0 {
            go_on(stop)?;
        }
        if labels[n] != Label::Hard {
            continue;
        }
        part.clear();
        part.push(n as u32);
        labels[n] = Label::Bone;
        let mut done = 0;
        while done < part.len() {
            let at = part[done] as usize;
            done += 1;
            for near in neighbors(voxels.size, at) {
                if labels[near] == Label::Hard {
                    labels[near] = Label::Bone;
                    part.push(near as u32);
                }
            }
        }
        if part.len() as f64 >= least {
            seeds.extend_from_slice(&part);
        } else {
            part.iter().for_each(|n| labels[*n as usize] = Label::Bright);
        }
    }
    Ok(seeds)
}

/// Gives bright voxels to the vessel or bone that reaches them first. A lumen may be wider than its vessel's circle, so it grows
/// through the wall.
fn grow(voxels: &Voxels, labels: &mut [Label], bone: Vec<u32>, stop: Stop) -> Result<()> {
    let lumen = (0..labels.len()).filter(|n| labels[*n] == Label::Lumen).map(|n| n as u32);
    let mut front: VecDeque<u32> = lumen.chain(bone).collect();
    let most = (BONE_REACH_MM / voxels.mean_side()).ceil() as usize;
    for step in 0.. {
        go_on(stop)?;
        if front.is_empty() {
            break;
        }
        for _ in 0..front.len() {
            let Some(n) = front.pop_front() else { break };
            let label = labels[n as usize];
            if label == Label::Bone && step >= most {
                continue;
            }
            for near in neighbors(voxels.size, n as usize) {
                if labels[near] == Label::Bright {
                    labels[near] = label;
                    front.push_back(near as u32);
                }
            }
        }
    }
    Ok(())
}

/// The bone with its marrow and its blurred surface, which are dark.
fn with_marrow(voxels: &Voxels, labels: &[Label], stop: Stop) -> Result<Vec<bool>> {
    let mut bone = filled(labels.len(), false, stop)?;
    bone.iter_mut().zip(labels).for_each(|(bone, label)| *bone = *label == Label::Bone);
    let axes = voxels.world_from_index.matrix3;
    let sides = [axes.x_axis, axes.y_axis, axes.z_axis].map(glam::DVec3::length);
    closed(&mut bone, voxels.size, sides.map(|side| (MARROW_MM / side).round() as usize), stop)?;
    spread(&mut bone, voxels.size, [1; 3], stop)?;
    let may_be = |label: &Label| matches!(label, Label::Bone | Label::Dark);
    bone.iter_mut().zip(labels).for_each(|(bone, label)| *bone &= may_be(label));
    Ok(bone)
}

/// The numbers of the voxels that share a face with a voxel.
fn neighbors([ni, nj, nk]: [usize; 3], n: usize) -> impl Iterator<Item = usize> {
    let at = [n % ni, n / ni % nj, n / ni / nj];
    let along = [(at[0], ni, 1), (at[1], nj, ni), (at[2], nk, ni * nj)];
    along.into_iter().flat_map(move |(place, count, stride)| {
        let before = (place > 0).then(|| n - stride);
        let after = (place + 1 < count).then(|| n + stride);
        before.into_iter().chain(after)
    })
}

#[cfg(test)]
#[path = "tests/bone_voxels.rs"]
mod tests;

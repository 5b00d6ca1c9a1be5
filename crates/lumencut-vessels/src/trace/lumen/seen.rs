//! The lumen around one place: which way it runs, its middle and its radius, seen by nothing but the values around it.

use glam::DVec3;

use crate::trace::lumen::cross_section::{LumenSection, Probe, WIDEST};
use crate::trace::lumen::directions::{half_sphere, longest_axis};
use crate::trace::lumen::surroundings::Surroundings;
use crate::voxels::Voxels;
use lumencut_core::volume::Volume;

/// In how many directions of a half sphere the walls are looked for, and with how many rays in a cross-section.
const DIRECTIONS: u32 = 60;
const RAYS: usize = 32;

/// A lumen is followed lengthwise so many times as far as it is narrow: enough to tell along from across.
const LENGTHWISE: f64 = 3.0;

/// How often its direction is looked for again from the middle that was found.
const ROUNDS: usize = 2;

/// A cross-section that is trusted less is no lumen to be offered.
const LEAST_TRUST: f64 = 0.4;

/// The lumen around a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenLumen {
    /// Its middle (mm, LPS).
    pub center: DVec3,
    /// Its radius (mm).
    pub radius: f64,
    /// Which way it runs (a unit vector; as well the other way).
    pub along: DVec3,
    /// The median of the values in its middle.
    pub value: f64,
}

/// The lumen that a place (mm, LPS) lies in; none where the values around it look like none. Ours: the direction is that along which
/// the walls are farthest away on both sides, and the circle across it is the one that traced lines are centred by.
pub fn lumen_at(volume: &Volume, place: DVec3) -> Option<SeenLumen> {
    let voxels = &Voxels::new(volume);
    voxels.voxel_at(place)?;
    lumen_in(voxels, &Surroundings::of(voxels, &[place]), place)
}

/// The same where it is known what surrounds the place.
pub fn lumen_in(voxels: &Voxels, surroundings: &Surroundings, place: DVec3) -> Option<SeenLumen> {
    let model = surroundings.model_at(voxels, place)?;
    let probe = Probe { voxels, model: &model, rays: RAYS };
    let mut seen: Option<(LumenSection, DVec3)> = None;
    for _ in 0..ROUNDS {
        let (center, guess) =
            seen.map_or((place, None), |(section, _)| (section.center, Some(section.radius)));
        let along = direction(&probe, center)?;
        seen = Some((probe.look(center, across(along), guess)?, along));
    }
    let (section, along) = seen?;
    let is_lumen = section.trust >= LEAST_TRUST && section.center.distance(place) <= 1.5 * section.radius;
    is_lumen.then_some(SeenLumen {
        center: section.center,
        radius: section.radius,
        along,
        value: section.value,
    })
}

/// Two unit vectors across a direction.
fn across(along: DVec3) -> [DVec3; 2] {
    let first = along.any_orthonormal_vector();
    [first, along.cross(first)]
}

/// The direction along which the walls around a place are farthest away; none where hardly a wall is seen.
fn direction(probe: &Probe, place: DVec3) -> Option<DVec3> {
    let chords: Vec<(DVec3, f64)> = half_sphere(DIRECTIONS)
        .map(|way| (way, probe.chord(place, way, WIDEST).unwrap_or(f64::INFINITY)))
        .collect();
    let narrow = chords.iter().map(|(_, length)| *length).fold(f64::INFINITY, f64::min);
    if narrow.is_infinite() {
        return None;
    }
    let (start, _) = *chords.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let weighted = chords.iter().map(|(way, length)| (*way, length.min(LENGTHWISE * narrow).powi(4)));
    longest_axis(weighted, start)
}

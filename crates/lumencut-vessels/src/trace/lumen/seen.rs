//! Finds the direction, centre and radius of the lumen around one position, only from the values.

use glam::DVec3;

use crate::trace::lumen::cross_section::{HALF, LumenSection, Probe, WIDEST};
use crate::trace::lumen::directions::{half_sphere, longest_axis};
use crate::trace::lumen::surroundings::Surroundings;
use crate::voxels::Voxels;
use lumencut_core::volume::Volume;

/// Number of search directions over half a sphere, and number of rays per section.
const DIRECTIONS: u32 = 60;
const RAYS: usize = 32;

/// Longer chords count as this multiple of the narrowest one, which suffices to tell along the lumen from across it.
const LENGTHWISE: f64 = 3.0;

/// Number of rounds, each of which searches from the new centre.
const ROUNDS: usize = 2;

/// Minimum quality of a lumen that is returned.
const LEAST_TRUST: f64 = 0.4;

/// The lumen found around a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenLumen {
    /// Centre (mm, LPS).
    pub center: DVec3,
    /// Radius (mm).
    pub radius: f64,
    /// Direction of the lumen (unit vector; its sign has no meaning).
    pub along: DVec3,
    /// Median of the values near the centre.
    pub value: f64,
}

/// Lumen around a position (mm, LPS); None if it does not look like lumen. The method is our own: the
/// direction is that of the longest chords between walls; the circle across it is found as for traced lines.
pub fn lumen_at(volume: &Volume, place: DVec3) -> Option<SeenLumen> {
    let voxels = &Voxels::new(volume);
    voxels.voxel_at(place)?;
    lumen_in(voxels, &Surroundings::of(voxels, &[place]), place)
}

pub(crate) fn lumen_in(voxels: &Voxels, surroundings: &Surroundings, place: DVec3) -> Option<SeenLumen> {
    let model = surroundings.model_at(voxels, place)?;
    let probe = Probe { voxels, model: &model, rays: RAYS, fall: HALF };
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

fn across(along: DVec3) -> [DVec3; 2] {
    let first = along.any_orthonormal_vector();
    [first, along.cross(first)]
}

/// Direction of the longest chords between walls; None if hardly any wall is visible.
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

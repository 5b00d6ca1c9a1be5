//! Measures both lumens of a dissected vessel: discs parted by a flap, painted finely and blurred.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec2, DVec3};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_vessels::measure::flap::found::Flap;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::section::blur::variance_of;
use lumencut_vessels::measure::wall::WallRequest;

const SIDE: f64 = 0.8;
const FINE: usize = 4;
const FWHM: f64 = 1.0;
const SIZE: [usize; 3] = [50, 50, 40];
const MIDDLE: DVec2 = DVec2::new(20.3, 19.7);
const RADIUS: f64 = 11.0;
const FAT: f64 = -95.0;
const WALL: f64 = 50.0;
const NOISE: f64 = 15.0;

/// A vessel whose lumen is parted by a sheet across x, `at` mm from its middle.
#[derive(Clone, Copy)]
struct Flapped {
    at: f64,
    thickness: f64,
    /// Levels on both sides.
    levels: [f64; 2],
    /// Half the width of an opening in the flap (mm).
    tear: f64,
}

impl Flapped {
    fn level(&self, place: DVec2) -> f64 {
        let away = place - MIDDLE;
        match away.length() {
            length if length > RADIUS + 1.6 => FAT,
            length if length > RADIUS => WALL,
            _ if (away.x - self.at).abs() < 0.5 * self.thickness && away.y.abs() > self.tear => WALL,
            _ => self.levels[usize::from(away.x > self.at)],
        }
    }

    /// Areas to the left and to the right of the flap.
    fn areas(&self) -> [f64; 2] {
        let left = |x: f64| RADIUS * RADIUS * (-x / RADIUS).acos() + x * (RADIUS * RADIUS - x * x).sqrt();
        let half = 0.5 * self.thickness;
        [left(self.at - half), left(-self.at - half)]
    }
}

/// Sums of twelve pseudo-random numbers (Knuth's constants of MMIX) are nearly normal.
fn noise() -> impl FnMut() -> f64 {
    let mut state = 11_u64;
    move || {
        let mut sum = -6.0;
        for _ in 0..12 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            sum += (state >> 40) as f64 / f64::from(1 << 24);
        }
        NOISE * sum
    }
}

/// A blurred slice, averaged over the voxels.
fn slice(level: impl Fn(DVec2) -> f64) -> Vec<f64> {
    let (count, step) = (SIZE[0] * FINE, SIDE / FINE as f64);
    let place = |n: usize| (n as f64 + 0.5) * step - 0.5 * SIDE;
    let mut values: Vec<f64> =
        (0..count * count).map(|n| level(DVec2::new(place(n % count), place(n / count)))).collect();
    let reach = 12_isize;
    let weight = |n: isize| (-0.5 * (n as f64 * step).powi(2) / variance_of(FWHM)).exp();
    let all: f64 = (-reach..=reach).map(weight).sum();
    for (along, across) in [(1, count), (count, 1)] {
        let before = values.clone();
        for n in 0..count * count {
            let (line, at) = (n / count, (n % count) as isize);
            let value =
                |m: isize| before[line * across + (at + m).clamp(0, count as isize - 1) as usize * along];
            values[line * across + at as usize * along] =
                (-reach..=reach).map(|m| weight(m) * value(m)).sum::<f64>() / all;
        }
    }
    let mean = |n: usize| {
        let (i, j) = (n % SIZE[0] * FINE, n / SIZE[0] * FINE);
        let cells = (0..FINE * FINE).map(|m| values[(j + m / FINE) * count + i + m % FINE]);
        cells.sum::<f64>() / (FINE * FINE) as f64
    };
    (0..SIZE[0] * SIZE[1]).map(mean).collect()
}

/// The profile of a vessel along z, `off` mm beside the middle.
fn profile(off: f64, level: impl Fn(DVec2) -> f64) -> Profile {
    profile_of(off, &[slice(level)])
}

fn profile_of(off: f64, parts: &[Vec<f64>]) -> Profile {
    let mut noise = noise();
    let part = |k: usize| &parts[k * parts.len() / SIZE[2]];
    let values: Vec<f32> = (0..SIZE[2])
        .flat_map(|k| part(k).iter().map(|value| (value + noise()) as f32).collect::<Vec<_>>())
        .collect();
    let strides = [1, SIZE[0], SIZE[0] * SIZE[1]];
    let scale = DAffine3::from_scale(DVec3::splat(SIDE));
    let volume = Volume::new(Voxels::F32(&values), SIZE, strides, scale).unwrap();
    let line = (2..29).map(|z| (MIDDLE + DVec2::X * off).extend(f64::from(z)));
    let vessel = Vessel::new(line.collect(), None).unwrap();
    let wall = WallRequest::Automatic;
    let request = MeasureRequest { step: 0.5, fwhm: Some(FWHM), wall, tree: &[], stop: &|| false };
    measure(&volume, &vessel, &request).unwrap()
}

fn seen(profile: &Profile) -> Vec<usize> {
    (0..profile.len()).filter(|n| profile.flap[*n] == Flap::Seen).collect()
}

#[test]
fn both_lumens_have_their_areas_whether_the_flap_is_thin_thick_or_a_step() {
    for (thickness, levels) in [(0.6, [350.0; 2]), (1.4, [350.0; 2]), (0.8, [420.0, 260.0])] {
        let flapped = Flapped { at: 3.0, thickness, levels, tear: 0.0 };
        let found = profile(-3.0, |place| flapped.level(place));
        let all = seen(&found);
        assert!(5 * all.len() >= 4 * found.len(), "{thickness}, {levels:?}: {:?}", found.flap);
        let areas = flapped.areas();
        for n in all {
            let both = found.area_both_lumens()[n];
            let own_and_other = [found.area_own_lumen[n], found.area_other_lumen[n], both];
            for ([area, unsure], truth) in
                own_and_other.into_iter().zip([areas[0], areas[1], areas[0] + areas[1]])
            {
                assert!(
                    (area - truth).abs() < 3.0 * unsure,
                    "{thickness}, {levels:?}: {area} ± {unsure}, {truth}"
                );
                assert!(unsure < 0.03 * truth, "{unsure} of {truth}");
            }
            let right = MIDDLE.x + flapped.at;
            // Blur rounds the corners at which the flap meets the wall.
            assert!(found.own_lumen[n].iter().all(|point| point.x < right + 0.5));
            assert!(found.other_lumen[n].iter().all(|point| point.x > right - 0.5));
        }
        let stretch = found.flap_stretch().unwrap();
        assert!(stretch.ends[1] - stretch.ends[0] > 10.0);
    }
}

#[test]
fn no_second_lumen_without_a_whole_flap_or_in_a_neighbour() {
    let torn = Flapped { at: 3.0, thickness: 1.0, levels: [350.0; 2], tear: 4.0 };
    let whole = Flapped { thickness: 0.0, ..torn };
    // Another vessel touches the wall.
    let beside = |place: DVec2| {
        let is_vein = place.distance(MIDDLE + DVec2::X * (RADIUS + 5.2)) < 4.0;
        if is_vein { 300.0 } else { whole.level(place) }
    };
    for found in [profile(0.0, |at| torn.level(at)), profile(0.0, |at| whole.level(at)), profile(0.0, beside)]
    {
        assert_eq!(seen(&found), Vec::<usize>::new());
        assert!(found.other_lumen.iter().all(Vec::is_empty));
        assert!(found.area_both_lumens().iter().all(|area| area[0].is_nan()));
        assert_eq!(found.flap_stretch(), None);
    }
}

#[test]
fn another_lumen_that_changes_sides_within_10_mm_is_a_neighbour() {
    let flapped = |at: f64| Flapped { at, thickness: 1.0, levels: [350.0; 2], tear: 0.0 };
    let part = |at: f64| slice(|place| flapped(at).level(place));
    let changing = profile_of(0.0, &[part(4.0), part(-4.0), part(4.0)]);
    assert_eq!(seen(&changing), Vec::<usize>::new());
    let lasting = profile_of(0.0, &[part(4.0), part(4.0), part(-4.0)]);
    let stretch = lasting.flap_stretch().unwrap();
    assert!(lasting.other_lumen[stretch.widest].iter().all(|point| point.x > MIDDLE.x + 3.0));
    assert!(stretch.ends[0] < 2.0 && stretch.ends[1] < 21.0, "{stretch:?}");
}

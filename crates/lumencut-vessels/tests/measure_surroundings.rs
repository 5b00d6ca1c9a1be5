//! Measures vessels with walls in lung and in muscle, whose blurred image is known exactly, with noise as in CT.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DMat2, DVec2, DVec3};
use lumencut_core::error::Result;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::random::Random;
use lumencut_vessels::measure::model::ellipse::{Boundary, Ellipse, Whitening};
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::profile::{Profile, Source};
use lumencut_vessels::measure::section::blur::variance_of;
use lumencut_vessels::measure::section::flags::{AT_LIMIT, METAL, NEIGHBOR, NO_EDGE};
use lumencut_vessels::measure::wall::WallRequest;

use crate::scans::noise;

const SIDE: f64 = 0.6;
const SIZE: [usize; 3] = [40, 40, 44];
const LUMEN: f64 = 350.0;
const WALL: f64 = 50.0;
const NOISE: f64 = 18.0;

#[derive(Clone, Copy)]
struct Scene {
    diameter: f64,
    wall: f64,
    around: f64,
    fwhm: f64,
    /// Voxel side along y (mm).
    across: f64,
    /// Brightness of blurred rings of struts (HU), 2.4 mm apart in the middle of the vessel.
    struts: f64,
    /// Fraction of the diameter that a throat in the middle of the vessel takes.
    narrowed: f64,
    /// Level of a vein of 6 mm at the wall (HU); 0 for none.
    vein: f64,
}

const FAT: Scene = Scene {
    diameter: 3.2,
    wall: 0.7,
    around: -95.0,
    fwhm: 1.0,
    across: SIDE,
    struts: 0.0,
    narrowed: 0.0,
    vein: 0.0,
};
const LUNG: Scene = Scene { diameter: 8.0, wall: 0.8, around: -850.0, ..FAT };
const MUSCLE: Scene = Scene { diameter: 1.8, wall: 0.5, around: 55.0, ..FAT };

/// Arc lengths of the part with struts (mm).
const STENT: [f64; 2] = [3.0, 17.0];

impl Scene {
    fn values(&self) -> Vec<f32> {
        let sides = DVec2::new(SIDE, self.across);
        let variance = variance_of(self.fwhm);
        let whitening = Whitening::new(DMat2::from_diagonal(variance + sides * sides / 12.0));
        let middle = DVec2::new(11.8, 11.5);
        let within = |radius: f64| Boundary::new(&Ellipse::circle(middle, radius), whitening);
        let outside = 0.5 * self.diameter + self.wall;
        let wall = within(outside);
        let vein = Boundary::new(&Ellipse::circle(middle + DVec2::X * (outside + 3.1), 3.0), whitening);
        let at = |slice: usize| slice as f64 * SIDE - 3.0;
        let throat = |at: f64| 1.0 - self.narrowed * (-((at - 10.0) / 3.0).powi(4)).exp();
        let lumens: Vec<_> = (0..SIZE[2]).map(|k| within(0.5 * self.diameter * throat(at(k)))).collect();
        let mut random = Random::new(7);
        (0..SIZE.iter().product())
            .map(|n: usize| {
                let place = DVec2::new((n % SIZE[0]) as f64, (n / SIZE[0] % SIZE[1]) as f64) * sides;
                let slice = n / SIZE[0] / SIZE[1];
                let [inside, enclosed] = [&lumens[slice], &wall].map(|boundary| boundary.value(place));
                let value = self.around + (WALL - self.around) * enclosed + (LUMEN - WALL) * inside;
                let beside = if self.vein > 0.0 { vein.value(place) } else { 0.0 };
                let value = value + (self.vein - self.around) * beside;
                let at = at(slice);
                let along = (at / 2.4 - (at / 2.4).round()) * 2.4;
                let away = along.hypot(place.distance(middle) - 0.5 * self.diameter - 0.05);
                let strut = self.struts * (-0.5 * away * away / variance).exp();
                let value = if (STENT[0]..STENT[1]).contains(&at) { value + strut } else { value };
                let value = if n == 0 { -1000.0 } else { value };
                (value + NOISE * noise(&mut random)) as f32
            })
            .collect()
    }

    fn measured(&self) -> Profile {
        self.measured_in(&self.values()).unwrap()
    }

    fn measured_in(&self, values: &[f32]) -> Result<Profile> {
        let affine = DAffine3::from_scale(DVec3::new(SIDE, self.across, SIDE));
        let volume = Volume::new(Voxels::F32(values), SIZE, [1, SIZE[0], SIZE[0] * SIZE[1]], affine).unwrap();
        let line = Vessel::new([3.0, 23.0].map(|z| DVec3::new(11.7, 11.6, z)).to_vec(), None).unwrap();
        let request = MeasureRequest {
            step: 0.5,
            fwhm: None,
            wall: WallRequest::Automatic,
            tree: &[],
            stop: &|| false,
        };
        measure(&volume, &line, &request)
    }

    /// Mean error of the diameter (mm), mean standard deviation, and fraction of sections within two of them.
    fn errors(&self, profile: &Profile) -> [f64; 3] {
        let errors: Vec<f64> =
            profile.diameter_equivalent().iter().map(|diameter| diameter - self.diameter).collect();
        let count = errors.len() as f64;
        let within =
            errors.iter().zip(&profile.uncertainty).filter(|(error, told)| error.abs() <= 2.0 * **told);
        let mean = |of: &[f64]| of.iter().sum::<f64>() / count;
        [mean(&errors), mean(&profile.uncertainty), within.count() as f64 / count]
    }
}

#[test]
fn walls_in_lung_do_not_count_as_lumen() {
    for (diameter, wall) in [(4.0, 1.0), (8.0, 0.8), (14.0, 0.9)] {
        let scene = Scene { diameter, wall, ..LUNG };
        let [error, told, within] = scene.errors(&scene.measured());
        assert!(error.abs() < 0.1 && told < 0.15 && within > 0.9, "{diameter}: {error} ± {told}, {within}");
    }
}

#[test]
fn walls_in_lung_too_thin_to_be_seen_make_diameters_unsure() {
    for (diameter, wall) in [(3.4, 0.2), (8.0, 0.2), (14.0, 0.15)] {
        let scene = Scene { diameter, wall, ..LUNG };
        let profile = scene.measured();
        let [error, told, within] = scene.errors(&profile);
        assert!(error.abs() < 0.15 && within > 0.9, "{diameter}: {error} ± {told}, {within}");
        assert!((0.1..0.7).contains(&told), "{diameter}: {told}");
        assert!(profile.wall.iter().all(|[thickness, _]| thickness.is_nan()), "{diameter}");
    }
}

#[test]
fn narrow_vessels_do_not_show_their_own_blur() {
    let scene = Scene { diameter: 2.8, fwhm: 1.2, ..MUSCLE };
    let profile = scene.measured();
    assert!(matches!(&profile.fwhm_source, Source::Assumed { from } if from.contains("CT of the body")));
    assert!(matches!(Scene { diameter: 6.0, ..scene }.measured().fwhm_source, Source::Estimated { .. }));
}

#[test]
fn an_assumed_blur_is_as_unsure_as_the_diameters_that_others_would_give() {
    for (diameter, fwhm) in [(1.4, 1.1), (1.7, 0.7), (2.0, 1.15)] {
        let scene = Scene { diameter, fwhm, ..MUSCLE };
        let profile = scene.measured();
        let [error, told, within] = scene.errors(&profile);
        assert!(within > 0.9, "{diameter}: {error} ± {told}, {within}");
        assert!(profile.flags.iter().all(|flags| flags & NO_EDGE == 0));
    }
    let narrow = Scene { diameter: 1.4, ..MUSCLE }.measured();
    assert!(narrow.flags.iter().filter(|flags| *flags & AT_LIMIT > 0).count() > narrow.len() / 2);
}

#[test]
fn thin_struts_are_seen_by_their_repetition() {
    let is_metal = |scene: &Scene| -> Vec<bool> {
        scene.measured().flags.iter().map(|flags| flags & METAL > 0).collect()
    };
    for struts in [160.0, 50.0] {
        let stent = is_metal(&Scene { struts, ..FAT });
        let within = &stent[(2.0 * STENT[0]) as usize..(2.0 * STENT[1]) as usize];
        assert!(within.iter().filter(|is| **is).count() > within.len() * 9 / 10, "{struts}: {within:?}");
    }
    for scene in [FAT, Scene { diameter: 4.2, narrowed: 0.8, ..FAT }] {
        assert!(is_metal(&scene).iter().all(|is| !is), "{}", scene.narrowed);
    }
}

#[test]
fn a_vein_is_seen_although_blur_fills_the_valley() {
    let neighbors = |scene: &Scene| {
        let profile = scene.measured();
        profile.flags.iter().filter(|flags| *flags & NEIGHBOR > 0).count() as f64 / profile.len() as f64
    };
    let beside = neighbors(&Scene { vein: 180.0, ..FAT });
    assert!(beside > 0.9, "{beside}");
    for alone in [FAT, MUSCLE] {
        assert!(neighbors(&alone) < 0.05);
    }
}

#[test]
fn a_diameter_that_the_blur_leaves_unsure_is_at_the_limit() {
    let at_limit = |diameter| {
        let profile = Scene { diameter, fwhm: 1.2, ..MUSCLE }.measured();
        profile.flags.iter().filter(|flags| *flags & AT_LIMIT > 0).count() as f64 / profile.len() as f64
    };
    let [narrow, wide] = [1.55, 2.8].map(at_limit);
    assert!(narrow > 0.5 && wide < 0.1, "{narrow} {wide}");
}

#[test]
fn a_vessel_in_few_thick_slices_is_at_the_limit() {
    let at_limit = |diameter| {
        let profile = Scene { diameter, across: 3.0, ..FAT }.measured();
        profile.flags.iter().filter(|flags| *flags & AT_LIMIT > 0).count() as f64 / profile.len() as f64
    };
    assert!(at_limit(4.5) > 0.9 && at_limit(9.0) < 0.1);
}

#[test]
fn bone_in_the_corners_is_not_around_the_vessel() {
    let mut values = MUSCLE.values();
    for (n, value) in values.iter_mut().enumerate() {
        let place = DVec2::new((n % SIZE[0]) as f64, (n / SIZE[0] % SIZE[1]) as f64) * SIDE;
        if place.distance(DVec2::new(11.7, 11.6)) > 15.6 {
            *value = 1200.0;
        }
    }
    let profile = MUSCLE.measured_in(&values).unwrap();
    assert!((0..profile.len()).all(|n| profile.counts(n)));
}

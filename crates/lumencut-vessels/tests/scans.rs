//! Scans of vessels whose blurred sections are known exactly, with noise, for tests of measuring.

use glam::{DAffine3, DMat2, DMat3, DVec2, DVec3};
use lumencut_core::error::Result;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::random::Random;
use lumencut_vessels::measure::model::ellipse::{Boundary, Ellipse, Whitening};
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::section::blur::variance_of;
use lumencut_vessels::measure::wall::WallRequest;

pub const LUMEN: f64 = 310.0;
pub const TISSUE: f64 = 50.0;
pub const NOISE: f64 = 26.0;
pub const FWHM: f64 = 0.8;

/// Noise with a standard deviation of 1: sums of twelve random numbers are nearly normal.
pub fn noise(random: &mut Random) -> f64 {
    (0..12).map(|_| random.number()).sum::<f64>() - 6.0
}

pub struct Scan {
    size: [usize; 3],
    affine: DAffine3,
    values: Vec<f32>,
}

impl Scan {
    /// Voxels whose sides (mm) are the columns of a matrix; `value` gives the value at a place.
    pub fn new(size: [usize; 3], sides: DMat3, noisy: f64, value: impl Fn(DVec3) -> f64) -> Self {
        let last = DVec3::from(size.map(|n| (n - 1) as f64));
        let affine = DAffine3::from_mat3_translation(sides, -(sides * last / 2.0));
        let mut random = Random::new(5);
        let mut voxel = |n: usize| {
            let index = [n % size[0], n / size[0] % size[1], n / (size[0] * size[1])].map(|c| c as f64);
            (value(affine.transform_point3(index.into())) + noisy * noise(&mut random)) as f32
        };
        let values = (0..size.iter().product()).map(&mut voxel).collect();
        Self { size, affine, values }
    }

    pub fn volume(&self) -> Volume<'_> {
        lumencut_scenes::volumes::volume(Voxels::F32(&self.values), self.size, self.affine)
    }

    pub fn of_bytes<T>(&self, work: impl FnOnce(&Volume) -> T) -> T {
        let values: Vec<u8> = self.values.iter().map(|value| value.round() as u8).collect();
        work(&lumencut_scenes::volumes::volume(Voxels::U8(&values), self.size, self.affine))
    }
}

pub fn profile(volume: &Volume, line: Vec<DVec3>, fwhm: Option<f64>, wall: WallRequest) -> Result<Profile> {
    let request = MeasureRequest { step: 0.5, fwhm, wall, tree: &[], stop: &|| false };
    measure(volume, &Vessel::new(line, None)?, &request)
}

/// A straight vessel through the origin and the blur of its scan.
#[derive(Clone, Copy)]
pub struct Tube {
    pub along: DVec3,
    pub sides: DMat3,
    pub fwhm: f64,
}

pub const UPRIGHT: Tube = Tube { along: DVec3::Z, sides: even(0.4), fwhm: FWHM };

pub const fn even(side: f64) -> DMat3 {
    DMat3::from_diagonal(DVec3::splat(side))
}

impl Tube {
    fn across(&self) -> [DVec3; 2] {
        let first = DVec3::Y.cross(self.along).normalize();
        [first, self.along.cross(first).normalize()]
    }

    /// The share of a lumen at a place: an ellipse, blurred by the scanner and by the voxels.
    pub fn share(&self, ellipse: Ellipse) -> impl Fn(DVec3) -> f64 + use<> {
        let [u, v] = self.across();
        let inside = move |place: DVec3| DVec2::new(place.dot(u), place.dot(v));
        let columns = [self.sides.x_axis, self.sides.y_axis, self.sides.z_axis].map(inside);
        let voxel = |side: DVec2| DMat2::from_cols(side * side.x, side * side.y) * (1.0 / 12.0);
        let spread = DMat2::from_diagonal(DVec2::splat(variance_of(self.fwhm)));
        let covariance = columns.into_iter().map(voxel).fold(spread, |sum, one| sum + one);
        let boundary = Boundary::new(&ellipse, Whitening::new(covariance));
        move |place| boundary.value(inside(place))
    }

    pub fn disc(&self, diameter: f64, x: f64) -> impl Fn(DVec3) -> f64 + use<> {
        self.share(Ellipse::circle(DVec2::X * x, 0.5 * diameter))
    }

    pub fn line(&self, length: f64) -> Vec<DVec3> {
        let count = (2.0 * length) as usize;
        let at = |n: usize| length * (n as f64 / count as f64 - 0.5);
        (0..=count).map(|n| self.along.normalize() * at(n)).collect()
    }
}

pub fn mean(of: &[f64]) -> f64 {
    of.iter().sum::<f64>() / of.len() as f64
}

/// The scan and line of a vessel of 5 mm along z whose diameter is reduced in the middle over 12 mm.
pub fn narrowed(percent: f64) -> (Scan, Vec<DVec3>) {
    let lost = |z: f64| 0.5 + 0.5 * (std::f64::consts::PI * (z.abs() / 6.0).min(1.0)).cos();
    let (sides, layers) = (even(0.4), 161);
    let slice = |k: usize| {
        let z = (k as f64 - 80.0) * 0.4;
        UPRIGHT.disc(5.0 * (1.0 - percent / 100.0 * lost(z)), 0.0)
    };
    let slices: Vec<_> = (0..layers).map(slice).collect();
    let value = |place: DVec3| {
        let k = (place.z / 0.4 + 80.0).round() as usize;
        TISSUE + (LUMEN - TISSUE) * slices[k](place)
    };
    (Scan::new([33, 33, layers], sides, NOISE, value), UPRIGHT.line(60.0))
}

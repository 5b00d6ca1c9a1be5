//! Volumes of few voxels.

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::volume::{Volume, Voxels};

/// A volume whose index i varies fastest.
pub fn volume(voxels: Voxels<'_>, size: [usize; 3], world_from_index: DAffine3) -> Volume<'_> {
    Volume::new(voxels, size, [1, size[0], size[0] * size[1]], world_from_index).unwrap()
}

/// A sheared, left-handed grid centred at the origin.
pub fn sheared(size: [usize; 3]) -> DAffine3 {
    let columns =
        DMat3::from_cols(DVec3::new(0.8, 0.1, 0.0), DVec3::new(0.2, -0.7, 0.1), DVec3::new(0.3, 0.2, 1.9));
    let last = DVec3::from(size.map(|n| (n - 1) as f64));
    DAffine3::from_mat3_translation(columns, -(columns * last / 2.0))
}

/// A bright ball and rod with noise; the values lie between 0 and 1000.
pub fn ball_and_rod([ni, nj, nk]: [usize; 3]) -> Vec<i16> {
    let [x, y, z] = [ni, nj, nk].map(|n| n as f64);
    let value = |n: usize| {
        let [i, j, k] = [n % ni, n / ni % nj, n / (ni * nj)].map(|c| c as f64);
        let noise = (n * 7919 % 61) as i16;
        let ball = (i - 0.35 * x).hypot(j - 0.55 * y).hypot(k - 0.4 * z) < 0.2 * x;
        let rod = (i - 0.7 * x).hypot(k - 0.7 * z) < 0.08 * x;
        match (rod, ball) {
            (true, _) => 900 + noise,
            (_, true) => 350 + noise,
            _ => noise,
        }
    };
    (0..ni * nj * nk).map(value).collect()
}

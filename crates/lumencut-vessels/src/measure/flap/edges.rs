//! The edge of a lumen across its outline: towards the outer wall where values are half way to the level of the wall,
//! towards a flap by a fit of two blurred edges. A flap thinner than the blur never gets as dark as a wall, but its position
//! and what is missing of the light still show both edges.

use glam::DVec2;

use super::basins::{Basins, NONE};
use super::outlines::Corner;
use super::plane_map::PlaneMap;
use crate::measure::estimation::least_squares::{Normal, minimum};
use crate::measure::estimation::unit;
use crate::measure::section::rays::RAYS;
use lumencut_core::math::statistics::median;

/// The thickest flap (mm); the other lumen begins at most a blur width farther from the outline.
pub(crate) const THICKEST_MM: f64 = 3.0;

/// Expected thickness of a flap and its standard deviation (mm).
const THICKNESS: [f64; 2] = [1.0, 0.7];

/// The level of a lumen is the mean from one blur width inside its edge on, over this length (mm).
const LEVEL_MM: f64 = 3.0;

/// The outer edge lies at most this far from the outline (mm).
const NEAR_MM: f64 = 2.0;

/// Neighbouring voxels share noise, so that the samples of a fit are less certain by this factor.
const SHARED: f64 = 2.0;

/// Maximum number of steps of a fit.
const STEPS: usize = 12;

/// Corners whose edges are compared.
const AROUND: usize = 2;

/// The edge of a lumen at one corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// Distance from the outline, outwards (mm).
    pub offset: f64,
    /// Thickness of the flap behind it (mm); None at the outer wall.
    pub flap: Option<f64>,
    /// Contrast of the lumen to wall or flap.
    pub contrast: f64,
}

/// Measures the edges of a lumen.
pub(crate) struct Rim<'a> {
    pub map: &'a PlaneMap,
    pub basins: &'a Basins,
    /// The basin itself, and the one behind the flap.
    pub lumens: [u32; 2],
    /// Level of wall and flap.
    pub dark: f64,
    /// FWHM and standard deviation of the blur of the map (mm).
    pub blur: [f64; 2],
    pub noise: f64,
}

impl Rim<'_> {
    fn basin(&self, place: DVec2) -> u32 {
        self.map.nearest(place).map_or(NONE, |n| self.basins.of[n])
    }

    fn samples(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
        let step = self.map.step * 0.5;
        (0..=((to - from) / step) as usize).map(move |n| from + n as f64 * step)
    }

    /// Mean of the values of a lumen over the first `LEVEL_MM` from `start` mm on, in the direction `way`.
    fn level(&self, start: DVec2, way: DVec2, lumen: u32) -> Option<f64> {
        let places = self.samples([0.0, LEVEL_MM]).map(|mm| start + way * mm);
        let values: Vec<f64> =
            places.take_while(|place| self.basin(*place) == lumen).map(|place| self.map.at(place)).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    }

    /// The edges at all corners of an outline; None where none shows.
    pub(crate) fn edges(&self, corners: &[Corner]) -> Vec<Option<Edge>> {
        let [width, _] = self.blur;
        let level = |corner: &Corner| self.level(corner.at - corner.out * width, -corner.out, self.lumens[0]);
        let levels: Vec<Option<f64>> = corners.iter().map(level).collect();
        let edge = |n: usize| {
            let level = around(&levels, n).flatten().collect::<Vec<f64>>();
            let level = level.iter().sum::<f64>() / level.len() as f64;
            if level > self.dark { self.edge(&corners[n], level) } else { None }
        };
        let edges: Vec<Option<Edge>> = (0..corners.len()).map(edge).collect();
        (0..edges.len()).map(|n| even(&edges, n)).collect()
    }

    fn edge(&self, corner: &Corner, level: f64) -> Option<Edge> {
        let behind = self
            .samples([0.0, THICKEST_MM + self.blur[0]])
            .find(|mm| self.basin(corner.at + corner.out * *mm) == self.lumens[1]);
        match behind {
            Some(behind) => self.flap(corner, level, behind),
            None => self.outer(corner, level),
        }
    }

    fn outer(&self, corner: &Corner, level: f64) -> Option<Edge> {
        let half = f64::midpoint(level, self.dark);
        let all: Vec<f64> = self.samples([-NEAR_MM, NEAR_MM]).collect();
        let value = |n: usize| self.map.at(corner.at + corner.out * all[n]);
        let falls = (1..all.len()).filter(|n| value(n - 1) >= half && value(*n) < half);
        let n = falls.min_by(|a, b| all[*a].abs().total_cmp(&all[*b].abs()))?;
        let (before, here) = (value(n - 1), value(n));
        let offset = all[n] - (half - here) / (before - here) * (all[n] - all[n - 1]);
        Some(Edge { offset, flap: None, contrast: level - self.dark })
    }

    /// Fits position and thickness of a flap between two levels; the other lumen begins `behind` mm away.
    fn flap(&self, corner: &Corner, level: f64, behind: f64) -> Option<Edge> {
        let [width, deviation] = self.blur;
        let start = corner.at + corner.out * (behind + width);
        let other = self.level(start, corner.out, self.lumens[1])?;
        let contrasts = [level - self.dark, other - self.dark];
        if contrasts[1] <= 0.0 {
            return None;
        }
        let samples: Vec<[f64; 2]> = self
            .samples([-1.5 * width, behind + 1.5 * width])
            .map(|mm| [mm, self.map.at(corner.at + corner.out * mm) - self.dark])
            .collect();
        let unsure = SHARED * self.noise;
        let evaluate = |at: &[f64; 2]| {
            (at[1] > 0.0).then_some(())?;
            let mut normal = Normal { cost: 0.0, matrix: [[0.0; 2]; 2], slope: [0.0; 2] };
            for [mm, value] in &samples {
                let ends = [(at[0] - mm) / deviation, (mm - at[0] - at[1]) / deviation];
                let missing = value - contrasts[0] * step(ends[0]) - contrasts[1] * step(ends[1]);
                let slopes = [contrasts[0] * bell(ends[0]), contrasts[1] * bell(ends[1])];
                let by = [(slopes[0] - slopes[1]) / deviation, -slopes[1] / deviation];
                normal.expect(&by, missing, unsure);
            }
            normal.expect(&unit(1), THICKNESS[0] - at[1], THICKNESS[1]);
            Some(normal)
        };
        let first = [0.5 * behind - 0.5 * THICKNESS[0], THICKNESS[0]];
        let [offset, thickness] = minimum(first, STEPS, evaluate)?.at;
        let is_near = offset.abs() < NEAR_MM + THICKEST_MM && thickness < THICKEST_MM;
        is_near.then_some(Edge { offset, flap: Some(thickness), contrast: contrasts[0] })
    }
}

fn around<T: Copy>(all: &[T], n: usize) -> impl Iterator<Item = T> {
    (0..=2 * AROUND).map(move |m| all[(n + m + RAYS - AROUND) % RAYS])
}

/// The median of the edges of the same kind around a corner.
fn even(edges: &[Option<Edge>], n: usize) -> Option<Edge> {
    let own = edges[n].or_else(|| around(edges, n).flatten().next())?;
    let alike: Vec<Edge> =
        around(edges, n).flatten().filter(|edge| edge.flap.is_some() == own.flap.is_some()).collect();
    let offset = median(&mut alike.iter().map(|edge| edge.offset).collect::<Vec<f64>>())?;
    let flap = median(&mut alike.iter().filter_map(|edge| edge.flap).collect::<Vec<f64>>());
    Some(Edge { offset, flap, ..own })
}

/// The integral of [`bell`]. The cubic in the hyperbolic tangent is exact to 0.0003 (Page 1977, doi:10.2307/2346872).
fn step(away: f64) -> f64 {
    0.5 * (1.0 + (0.797_884_56 * (away + 0.044_715 * away.powi(3))).tanh())
}

fn bell(away: f64) -> f64 {
    0.398_942_28 * (-0.5 * away * away).exp()
}

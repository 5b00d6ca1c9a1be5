//! Synthetic profiles for tests.

use std::f64::consts::PI;

use glam::DVec3;

use crate::measure::flap::found::Flap;
use crate::measure::outer::found::OuterWall;
use crate::measure::profile::{Profile, Source};
use crate::measure::uncertainty::Parts;
use crate::measure::wall::WallSource;

/// A profile of circular sections with these diameters and uncertainties (mm), 0.5 mm apart.
pub fn profile(sections: &[[f64; 2]]) -> Profile {
    let count = sections.len();
    let numbers = |of: &dyn Fn(&[f64; 2]) -> f64| sections.iter().map(of).collect::<Vec<_>>();
    let diameter = numbers(&|[diameter, _]| *diameter);
    Profile {
        arc_length: (0..count).map(|n| 0.5 * n as f64).collect(),
        diameter_min: diameter.clone(),
        diameter_max: diameter,
        area: numbers(&|[diameter, _]| PI * diameter * diameter / 4.0),
        uncertainty: numbers(&|[_, uncertainty]| *uncertainty),
        uncertainty_parts: sections
            .iter()
            .map(|[_, uncertainty]| Parts { noise: *uncertainty, ..Parts::default() })
            .collect(),
        wall: vec![[f64::NAN; 2]; count],
        diameter_outer: vec![[f64::NAN; 2]; count],
        outer_wall: vec![OuterWall::Thin; count],
        outer_contour: vec![Vec::new(); count],
        flap: vec![Flap::Absent; count],
        own_lumen: vec![Vec::new(); count],
        other_lumen: vec![Vec::new(); count],
        area_own_lumen: vec![[f64::NAN; 2]; count],
        area_other_lumen: vec![[f64::NAN; 2]; count],
        bounds: vec![[f64::NAN; 2]; count],
        at_most: vec![f64::NAN; count],
        flags: vec![0; count],
        center: vec![DVec3::ZERO; count],
        normal: vec![DVec3::Z; count],
        axes: vec![[DVec3::X, DVec3::Y]; count],
        contour: vec![Vec::new(); count],
        half_axes: vec![[DVec3::ZERO; 2]; count],
        inscribed_radius: vec![0.0; count],
        levels: vec![[300.0, 50.0]; count],
        noise: 10.0,
        fwhm: 1.0,
        fwhm_deviation: 0.0,
        fwhm_source: Source::Given,
        wall_source: WallSource::NotAsked,
        on_vessel: vec![DVec3::ZERO; count],
        line_values: vec![300.0; count],
        without_wall: Vec::new(),
    }
}

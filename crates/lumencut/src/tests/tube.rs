//! The profile of a synthetic tube.

use glam::DVec3;
use lumencut_vessels::measure::flap::found::Flap;
use lumencut_vessels::measure::outer::found::OuterWall;
use lumencut_vessels::measure::profile::{Profile, Source};
use lumencut_vessels::measure::section::flags::{BRANCH, CALCIUM};
use lumencut_vessels::measure::uncertainty::Parts;
use lumencut_vessels::measure::wall::WallSource;

/// A 60 mm tube that is 8 mm wide and 4 mm in its middle, with calcium at 20 mm and a branch on its last 10 mm.
pub(crate) fn tube() -> Profile {
    let at: Vec<f64> = (0..=120).map(|n| f64::from(n) / 2.0).collect();
    let numbers = |of: &dyn Fn(f64) -> f64| at.iter().map(|at| of(*at)).collect::<Vec<_>>();
    let diameter = |at: f64| if (at - 30.0).abs() < 4.0 { 4.0 } else { 8.0 };
    let flags = |at: f64| match at {
        at if at > 50.0 => BRANCH,
        20.0 => CALCIUM,
        _ => 0,
    };
    let count = at.len();
    Profile {
        diameter_min: numbers(&|at| 0.9 * diameter(at)),
        diameter_max: numbers(&|at| 1.1 * diameter(at)),
        area: numbers(&|at| std::f64::consts::PI * diameter(at).powi(2) / 4.0),
        uncertainty: vec![0.1; count],
        uncertainty_parts: vec![Parts { noise: 0.1, ..Parts::default() }; count],
        wall: vec![[f64::NAN; 2]; count],
        diameter_outer: vec![[f64::NAN; 2]; count],
        outer_wall: vec![OuterWall::Thin; count],
        outer_contour: vec![Vec::new(); count],
        flap: vec![Flap::Absent; count],
        own_lumen: vec![Vec::new(); count],
        other_lumen: vec![Vec::new(); count],
        area_own_lumen: vec![[f64::NAN; 2]; count],
        area_other_lumen: vec![[f64::NAN; 2]; count],
        bounds: at.iter().map(|at| if *at == 20.0 { [7.0, 9.0] } else { [f64::NAN; 2] }).collect(),
        at_most: vec![f64::NAN; count],
        flags: at.iter().map(|at| flags(*at)).collect(),
        center: at.iter().map(|at| DVec3::Z * *at).collect(),
        normal: vec![DVec3::Z; count],
        axes: vec![[DVec3::X, DVec3::Y]; count],
        contour: vec![Vec::new(); count],
        half_axes: vec![[DVec3::X; 2]; count],
        inscribed_radius: vec![4.0; count],
        levels: vec![[300.0, 50.0]; count],
        noise: 10.0,
        fwhm: 1.2,
        fwhm_deviation: 0.0,
        fwhm_source: Source::Given,
        wall_source: WallSource::NotAsked,
        on_vessel: at.iter().map(|at| DVec3::Z * *at).collect(),
        line_values: vec![300.0; count],
        without_wall: Vec::new(),
        arc_length: at,
    }
}

//! Ties around joints. If vessels end in one point, their keys are equal around it, so rounding decides which
//! vessel a pixel shows. Either vessel is accepted, in few pixels and only there.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::pictures::depth_of;
use lumencut_scenes::tolerances::TIED;

/// Half-width of the depth filter (pixels).
const FILTER_HALF_WIDTH: usize = 3;

struct End {
    point: DVec3,
    place: DVec2,
    /// Distance from the end point up to which lumen and wall reach (mm).
    reach: f64,
    vessel: i32,
}

fn ends(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Vec<End> {
    let wall = if settings.lumen_first { settings.lumen_margin } else { 0.0 };
    let end = |vessel: usize, i: usize| {
        let point = tree.vessels()[vessel].points()[i];
        let reach = tree.vessels()[vessel].radius_or_zero(i) + wall;
        End { point, place: camera.view_from_world(point).truncate(), reach, vessel: vessel as i32 }
    };
    let vessels = tree.vessels().iter().enumerate();
    vessels.flat_map(|(id, vessel)| [0, vessel.points().len() - 1].map(|i| end(id, i))).collect()
}

/// Whether two vessels end in one point, around which both have lumen or wall at a position.
fn is_tied(ends: &[End], place: DVec2, vessels: [i32; 2]) -> bool {
    let [a, b] = vessels.map(|vessel| {
        ends.iter().filter(move |end| end.vessel == vessel && end.place.distance(place) < end.reach)
    });
    b.clone().any(|b| a.clone().any(|a| a.point == b.point))
}

fn around(p: usize, [width, height]: [usize; 2]) -> impl Iterator<Item = usize> {
    let near =
        |at: usize, end: usize| at.saturating_sub(FILTER_HALF_WIDTH)..(at + FILTER_HALF_WIDTH + 1).min(end);
    near(p / width, height).flat_map(move |y| near(p % width, width).map(move |x| y * width + x))
}

/// Replaces the GPU's vessels by the CPU's where vessels tie. Around ties it also replaces depths, if the
/// filter within zones used other neighbours and the depths differ by less than a leap.
///
/// # Panics
/// For more pixels than [`TIED`] allows.
pub(crate) fn excuse(gpu: &mut Frame, cpu: &Frame, tree: &VesselTree, settings: &Settings) {
    let (Some(camera), size) = (cpu.geometry.camera(), cpu.size()) else { return };
    let ends = ends(tree, camera, settings);
    let place = |p: usize| DVec2::new(camera.view_x(p % size[0]), camera.view_y(p / size[0]));
    let differs = |p: &usize| gpu.vessel[*p] != cpu.vessel[*p];
    let is_tie = |p: &usize| differs(p) && is_tied(&ends, place(*p), [gpu.vessel[*p], cpu.vessel[*p]]);
    let tied: Vec<usize> = (0..gpu.vessel.len()).filter(is_tie).collect();
    let mut excused: BTreeSet<usize> = tied.iter().copied().collect();
    for p in &tied {
        gpu.vessel[*p] = cpu.vessel[*p];
    }
    if settings.depth_filter && settings.zone_filter {
        let leap = settings.depth_leap as f32;
        for q in tied.iter().flat_map(|p| around(*p, size)) {
            let (found, expected) = (&mut depth_of(gpu)[q], cpu.depth()[q]);
            if *found != expected && (*found - expected).abs() < leap {
                *found = expected;
                excused.insert(q);
            }
        }
    }
    let count = excused.len();
    assert!(TIED.allows(count, cpu.vessel.len()), "{count} of {} pixels are said to tie", cpu.vessel.len());
}

mod tests {
    use lumencut_core::pipeline::{CpuRenderer, Request};
    use lumencut_core::scene::Scene;
    use lumencut_phantom::y_junction;
    use lumencut_scenes::compare::assert_equal;
    use lumencut_scenes::views::{front, pixel};

    use super::*;

    /// Whether a frame of three vessels that end in the middle of the view is still rejected after `change`,
    /// when its ties are excused.
    fn is_refused(settings: &Settings, change: impl Fn(&mut Frame)) -> bool {
        let (tree, camera) = (y_junction().unwrap().tree, front([96, 80], 0.8));
        let scene = Scene::default().with_tree(tree.clone());
        let cpu = CpuRenderer::default().render(&scene, &Request::new(&camera, settings)).unwrap();
        let mut changed = cpu.clone();
        change(&mut changed);
        let judge = || {
            excuse(&mut changed, &cpu, &tree, settings);
            assert_equal(&changed, &cpu);
        };
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(judge)).is_err()
    }

    fn square(frame: &Frame, x: f64, y: f64, count: usize) -> Vec<usize> {
        let corner = pixel(frame, x, y);
        (0..count * count).map(|n| corner + n / count * frame.size()[0] + n % count).collect()
    }

    fn turn(frame: &mut Frame, pixels: &[usize], deeper: f32) {
        for p in pixels {
            frame.vessel[*p] = (frame.vessel[*p] + 1) % 3;
            depth_of(frame)[*p] += deeper;
        }
    }

    #[test]
    fn vessels_that_tie_around_a_joint_are_excused() {
        let at_the_joint = |frame: &mut Frame| {
            let pixels = square(frame, -1.2, 1.2, 4);
            turn(frame, &pixels, 0.3);
        };
        assert!(!is_refused(&Settings::default(), at_the_joint));
        let unfiltered = Settings { depth_filter: false, ..Settings::default() };
        assert!(is_refused(&unfiltered, at_the_joint), "what ties has the same depth before a filter");
    }

    #[test]
    fn differences_elsewhere_are_no_ties() {
        for (x, y) in [(16.0, -3.0), (0.4, -20.0), (-13.0, 20.0), (30.0, 25.0)] {
            for deeper in [0.0, 0.3] {
                let elsewhere = |frame: &mut Frame| {
                    let pixels = square(frame, x, y, 4);
                    turn(frame, &pixels, deeper);
                };
                assert!(is_refused(&Settings::default(), elsewhere), "at {x}, {y}");
            }
        }
    }

    #[test]
    fn a_tie_excuses_no_leap_and_no_depth_that_is_not_beside_it() {
        let far_off = |frame: &mut Frame| {
            let pixels = square(frame, -1.2, 1.2, 4);
            turn(frame, &pixels, 5.0);
        };
        assert!(is_refused(&Settings::default(), far_off));
        let beside = |frame: &mut Frame| {
            let tied = square(frame, -1.2, 1.2, 1);
            turn(frame, &tied, 0.0);
            for p in square(frame, 8.0, 8.0, 4) {
                depth_of(frame)[p] += 0.3;
            }
        };
        assert!(is_refused(&Settings::default(), beside));
        let no_vessel = |frame: &mut Frame| {
            for p in square(frame, -1.2, 1.2, 4) {
                depth_of(frame)[p] += 0.3;
            }
        };
        assert!(is_refused(&Settings::default(), no_vessel), "a depth alone is no tie");
    }

    #[test]
    fn ties_of_too_many_pixels_are_refused() {
        let everywhere = |frame: &mut Frame| {
            let pixels: Vec<usize> = (0..frame.vessel.len()).collect();
            turn(frame, &pixels, 0.0);
        };
        let wide = Settings { lumen_margin: 100.0, ..Settings::default() };
        assert!(is_refused(&wide, everywhere));
    }
}

//! Times of the cut surface (projection, distance and depth at all levels), compared with brute force.

use glam::DVec3;
use lumencut_core::brute_force;
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::math::centerline_smoothing::smooth_centerlines;
use lumencut_core::math::lanes::Isa;
use lumencut_core::math::statistics::median;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::LeveledTree;
use lumencut_core::settings::{LevelChoice, Settings};
use lumencut_core::stages::depth::{DepthImages, depth};
use lumencut_core::stages::distance::distance;
use lumencut_core::stages::levels::levels;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::timing::{Times, head, row, time};
use lumencut_scenes::trees::finer;
use lumencut_scenes::views::fitted;

struct Buffers {
    distance: Vec<f32>,
    depth: Vec<f32>,
    vessel: Vec<i32>,
}

fn buffers() -> Buffers {
    Buffers { distance: vec![0.0; 512 * 512], depth: vec![0.0; 512 * 512], vessel: vec![0; 512 * 512] }
}

impl Buffers {
    fn written(&mut self) -> (&[f32], DepthImages<'_>) {
        (
            &self.distance,
            DepthImages {
                depth: &mut self.depth,
                vessel: &mut self.vessel,
                sheet: &mut [],
                blend: &mut [],
                foot: &mut [],
            },
        )
    }
}

fn cut_surface(
    renderer: &mut CpuRenderer,
    camera: &Camera,
    settings: &Settings,
    runs: usize,
) -> (Times, Buffers) {
    let mut b = buffers();
    let request = Request::new(camera, settings);
    let times = time(runs, || {
        renderer.project(camera, settings);
        let pass = renderer.pass(&request);
        let far = match settings.level_choice {
            LevelChoice::Nearest => distance(&pass.work, &pass.surface, &mut b.distance),
            LevelChoice::Own => Ok(()),
        };
        let (distance, images) = b.written();
        let done = far.and_then(|()| depth(&pass.work, &pass.surface, distance, images));
        done.expect("nobody asks to stop");
    });
    (times, b)
}

fn by_brute_force(renderer: &CpuRenderer, camera: &Camera, settings: &Settings) -> (Times, Buffers) {
    let mut b = buffers();
    let request = Request::new(camera, settings);
    let pass = renderer.pass(&request);
    let times = time(3, || {
        let far = match settings.level_choice {
            LevelChoice::Nearest => brute_force::distance(&pass.work, &pass.surface, &mut b.distance),
            LevelChoice::Own => Ok(()),
        };
        let (distance, images) = b.written();
        let done = far.and_then(|()| brute_force::depth(&pass.work, &pass.surface, distance, images));
        done.expect("nobody asks to stop");
    });
    (times, b)
}

/// Three views: the tree fits the image, the tree fits 128 pixels, one vessel fills the image.
fn zooms(tree: &VesselTree) -> Result<[(&'static str, Camera); 3]> {
    let fit = fitted(tree, DVec3::new(0.1, 1.0, 0.2), 512);
    let first = tree.vessels()[0].points();
    let seen = |center, spacing| Camera::new(center, fit.direction(), fit.up(), fit.size(), spacing);
    let away = seen(fit.center(), fit.pixel_spacing() * 4.0)?;
    Ok([("fits", fit), ("in 128 pixels", away), ("one vessel", seen(first[first.len() / 2], 0.02)?)])
}

fn against_brute_force(name: &str, tree: &VesselTree, sets: &[Isa]) -> Result<()> {
    let nearest = Settings { level_choice: LevelChoice::Nearest, ..Settings::default() };
    let rules =
        [("default", Settings::default()), ("paper's", Settings::paper()), ("lumen first, nearest", nearest)];
    let leveled = LeveledTree::new(tree.clone());
    for (zoom, camera) in zooms(tree)? {
        // The other rules and instruction sets are timed only for the view that shows the entire tree.
        let fits = zoom == "fits";
        for (rule, settings) in rules.iter().take(if fits { rules.len() } else { 1 }) {
            for &isa in if fits { sets } else { &sets[sets.len() - 1..] } {
                let mut renderer = CpuRenderer::new(isa);
                renderer.prepare(&leveled, settings);
                let (fast, a) = cut_surface(&mut renderer, &camera, settings, 31);
                let (slow, b) = by_brute_force(&renderer, &camera, settings);
                let same = a.depth == b.depth && a.vessel == b.vessel && a.distance == b.distance;
                row([
                    name.to_owned(),
                    tree.segment_count().to_string(),
                    (*rule).to_owned(),
                    zoom.to_owned(),
                    format!("{isa:?}"),
                    format!("{:.2}", fast.median),
                    format!("{:.2}", fast.minimum),
                    format!("{:.1}", slow.median),
                    format!("{:.0}", slow.median / fast.median),
                    if same { "equal" } else { "DIFFERENT" }.to_owned(),
                ]);
            }
        }
    }
    Ok(())
}

/// Compares the longest time of all view directions with the median.
fn over_directions(name: &str, tree: &VesselTree) {
    let (mut renderer, settings) = (CpuRenderer::default(), Settings::default());
    renderer.prepare(&LeveledTree::new(tree.clone()), &settings);
    let golden = 2.399_963;
    let mut times: Vec<f64> = (0..50)
        .map(|n| {
            let z = 1.0 - (f64::from(n) + 0.5) / 25.0;
            let (sin, cos) = (golden * f64::from(n)).sin_cos();
            let direction = DVec3::new(cos * (1.0 - z * z).sqrt(), sin * (1.0 - z * z).sqrt(), z);
            let camera = fitted(tree, direction, 512);
            cut_surface(&mut renderer, &camera, &settings, 5).0.minimum
        })
        .collect();
    let worst = times.iter().copied().fold(0.0, f64::max);
    let median = median(&mut times).unwrap_or(f64::NAN);
    row([name.to_owned(), format!("{median:.2}"), format!("{worst:.2}"), format!("{:.2}", worst / median)]);
}

fn main() -> Result<()> {
    let small = random_tree(7, 31, 160, 1.5, 150.0)?;
    let resampled = finer(&small);
    let many = random_tree(7, 124, 160, 1.5, 150.0)?;
    head(
        "Cut surface, 512 × 512, all levels (ms)",
        &[
            "tree",
            "segments",
            "rule",
            "tree in the image",
            "set",
            "median",
            "minimum",
            "brute force",
            "ratio",
            "pixels",
        ],
    );
    against_brute_force("31 vessels", &small, &Isa::available())?;
    against_brute_force("31 vessels, 4 times as finely sampled", &resampled, &[Isa::widest()])?;
    against_brute_force("124 vessels", &many, &[Isa::widest()])?;
    head("Over 50 directions (ms)", &["tree", "median", "worst", "ratio"]);
    over_directions("31 vessels", &small);
    over_directions("124 vessels", &many);
    let long = random_tree(3, 100, 199, 1.0, 200.0)?;
    let made = time(11, || drop(levels(&long, 6)));
    head("Levels of detail of 20,000 points (ms)", &["what", "median"]);
    row(["the levels".to_owned(), format!("{:.2}", made.median)]);
    for radii in [0.5, 10.0] {
        let smoothed = time(11, || drop(smooth_centerlines(&long, radii)));
        row([format!("smoothing by {radii} radii before them"), format!("{:.2}", smoothed.median)]);
    }
    Ok(())
}

//! Times of mpCPR, CR and the cut surface at 512 × 512 pixels: the workloads from the front, without context.

use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::reformations::cr::{CrParameters, cr};
use lumencut_core::reformations::mpcpr::mpcpr;
use lumencut_core::scene::{LeveledTree, Scene, SharedVolume};
use lumencut_core::settings::Settings;
use lumencut_phantom::Phantom;
use lumencut_scenes::timing::{head, row, time};
use lumencut_scenes::views::fitted;
use lumencut_scenes::workloads::{ASKED, WORKLOADS};

const RUNS: usize = 31;

type Find<'a> = &'a dyn Fn(&LeveledTree, &Request) -> Result<Frame>;

/// Median and shortest time (ms) of finding the positions, and of the complete picture.
fn times(volume: &SharedVolume, tree: &LeveledTree, request: &Request, find: Find) -> [String; 2] {
    let renderer = CpuRenderer::default();
    let found = || find(tree, request).expect("a frame");
    let cell = |times: lumencut_scenes::timing::Times| format!("{:.2} ({:.2})", times.median, times.minimum);
    let places = time(RUNS, || drop(found()));
    let picture = time(RUNS, || drop(renderer.look(volume, found(), request).expect("a picture")));
    [cell(places), cell(picture)]
}

fn compare(name: &str, phantom: &Phantom) -> Result<()> {
    let scene = Scene::new(phantom.volume()?, phantom.tree.clone());
    let (Some(volume), Some(tree)) = (&scene.volume, &scene.tree) else { return Ok(()) };
    let camera = fitted(&phantom.tree, DVec3::Y, 512);
    let settings = Settings { context: None, ..Settings::default() };
    let request = Request { images: ASKED, ..Request::new(&camera, &settings) };
    let mut renderer = CpuRenderer::default();
    let surface = Scene { volume: None, ..scene.clone() };
    let with_leaps = ASKED.and(lumencut_core::stages::ImageSet::of(&[lumencut_core::stages::Image::Leap]));
    let cut = Request { images: with_leaps, ..request };
    let csr = time(RUNS, || drop(renderer.render(&surface, &cut).expect("a cut surface")));
    let whole = time(RUNS, || drop(renderer.render(&scene, &request).expect("a picture")));
    let cell = |times: lumencut_scenes::timing::Times| format!("{:.2} ({:.2})", times.median, times.minimum);
    row([name.to_owned(), "CSR".to_owned(), cell(csr), cell(whole)]);
    let [places, picture] = times(volume, tree, &request, &mpcpr);
    row([name.to_owned(), "mpCPR".to_owned(), places, picture]);
    for (radius_offset, arc_threshold) in [(0.0, 150.0), (50.0, 150.0), (150.0, 300.0)] {
        let parameters = CrParameters { radius_offset, arc_threshold };
        let [places, picture] =
            times(volume, tree, &request, &|tree, request| cr(tree, &parameters, request));
        row([name.to_owned(), format!("CR, {radius_offset} and {arc_threshold} pixels"), places, picture]);
    }
    Ok(())
}

fn main() -> Result<()> {
    head(
        "Median and, in brackets, fastest milliseconds",
        &["workload", "method", "where the pixels look", "the whole picture"],
    );
    for (name, make) in WORKLOADS {
        compare(name, &make(0, 1.0)?)?;
    }
    Ok(())
}

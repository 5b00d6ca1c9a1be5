//! Table 2 of the paper: each stage on the three workloads, 512 × 512 pixels, beside the paper's figures.
//!
//! `cargo bench -p lumencut-core --bench workloads`

use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_phantom::Phantom;
use lumencut_scenes::timing::{StageTimes, head, once, row, stage_medians};
use lumencut_scenes::views::fitted;
use lumencut_scenes::workloads::{PAPER_STAGES, PaperStage, WORKLOADS};

/// The median milliseconds of each stage of 31 views from the front.
fn stages(phantom: &Phantom) -> Result<StageTimes> {
    let scene = Scene::new(phantom.volume()?, phantom.tree.clone());
    let camera = fitted(&phantom.tree, DVec3::Y, 512);
    let mut renderer = CpuRenderer::default();
    let settings = Settings { context: None, ..Settings::default() };
    stage_medians(31, || renderer.render(&scene, &Request::new(&camera, &settings)))
}

fn main() -> Result<()> {
    let mut ours = Vec::new();
    head("Workloads", &["workload", "voxels", "segments", "made in (s)"]);
    for (name, make) in WORKLOADS {
        let (milliseconds, phantom) = once(|| make(0, 1.0));
        let (seconds, phantom) = (milliseconds / 1e3, phantom?);
        let voxels = phantom.size.map(|n| n.to_string()).join(" × ");
        row([name, &voxels, &phantom.tree.segment_count().to_string(), &format!("{seconds:.1}")]);
        ours.push(stages(&phantom)?);
    }
    head(
        "Table 2: milliseconds per stage, ours / paper",
        &["stage", "paper's name", "aorta (Fig. 1)", "runoff (Fig. 7)", "cervical (Fig. 8)"],
    );
    for PaperStage { stage, papers_name, milliseconds } in PAPER_STAGES {
        let cell = |w: usize| match milliseconds[w] {
            0.0 => format!("{:.2}", ours[w][stage]),
            paper => format!("{:.2} / {paper}", ours[w][stage]),
        };
        row([stage.to_owned(), papers_name.to_owned(), cell(0), cell(1), cell(2)]);
    }
    let frame = |w: usize| format!("{:.2}", ours[w]["frame"]);
    row(["frame without context".to_owned(), String::new(), frame(0), frame(1), frame(2)]);
    Ok(())
}

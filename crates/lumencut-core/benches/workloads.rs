//! Times of each stage on the three workloads at 512 × 512 pixels, beside those in Table 2 of the paper.

use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_phantom::Phantom;
use lumencut_scenes::timing::{StageTimes, head, once, row, stage_medians};
use lumencut_scenes::views::fitted;
use lumencut_scenes::workloads::{ASKED, PAPER_STAGES, PaperStage, WORKLOADS};

/// Median times (ms) of each stage over 31 frontal views without context: by default rules, by paper's rules.
fn stages(phantom: &Phantom) -> Result<[StageTimes; 2]> {
    let scene = Scene::new(phantom.volume()?, phantom.tree.clone());
    let camera = fitted(&phantom.tree, DVec3::Y, 512);
    let mut renderer = CpuRenderer::default();
    let mut of = |rules: Settings| {
        let settings = Settings { context: None, ..rules };
        let request = Request { images: ASKED, ..Request::new(&camera, &settings) };
        stage_medians(31, || renderer.render(&scene, &request))
    };
    Ok([of(Settings::default())?, of(Settings::paper())?])
}

fn cell(times: &[StageTimes; 2], stage: &str, paper: f64) -> String {
    let [own, papers] =
        times.each_ref().map(|times| times.get(stage).map_or("–".to_owned(), |time| format!("{time:.2}")));
    if paper > 0.0 { format!("{own} · {papers} · {paper}") } else { format!("{own} · {papers}") }
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
        "Table 2: milliseconds per stage, default rules · paper's rules · the paper's own figures",
        &["stage", "paper's name", "aorta (Fig. 1)", "runoff (Fig. 7)", "cervical (Fig. 8)"],
    );
    for PaperStage { stage, papers_name, milliseconds } in PAPER_STAGES {
        let [a, b, c] = [0, 1, 2].map(|w| cell(&ours[w], stage, milliseconds[w]));
        row([stage, papers_name, &a, &b, &c]);
    }
    let [a, b, c] = [0, 1, 2].map(|w| cell(&ours[w], "frame", 0.0));
    row(["frame without context", "", &a, &b, &c]);
    Ok(())
}

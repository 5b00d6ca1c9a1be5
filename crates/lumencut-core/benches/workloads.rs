//! Table 2 of the paper: each stage on the three workloads, 512 × 512 pixels, beside the paper's figures.
//!
//! `cargo bench -p lumencut-core --bench workloads`

mod common;

use std::collections::BTreeMap;
use std::time::Instant;

use common::{fitted, head, row};
use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::phantom::{Phantom, aorta, cervical, runoff};
use lumencut_core::pipeline::Renderer;
use lumencut_core::settings::Settings;

/// Stage of ours and the paper's milliseconds for Fig. 1, 7 and 8 (GeForce GTX 680).
const STAGES: [(&str, &str, [f64; 3]); 7] = [
    ("projection", "", [0.0; 3]),
    ("distance", "LOD estimation", [97.8, 272.6, 133.0]),
    ("depth", "depth", [13.5, 105.6, 39.0]),
    ("depth_filter", "depth filter", [1.7, 1.7, 1.7]),
    ("surface", "surface", [0.9, 1.0, 1.1]),
    ("silhouette", "silhouettes", [7.6, 7.7, 7.7]),
    ("composite", "", [0.0; 3]),
];

/// Makes a workload from a seed and a scale.
type Maker = fn(u64, f64) -> Result<Phantom>;

/// The median milliseconds of each stage of 31 views from the front.
fn stages(phantom: &Phantom) -> Result<BTreeMap<&'static str, f64>> {
    let volume = phantom.volume()?;
    let camera = fitted(&phantom.tree, DVec3::Y);
    let mut renderer = Renderer::new(phantom.tree.clone());
    let settings = Settings { context: None, ..Settings::default() };
    let mut all: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    for run in 0..32 {
        let start = Instant::now();
        let frame = renderer.render(&volume, &camera, &settings, &|| false)?;
        let frame_time = start.elapsed().as_secs_f64() * 1e3;
        // The first view makes the levels and warms the caches.
        if run > 0 {
            frame.timings.iter().for_each(|t| all.entry(t.stage).or_default().push(t.milliseconds));
            all.entry("frame").or_default().push(frame_time);
        }
    }
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    Ok(all.into_iter().map(|(stage, times)| (stage, median(times))).collect())
}

fn main() -> Result<()> {
    let makers: [(&str, Maker); 3] = [("aorta", aorta), ("runoff", runoff), ("cervical", cervical)];
    let mut ours = Vec::new();
    head("Workloads", &["workload", "voxels", "segments", "made in (s)"]);
    for (name, make) in makers {
        let start = Instant::now();
        let phantom = make(0, 1.0)?;
        let seconds = start.elapsed().as_secs_f64();
        let voxels = phantom.size.map(|n| n.to_string()).join(" × ");
        row([name, &voxels, &phantom.tree.segment_count().to_string(), &format!("{seconds:.1}")]);
        ours.push(stages(&phantom)?);
    }
    head(
        "Table 2: milliseconds per stage, ours / paper",
        &["stage", "paper's name", "aorta (Fig. 1)", "runoff (Fig. 7)", "cervical (Fig. 8)"],
    );
    for (stage, theirs, paper) in STAGES {
        let cell = |w: usize| match paper[w] {
            0.0 => format!("{:.2}", ours[w][stage]),
            paper => format!("{:.2} / {paper}", ours[w][stage]),
        };
        row([stage.to_owned(), theirs.to_owned(), cell(0), cell(1), cell(2)]);
    }
    let frame = |w: usize| format!("{:.2}", ours[w]["frame"]);
    row(["frame without context".to_owned(), String::new(), frame(0), frame(1), frame(2)]);
    Ok(())
}

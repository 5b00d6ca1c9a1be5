//! The three scenes of clinical size, with the paper's timings (Table 2, Fig. 1, 7 and 8, 512 × 512 pixels, GeForce GTX 680).

use lumencut_core::error::Result;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_phantom::{Phantom, aorta, cervical, runoff};

/// A function that makes a workload from seed and scale.
pub type Maker = fn(u64, f64) -> Result<Phantom>;

/// The workloads by name, in the order of the paper's figures.
pub const WORKLOADS: [(&str, Maker); 3] = [("aorta", aorta), ("runoff", runoff), ("cervical", cervical)];

/// A stage, and its times in the paper.
#[derive(Clone, Copy, Debug)]
pub struct PaperStage {
    pub stage: &'static str,
    /// Name of the stage in the paper; may be empty.
    pub papers_name: &'static str,
    /// The paper's time for each workload (ms); 0 if not published.
    pub milliseconds: [f64; 3],
}

/// The stages of a frame without context.
pub const PAPER_STAGES: [PaperStage; 8] = [
    paper_stage("projection", "", [0.0; 3]),
    paper_stage("distance", "LOD estimation", [97.8, 272.6, 133.0]),
    paper_stage("depth", "depth", [13.5, 105.6, 39.0]),
    paper_stage("leap", "", [0.0; 3]),
    paper_stage("depth_filter", "depth filter", [1.7; 3]),
    paper_stage("surface", "surface", [0.9, 1.0, 1.1]),
    paper_stage("silhouette", "silhouettes", [7.6, 7.7, 7.7]),
    paper_stage("composite", "", [0.0; 3]),
];

/// The images requested by default. Distance is computed only if the view needs it.
pub const ASKED: ImageSet = ImageSet::ALL.without(Image::Distance);

/// The paper's times of complete frames with MIDA context (ms).
pub const PAPER_FRAMES: [f64; 3] = [218.0, 659.0, 314.0];

const fn paper_stage(stage: &'static str, papers_name: &'static str, milliseconds: [f64; 3]) -> PaperStage {
    PaperStage { stage, papers_name, milliseconds }
}

//! Stages that the CPU computes instead of the GPU, to find the stage that causes a difference.

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::pipeline::CpuRenderer;
use lumencut_core::stages::Stage;

/// The stages that the CPU can compute instead of the GPU: all that write images. In a browser it computes none, so
/// that a page need not load the CPU's kernels.
pub(crate) fn on_either() -> impl Iterator<Item = Stage> {
    Stage::ALL.into_iter().filter(|stage| !stage.writes().is_empty())
}

#[derive(Debug, Default)]
pub(crate) struct OnCpu {
    stages: Vec<Stage>,
    pub renderer: CpuRenderer,
}

impl OnCpu {
    /// The stages with these names; each must be in [`on_either`].
    pub(crate) fn named(names: &[String]) -> Result<Self> {
        let stages = names.iter().map(|name| {
            on_either().find(|stage| stage.name() == name.as_str()).ok_or_else(|| {
                let known: Vec<_> = on_either().map(Stage::name).collect();
                let expected = format!("names of {}", known.join(", "));
                Error::new(ErrorKind::Settings, "stages of the CPU", format!("'{name}'"), expected)
            })
        });
        Ok(Self { stages: stages.collect::<Result<_>>()?, ..Self::default() })
    }

    pub(crate) fn has(&self, stage: Stage) -> bool {
        self.stages.contains(&stage)
    }
}

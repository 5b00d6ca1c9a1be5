//! Stages that the CPU computes instead of the GPU, to find the stage that causes a difference.

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::pipeline::CpuRenderer;
use lumencut_core::stages::Stage;

use crate::stages::on_either;

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

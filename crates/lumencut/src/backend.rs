//! What computes the views of one scene: the CPU, or a GPU, which the CPU can stand in for.

use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::frame::Frame;
use lumencut_core::math::lanes::Isa;
use lumencut_core::pipeline::{self, context_alone};
use lumencut_core::settings::Settings;
use lumencut_core::stages::Stop;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::Volume;
use lumencut_gpu::renderer;

use crate::devices::{self, Choice, Wanted};

/// The environment variable that names the stages that the CPU does in place of the GPU, with commas between: to find
/// the one that errs.
#[cfg(not(target_arch = "wasm32"))]
pub const CPU_STAGES: &str = "LUMENCUT_CPU_STAGES";

/// What computes the views of one scene.
pub enum Backend {
    /// The CPU.
    Cpu(Cpu),
    /// A GPU.
    Gpu(Box<Gpu>),
}

/// One view; without a volume its cut surface alone.
pub struct View<'a> {
    /// What is shown.
    pub volume: Option<&'a Volume<'a>>,
    /// Where it is seen from.
    pub camera: &'a Camera,
    /// How it is shown.
    pub settings: &'a Settings,
    /// Whether to give up.
    pub stop: Stop<'a>,
}

impl Backend {
    /// What is wanted; where that is a GPU that the CPU may stand in for, and it does not open, the reason too.
    ///
    /// # Errors
    /// [`ErrorKind::Device`] where a GPU must compute and none can be used.
    pub async fn new(tree: Option<VesselTree>, wanted: Wanted) -> Result<(Self, Option<Error>)> {
        let (choice, is_optional) = match wanted {
            Wanted::Cpu => return Ok((Self::Cpu(Cpu::new(tree)), None)),
            Wanted::Gpu(choice) => (choice, false),
            Wanted::Auto(choice) => (choice, true),
        };
        if is_optional {
            match devices::open_if_there(choice).await {
                Ok(Some(_)) => {}
                Ok(None) => return Ok((Self::Cpu(Cpu::new(tree)), None)),
                Err(error) => return Ok((Self::Cpu(Cpu::new(tree)), Some(error))),
            }
        }
        let mut gpu = Gpu::new(tree, choice, is_optional);
        gpu.open().await?;
        Ok((Self::Gpu(Box::new(gpu)), None))
    }

    /// "cpu", or the name of the GPU.
    pub fn name(&self) -> &str {
        match self {
            Self::Cpu(_) => "cpu",
            Self::Gpu(gpu) => &gpu.name,
        }
    }

    /// Renders a view; where the CPU had to take over from the GPU, from now on, the reason too.
    ///
    /// # Errors
    /// Those of the scene and the settings, [`ErrorKind::Interrupted`] once `view.stop` says so, and
    /// [`ErrorKind::Device`] where the GPU fails and the CPU may not stand in for it.
    pub async fn render(&mut self, view: &View<'_>) -> Result<(Frame, Option<Error>)> {
        let gpu = match self {
            Self::Cpu(cpu) => return Ok((cpu.render(view)?, None)),
            Self::Gpu(gpu) => gpu,
        };
        let error = match gpu.render(view).await {
            Err(error) if error.kind == ErrorKind::Device => error,
            other => return Ok((other?, None)),
        };
        gpu.let_go();
        if !gpu.is_optional {
            return Err(error);
        }
        let mut cpu = Cpu::new(gpu.tree.clone());
        // Whoever interrupts this view has not heard of the failure yet: the GPU is then tried again.
        let frame = cpu.render(view)?;
        *self = Self::Cpu(cpu);
        Ok((frame, Some(error)))
    }
}

/// The CPU, with a tree or for the context alone.
pub struct Cpu(Option<pipeline::Renderer>);

impl Cpu {
    fn new(tree: Option<VesselTree>) -> Self {
        Self(tree.map(pipeline::Renderer::new))
    }

    fn render(&mut self, view: &View) -> Result<Frame> {
        let &View { volume, camera, settings, stop } = view;
        match (&mut self.0, volume) {
            (Some(tree), Some(volume)) => tree.render(volume, camera, settings, stop),
            (Some(tree), None) => tree.cut_surface(camera, settings, stop),
            (None, Some(volume)) => context_alone(volume, camera, settings, Isa::widest(), stop),
            (None, None) => Err(nothing_to_show()),
        }
    }
}

/// The GPU of the process, and what a renderer keeps on it.
pub struct Gpu {
    tree: Option<VesselTree>,
    choice: Choice,
    /// Whether the CPU may stand in for it.
    is_optional: bool,
    name: String,
    core: Option<renderer::Renderer>,
    /// The process that opened it.
    process: u32,
}

impl Gpu {
    fn new(tree: Option<VesselTree>, choice: Choice, is_optional: bool) -> Self {
        Self { tree, choice, is_optional, name: String::new(), core: None, process: devices::process() }
    }

    /// What the GPU keeps, made anew after a failure and in a forked process.
    async fn open(&mut self) -> Result<&mut renderer::Renderer> {
        self.leave_the_parents();
        let core = match self.core.take() {
            Some(core) => core,
            None => {
                let device = devices::open(self.choice).await?;
                self.name.clone_from(&device.description().name);
                let core = renderer::Renderer::new(device, self.tree.clone());
                #[cfg(not(target_arch = "wasm32"))]
                let core = forced_to_cpu(core)?;
                core
            }
        };
        Ok(self.core.insert(core))
    }

    async fn render(&mut self, view: &View<'_>) -> Result<Frame> {
        let &View { volume, camera, settings, stop } = view;
        let core = self.open().await?;
        match volume {
            Some(volume) => core.render(volume, camera, settings, stop).await,
            None => core.cut_surface(camera, settings, stop).await,
        }
    }

    /// Keeps nothing on a GPU that failed.
    fn let_go(&mut self) {
        if let Some(core) = self.core.take() {
            devices::forget(core.device());
        }
    }

    /// A forked process cannot use, or free, what its parent has on the GPU.
    fn leave_the_parents(&mut self) {
        let process = devices::process();
        if self.process != process {
            std::mem::forget(self.core.take());
            self.process = process;
        }
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        self.leave_the_parents();
    }
}

/// The same renderer, with the stages that [`CPU_STAGES`] names done by the CPU.
#[cfg(not(target_arch = "wasm32"))]
fn forced_to_cpu(mut core: renderer::Renderer) -> Result<renderer::Renderer> {
    let named = std::env::var(CPU_STAGES).unwrap_or_default();
    let stages = named.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty());
    core.force_to_cpu(stages.collect())?;
    Ok(core)
}

fn nothing_to_show() -> Error {
    Error::new(
        ErrorKind::Volume,
        "scene of the renderer",
        "neither a volume nor vessels",
        "one of them or both",
    )
}

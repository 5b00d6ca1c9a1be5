//! Computes views on the CPU, or on a GPU with the CPU as fallback.

use lumencut_core::edges::EdgeSamples;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::{LeveledTree, Scene, SharedVolume};
use lumencut_core::settings::TreeShown;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_gpu::renderer::GpuRenderer;
#[cfg(target_arch = "wasm32")]
use lumencut_gpu::screen::Screen;

use crate::devices::{self, Choice, Wanted};
use crate::method::{Method, refuse_focus};
use crate::samples::{Mean, offsets, sub_views};
use crate::wireframe::draw_wireframe;

/// Environment variable with stages (comma-separated) that run on the CPU instead of the GPU, to find a faulty stage.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) const CPU_STAGES: &str = "LUMENCUT_CPU_STAGES";

/// The tree whose walls the picture of a request shows as wires.
fn wired<'a>(scene: &'a Scene<'_>, request: &Request<'_>) -> Option<&'a LeveledTree> {
    let is_wanted = request.settings.tree == TreeShown::Wireframe && request.images.has(Image::Picture);
    scene.tree.as_deref().filter(|_| is_wanted && scene.volume.is_some())
}

/// The result of drawing a view.
#[cfg(target_arch = "wasm32")]
pub enum Drawn {
    /// The view was drawn on the canvas; with its depth (mm) if it was asked for.
    OnScreen(Vec<f32>),
    /// The view is returned to the caller.
    Frame(Frame),
}

/// The only image that the samples within a pixel need.
const PICTURE: ImageSet = ImageSet::of(&[Image::Picture]);

/// The device that computes views.
pub struct Backend {
    computer: Computer,
    /// The error for which the CPU replaced the GPU; the next finished view reports it.
    unreported: Option<Error>,
}

enum Computer {
    Cpu(CpuRenderer),
    Gpu(Box<Gpu>),
}

pub(crate) type Rendered = (Frame, Option<Error>);

impl Backend {
    /// Opens the requested device. If an optional GPU does not open, its error is returned too. Fails with
    /// [`ErrorKind::Device`] if a required GPU cannot be used.
    pub async fn new(wanted: Wanted) -> Result<(Self, Option<Error>)> {
        let (computer, given_up) = Computer::new(wanted).await?;
        Ok((Self { computer, unreported: None }, given_up))
    }

    /// "cpu", or the name of the GPU.
    pub fn name(&self) -> &str {
        match &self.computer {
            Computer::Cpu(_) => "cpu",
            Computer::Gpu(gpu) => &gpu.name,
        }
    }

    /// Renders a view. With several samples per pixel (`Settings::samples`) the picture is the mean over positions
    /// within the pixel; all other images show the view itself. Fails with the errors of scene and settings, with
    /// [`ErrorKind::Interrupted`], or with [`ErrorKind::Device`] if a required GPU fails.
    pub async fn render(&mut self, scene: &Scene<'_>, request: &Request<'_>) -> Result<Rendered> {
        self.render_by(Method::CutSurface, scene, request).await
    }

    /// Renders a view by any method. For mpCPR and CR the CPU finds the sampled positions and the GPU samples them; the progress is
    /// reported only at the end.
    pub async fn render_by(
        &mut self,
        method: Method,
        scene: &Scene<'_>,
        request: &Request<'_>,
    ) -> Result<Rendered> {
        let views = sub_views(request.camera, request.settings.samples)?;
        let has_samples = views.len() > 1 && scene.volume.is_some() && request.images.has(Image::Picture);
        if let Some(progress) = request.progress {
            // If the number of samples is odd, the middle one is the view itself.
            let samples = views.iter().filter(|camera| *camera != request.camera).count();
            progress.expect_views(if has_samples { 1 + samples } else { 1 });
        }
        let has_edges = method == Method::CutSurface
            && views.len() == 1
            && request.settings.edge_samples > 1
            && request.images.has(Image::Picture)
            && EdgeSamples::has_edges(scene, request.settings);
        let images = request.images.and(if has_edges { EdgeSamples::READS } else { ImageSet::of(&[]) });
        let mut frame = self.render_once(method, scene, &Request { images, ..*request }).await?;
        if has_edges {
            self.sample_edges(scene, request, &mut frame)?;
            frame = frame.keeping(request.images);
        }
        if has_samples {
            let mut mean = Mean::of(frame.image.len());
            for camera in &views {
                if camera == request.camera {
                    mean.add(&frame.image);
                    continue;
                }
                let asked = Request { camera, images: PICTURE, ..*request };
                let sample = self.render_once(method, scene, &asked).await?;
                mean.add(&sample.image);
                frame.count(&sample.timings);
            }
            frame.image = mean.pixels();
        }
        if let Some(tree) = wired(scene, request) {
            draw_wireframe(&mut frame.image, request.camera, tree.tree(), request.settings);
        }
        Ok((frame, self.unreported.take()))
    }

    /// Averages several samples in the pixels at and next to lines; the CPU computes them on every device.
    fn sample_edges(&mut self, scene: &Scene<'_>, request: &Request<'_>, frame: &mut Frame) -> Result<()> {
        let (Some(tree), Some(volume)) = (&scene.tree, &scene.volume) else { return Ok(()) };
        let offsets = offsets(request.camera, request.settings.edge_samples);
        // The middle of the pixel is the view itself.
        let beside: Vec<_> = offsets.iter().copied().filter(|offset| *offset != [0.0; 2]).collect();
        let cpu = match &mut self.computer {
            Computer::Cpu(cpu) => cpu,
            Computer::Gpu(gpu) => &mut gpu.edges,
        };
        let samples = cpu.edge_samples((tree, volume), request, frame, &beside)?;
        let pixels: Vec<_> = samples.pixels.iter().map(|pixel| *pixel as usize).collect();
        let mut mean = Mean::of(pixels.len());
        samples.colors.iter().for_each(|colors| mean.add(colors));
        if beside.len() < offsets.len() {
            mean.add(&pixels.iter().map(|pixel| frame.image[*pixel]).collect::<Vec<_>>());
        }
        for (pixel, color) in pixels.iter().zip(mean.pixels()) {
            frame.image[*pixel] = color;
        }
        frame.count(&samples.timings);
        Ok(())
    }

    /// Draws a view on the canvas if a GPU computes it, else returns it. With one sample, a picture alone never leaves
    /// the GPU. Fails as [`Backend::render_by`] does, and with [`ErrorKind::Device`] even if the GPU is optional, so
    /// that the caller can choose the device.
    #[cfg(target_arch = "wasm32")]
    pub async fn draw(
        &mut self,
        method: Method,
        scene: &Scene<'_>,
        request: &Request<'_>,
        mut screen: Option<&mut Screen>,
    ) -> Result<Drawn> {
        let has_samples = request.settings.samples > 1 || request.settings.edge_samples > 1;
        let is_read = has_samples || request.images.has(Image::Depth);
        let is_alone = method == Method::CutSurface && !is_read && wired(scene, request).is_none();
        if is_alone && let (Some(screen), Computer::Gpu(gpu)) = (screen.as_deref_mut(), &mut self.computer) {
            gpu.draw(scene, request, screen).await?;
            return Ok(Drawn::OnScreen(Vec::new()));
        }
        let (frame, lost) = self.render_by(method, scene, request).await?;
        if let Some(lost) = lost {
            return Err(lost);
        }
        let (Some(screen), Computer::Gpu(gpu)) = (screen, &mut self.computer) else {
            return Ok(Drawn::Frame(frame));
        };
        gpu.show(&frame, screen).await?;
        Ok(Drawn::OnScreen(frame.depth().to_vec()))
    }

    /// Resolves once the GPU in use is lost; immediately if there is none.
    #[cfg(target_arch = "wasm32")]
    pub fn loss(&self) -> impl Future<Output = ()> + use<> {
        let renderer = match &self.computer {
            Computer::Gpu(gpu) => gpu.renderer.as_ref(),
            Computer::Cpu(_) => None,
        };
        let loss = renderer.map(|renderer| renderer.device().loss());
        async move {
            if let Some(loss) = loss {
                loss.await;
            }
        }
    }

    /// Samples a volume once per pixel, at the positions in the frame that `places` makes. The CPU does it if the GPU fails.
    pub async fn look(
        &mut self,
        volume: &SharedVolume<'_>,
        places: impl Fn() -> Result<Frame>,
        request: &Request<'_>,
    ) -> Result<Rendered> {
        refuse_focus(request.settings)?;
        let gpu = match &mut self.computer {
            Computer::Cpu(cpu) => return Ok((cpu.look(volume, places()?, request)?, self.unreported.take())),
            Computer::Gpu(gpu) => gpu,
        };
        let error = match gpu.look(volume, places()?, request).await {
            Err(error) if error.kind == ErrorKind::Device => error,
            other => return Ok((other?, None)),
        };
        if !gpu.is_optional {
            return Err(error);
        }
        let cpu = CpuRenderer::default();
        let frame = cpu.look(volume, places()?, request)?;
        self.computer = Computer::Cpu(cpu);
        Ok((frame, Some(error)))
    }

    async fn render_once(
        &mut self,
        method: Method,
        scene: &Scene<'_>,
        request: &Request<'_>,
    ) -> Result<Frame> {
        let frame = self.computed(method, scene, request).await?;
        if let Some(progress) = request.progress {
            progress.end_view();
        }
        Ok(frame)
    }

    async fn computed(&mut self, method: Method, scene: &Scene<'_>, request: &Request<'_>) -> Result<Frame> {
        let gpu = match &mut self.computer {
            Computer::Cpu(cpu) => return method.on_cpu(cpu, scene, request),
            Computer::Gpu(gpu) => gpu,
        };
        let error = match gpu.render(method, scene, request).await {
            Err(error) if error.kind == ErrorKind::Device => error,
            other => return other,
        };
        if !gpu.is_optional {
            return Err(error);
        }
        let mut cpu = CpuRenderer::default();
        // If this is interrupted, the caller does not learn of the GPU's failure, so the next view tries the GPU again.
        let frame = method.on_cpu(&mut cpu, scene, request)?;
        self.computer = Computer::Cpu(cpu);
        self.unreported = Some(error);
        Ok(frame)
    }
}

impl Computer {
    async fn new(wanted: Wanted) -> Result<(Self, Option<Error>)> {
        let cpu = || Self::Cpu(CpuRenderer::default());
        let (choice, is_optional) = match wanted {
            Wanted::Cpu => return Ok((cpu(), None)),
            Wanted::Gpu(choice) => (choice, false),
            Wanted::Auto(choice) => (choice, true),
        };
        if is_optional {
            match devices::open_if_there(choice).await {
                Ok(Some(_)) => {}
                Ok(None) => return Ok((cpu(), None)),
                Err(error) => return Ok((cpu(), Some(error))),
            }
        }
        let mut gpu = Gpu::new(choice, is_optional);
        gpu.open().await?;
        Ok((Self::Gpu(Box::new(gpu)), None))
    }
}

struct Gpu {
    choice: Choice,
    is_optional: bool,
    name: String,
    renderer: Option<GpuRenderer>,
    /// Computes the samples at lines.
    edges: CpuRenderer,
    process: u32,
}

impl Gpu {
    fn new(choice: Choice, is_optional: bool) -> Self {
        Self {
            choice,
            is_optional,
            name: String::new(),
            renderer: None,
            edges: CpuRenderer::default(),
            process: devices::process(),
        }
    }

    /// The renderer; it is opened again after a failure and in a forked process.
    async fn open(&mut self) -> Result<&mut GpuRenderer> {
        self.leave_the_parents();
        let renderer = match self.renderer.take() {
            Some(renderer) => renderer,
            None => {
                let device = devices::open(self.choice).await?;
                self.name.clone_from(&device.description().name);
                let renderer = GpuRenderer::new(device);
                #[cfg(not(target_arch = "wasm32"))]
                let renderer = forced_to_cpu(renderer)?;
                renderer
            }
        };
        Ok(self.renderer.insert(renderer))
    }

    async fn render(&mut self, method: Method, scene: &Scene<'_>, request: &Request<'_>) -> Result<Frame> {
        let outcome = async { method.on_gpu(self.open().await?, scene, request).await }.await;
        self.kept_unless_failed(outcome)
    }

    async fn look(
        &mut self,
        volume: &SharedVolume<'_>,
        frame: Frame,
        request: &Request<'_>,
    ) -> Result<Frame> {
        let outcome = async { self.open().await?.look(volume, frame, request).await }.await;
        self.kept_unless_failed(outcome)
    }

    #[cfg(target_arch = "wasm32")]
    async fn draw(&mut self, scene: &Scene<'_>, request: &Request<'_>, screen: &mut Screen) -> Result<()> {
        let outcome = async { self.open().await?.draw(scene, request, screen).await }.await;
        self.kept_unless_failed(outcome)
    }

    #[cfg(target_arch = "wasm32")]
    async fn show(&mut self, frame: &Frame, screen: &mut Screen) -> Result<()> {
        let outcome = async { self.open().await?.show(&frame.image, frame.size(), screen).await }.await;
        self.kept_unless_failed(outcome)
    }

    fn kept_unless_failed<T>(&mut self, outcome: Result<T>) -> Result<T> {
        let has_failed = outcome.as_ref().is_err_and(|error| error.kind == ErrorKind::Device);
        if has_failed && let Some(renderer) = self.renderer.take() {
            devices::forget(renderer.device());
        }
        outcome
    }

    fn leave_the_parents(&mut self) {
        let process = devices::process();
        if self.process != process {
            std::mem::forget(self.renderer.take());
            self.process = process;
        }
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        self.leave_the_parents();
    }
}

/// The renderer with the stages of [`CPU_STAGES`] moved to the CPU.
#[cfg(not(target_arch = "wasm32"))]
fn forced_to_cpu(mut renderer: GpuRenderer) -> Result<GpuRenderer> {
    let named = std::env::var(CPU_STAGES).unwrap_or_default();
    let stages = named.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty());
    renderer.force_to_cpu(&stages.collect::<Vec<_>>())?;
    Ok(renderer)
}

#[cfg(test)]
#[path = "tests/backend.rs"]
mod tests;

//! A page's canvas for pictures that never leave the GPU.

use std::future::Future;

use lumencut_core::error::{Error, ErrorKind, Result};
use web_sys::OffscreenCanvas;
use wgpu::{
    BindGroupEntry, Buffer, BufferUsages, CompositeAlphaMode, CurrentSurfaceTexture, Instance,
    InstanceDescriptor, PresentMode, RenderPipeline, Surface, SurfaceConfiguration, SurfaceTarget,
    TextureFormat, TextureUsages,
};

use crate::device::Device;
use crate::recording::Recording;

/// A format that every browser's canvas supports.
const FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;

/// A canvas with the size of its picture in pixels; the page scales it.
#[derive(Debug)]
pub struct Screen {
    surface: Surface<'static>,
    drawn: Option<Drawing>,
}

#[derive(Debug)]
struct Drawing {
    size: [usize; 2],
    pipeline: RenderPipeline,
    parameters: Buffer,
}

impl Screen {
    /// A canvas that nothing else draws on. Fails with [`ErrorKind::Device`] if the browser does not let a
    /// GPU draw on the canvas.
    pub fn new(canvas: OffscreenCanvas) -> Result<Self> {
        let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
        let surface = instance
            .create_surface(SurfaceTarget::OffscreenCanvas(canvas))
            .map_err(|error| not_drawn(&error.to_string()))?;
        Ok(Self { surface, drawn: None })
    }

    pub(crate) fn fit(&mut self, device: &Device, size: [usize; 2]) -> Result<()> {
        if self.drawn.as_ref().is_some_and(|drawing| drawing.size == size) {
            return Ok(());
        }
        let [width, height] = size.map(|count| count as u32);
        let most = device.limits.max_texture_dimension_2d;
        if width > most || height > most {
            let found = format!("{width} × {height} pixels");
            return Err(device.too_large(
                "size of the camera",
                found,
                &format!("{most} pixels along each side"),
            ));
        }
        self.surface.configure(
            &device.device,
            &SurfaceConfiguration {
                usage: TextureUsages::RENDER_ATTACHMENT,
                format: FORMAT,
                width,
                height,
                present_mode: PresentMode::Fifo,
                desired_maximum_frame_latency: 2,
                alpha_mode: CompositeAlphaMode::Auto,
                view_formats: Vec::new(),
                color_space: Default::default(),
            },
        );
        let pipeline = match self.drawn.take() {
            Some(drawing) => drawing.pipeline,
            None => pipeline(device),
        };
        let parameters =
            device.buffer("screen parameters", 8, BufferUsages::UNIFORM | BufferUsages::COPY_DST);
        device.write(&parameters, &[width, height]);
        self.drawn = Some(Drawing { size, pipeline, parameters });
        device.check()
    }

    /// Draws `picture` after all recorded stages; the future completes once the GPU is done.
    pub(crate) fn record<'a>(
        &mut self,
        device: &'a Device,
        recording: Recording<'a>,
        picture: &Buffer,
    ) -> Result<impl Future<Output = Result<()>> + use<'a>> {
        let Some(drawing) = &self.drawn else { return Err(not_drawn("a canvas without a size")) };
        let texture = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => texture,
            other => return Err(not_drawn(&format!("{other:?}"))),
        };
        let view = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let [parameters, image] = [&drawing.parameters, picture].map(Buffer::as_entire_binding);
        let bound = device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("screen"),
            layout: &drawing.pipeline.get_bind_group_layout(0),
            entries: &[
                BindGroupEntry { binding: 0, resource: parameters },
                BindGroupEntry { binding: 1, resource: image },
            ],
        });
        let done = recording.draw(&drawing.pipeline, &bound, &view);
        device.queue.present(texture);
        Ok(done)
    }
}

fn not_drawn(words: &str) -> Error {
    Error::new(ErrorKind::Device, "canvas of the page", words, "a canvas that the GPU can draw on")
}

fn pipeline(device: &Device) -> RenderPipeline {
    let module = device.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("screen"),
        source: wgpu::ShaderSource::Wgsl(include_str!("screen.wgsl").into()),
    });
    device.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("screen"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("corner"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("pixel"),
            compilation_options: Default::default(),
            targets: &[Some(FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

//! A list of named stages that the GPU runs in one submission, their times, and the readback.

use bytemuck::Pod;
use futures_channel::oneshot::Receiver;
#[cfg(not(target_arch = "wasm32"))]
use lumencut_core::error::Error;
use lumencut_core::error::Result;
use lumencut_core::frame::Timing;
use lumencut_core::stop::Stop;
use wgpu::{BindingResource, Buffer, BufferUsages, CommandEncoder, MapMode};

use crate::device::Device;
use crate::stage::Stage;

const MAX_STAGES: u32 = 64;

pub(crate) struct Recording<'a> {
    pub device: &'a Device,
    encoder: CommandEncoder,
    clock: Option<wgpu::QuerySet>,
    names: Vec<&'static str>,
    reads: Vec<(Buffer, u64)>,
}

/// The result of a recording: the bytes of each requested buffer, still mapped.
pub(crate) struct Results {
    /// The times of stages (ms), if the GPU has a clock.
    pub timings: Vec<Timing>,
    staging: Buffer,
    view: Option<wgpu::BufferView>,
    places: Vec<std::ops::Range<usize>>,
}

impl Results {
    pub(crate) fn numbers<T: Pod + Send + Sync>(&self, n: usize) -> Vec<T> {
        self.view.as_ref().map_or_else(Vec::new, |all| copied(&all[self.places[n].clone()]))
    }
}

impl Drop for Results {
    fn drop(&mut self) {
        // The buffer can only be unmapped after its view is dropped.
        self.view = None;
        self.staging.unmap();
    }
}

impl<'a> Recording<'a> {
    pub(crate) fn new(device: &'a Device) -> Self {
        let clock = device.has_timestamps.then(|| {
            device.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("clock"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MAX_STAGES,
            })
        });
        let encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Self { device, encoder, clock, names: Vec::new(), reads: Vec::new() }
    }

    pub(crate) fn run(&mut self, stage: &Stage, resources: &[BindingResource], groups: [u32; 2]) {
        self.run_as(stage.name, stage, resources, groups);
    }

    /// Runs `stage` as a part of the stage `name`; its time is added to that stage.
    pub(crate) fn run_as(
        &mut self,
        name: &'static str,
        stage: &Stage,
        resources: &[BindingResource],
        [x, y]: [u32; 2],
    ) {
        let bound = stage.bind(self.device, resources);
        let n = 2 * self.names.len() as u32;
        let timestamp_writes = self.clock.as_ref().map(|clock| wgpu::ComputePassTimestampWrites {
            query_set: clock,
            beginning_of_pass_write_index: Some(n),
            end_of_pass_write_index: Some(n + 1),
        });
        let descriptor = wgpu::ComputePassDescriptor { label: Some(name), timestamp_writes };
        let mut pass = self.encoder.begin_compute_pass(&descriptor);
        pass.set_pipeline(&stage.pipeline);
        pass.set_bind_group(0, &bound, &[]);
        pass.dispatch_workgroups(x, y, 1);
        self.names.push(name);
    }

    /// Requests that the first `bytes` of a buffer be read after all stages.
    pub(crate) fn read(&mut self, buffer: &Buffer, bytes: u64) {
        self.reads.push((buffer.clone(), bytes));
    }

    pub(crate) async fn finish(mut self, stop: Stop<'_>) -> Result<Results> {
        let times = self.names.len() as u64 * 2 * 8;
        if let Some(clock) = &self.clock {
            let usage = BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC;
            let resolved = self.device.buffer("clock", times.max(8), usage);
            self.encoder.resolve_query_set(clock, 0..2 * self.names.len() as u32, &resolved, 0);
            self.reads.push((resolved, times));
        }
        let total = self.reads.iter().map(|(_, bytes)| bytes.next_multiple_of(8)).sum::<u64>().max(8);
        let staging = self.device.buffer("read back", total, BufferUsages::COPY_DST | BufferUsages::MAP_READ);
        let (mut offset, mut places) = (0, Vec::with_capacity(self.reads.len()));
        for (buffer, bytes) in &self.reads {
            self.encoder.copy_buffer_to_buffer(buffer, 0, &staging, offset, Some(*bytes));
            places.push(offset as usize..(offset + bytes) as usize);
            offset += bytes.next_multiple_of(8);
        }
        self.device.queue.submit([self.encoder.finish()]);
        let view = Some(self.device.map(&staging, stop).await?);
        let mut results = Results { timings: Vec::new(), staging, view, places };
        self.device.check()?;
        if self.clock.is_some() {
            let ticks = results.numbers(self.reads.len() - 1);
            let period = f64::from(self.device.queue.get_timestamp_period()) * 1e-6;
            results.timings = timings(&self.names, &ticks, period);
        }
        Ok(results)
    }
}

#[cfg(target_arch = "wasm32")]
impl<'a> Recording<'a> {
    /// Draws on `view` after all stages, runs everything, and completes once the GPU is done.
    pub fn draw(
        mut self,
        pipeline: &wgpu::RenderPipeline,
        bound: &wgpu::BindGroup,
        view: &wgpu::TextureView,
    ) -> impl Future<Output = Result<()>> + use<'a> {
        let attachment = wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        };
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("screen"),
            color_attachments: &[Some(attachment)],
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, bound, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        let device = self.device;
        device.queue.submit([self.encoder.finish()]);
        let (done, is_done) = futures_channel::oneshot::channel();
        device.queue.on_submitted_work_done(move || {
            // After an interruption nobody receives this message.
            let _ = done.send(());
        });
        async move {
            device.patience(is_done, &|| false).await?;
            device.check()
        }
    }
}

/// Copies in parallel: one thread would copy a large picture more slowly than a GPU computes it.
#[cfg(not(target_arch = "wasm32"))]
fn copied<T: Pod + Send + Sync>(bytes: &[u8]) -> Vec<T> {
    use rayon::prelude::*;

    match bytemuck::try_cast_slice(bytes) {
        Ok(numbers) => numbers.par_iter().with_min_len(1 << 16).copied().collect(),
        Err(_) => bytemuck::pod_collect_to_vec(bytes),
    }
}

/// Copies in the only thread that a page's worker has.
#[cfg(target_arch = "wasm32")]
fn copied<T: Pod>(bytes: &[u8]) -> Vec<T> {
    bytemuck::pod_collect_to_vec(bytes)
}

/// The time between the two ticks of each stage; times of consecutive passes of a stage are added.
fn timings(names: &[&'static str], ticks: &[u64], period: f64) -> Vec<Timing> {
    let mut timings: Vec<Timing> = Vec::new();
    for (stage, ticks) in names.iter().zip(ticks.chunks_exact(2)) {
        let milliseconds = ticks[1].saturating_sub(ticks[0]) as f64 * period;
        match timings.last_mut() {
            Some(last) if last.stage == *stage => last.milliseconds += milliseconds,
            _ => timings.push(Timing { stage, milliseconds }),
        }
    }
    timings
}

impl Device {
    pub(crate) fn buffer(&self, label: &str, size: u64, usage: BufferUsages) -> Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// Waits for all work, and returns the bytes of a buffer.
    async fn map(&self, buffer: &Buffer, stop: Stop<'_>) -> Result<wgpu::BufferView> {
        let (done, is_done) = futures_channel::oneshot::channel();
        buffer.map_async(MapMode::Read, .., move |mapped| {
            let _ = done.send(mapped);
        });
        match self.patience(is_done, stop).await? {
            Some(Ok(())) => buffer.get_mapped_range(..).map_err(|_| self.unfinished()),
            _ => Err(self.unfinished()),
        }
    }

    /// Waits for the message that the GPU is done; `None` if it will never come.
    #[cfg(not(target_arch = "wasm32"))]
    async fn patience<T>(&self, mut sent: Receiver<T>, stop: Stop<'_>) -> Result<Option<T>> {
        let start = std::time::Instant::now();
        loop {
            // Polls without waiting, because waiting in wgpu from two threads at once sometimes panics.
            if self.device.poll(wgpu::PollType::Poll).is_err() {
                return Err(self.unfinished());
            }
            match sent.try_recv() {
                Ok(None) if stop() => return Err(Error::interrupted()),
                Ok(None) => {}
                Ok(sent) => return Ok(sent),
                Err(_) => return Ok(None),
            }
            // Sleeps for 1 % of the elapsed time: a result is noticed soon, and polling costs little.
            let nap = start.elapsed() / 100;
            std::thread::sleep(
                nap.clamp(std::time::Duration::from_micros(20), std::time::Duration::from_millis(2)),
            );
        }
    }

    /// In a browser nothing has to be polled.
    #[cfg(target_arch = "wasm32")]
    async fn patience<T>(&self, sent: Receiver<T>, _: Stop<'_>) -> Result<Option<T>> {
        Ok(sent.await.ok())
    }
}

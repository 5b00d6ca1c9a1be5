//! Table 2 of the paper on the GPU, stage by stage, next to the paper's figures and the CPU in the same run. `cargo
//! bench -p lumencut-gpu --bench stages`; `-- --quick` renders fewer and smaller pictures, for slow adapters.

use std::error::Error;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec3;
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_gpu::adapter::Choice;
use lumencut_gpu::device::Device;
use lumencut_gpu::renderer::GpuRenderer;
use lumencut_phantom::Phantom;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::timing::{StageTimes, head, row, stage_medians};
use lumencut_scenes::views::fitted;
use lumencut_scenes::workloads::{ASKED, PAPER_FRAMES, PAPER_STAGES, PaperStage, WORKLOADS};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

const WARM_UP: Duration = Duration::from_secs(1);
/// The row for frames whose picture is the only image that is read back.
const PICTURE_ALONE: &str = "picture alone";

#[derive(Clone, Copy)]
struct Effort {
    frames: usize,
    sides: [usize; 2],
}

struct Measured {
    gpu: StageTimes,
    cpu: StageTimes,
    gpu_mida: StageTimes,
    cpu_mida: StageTimes,
}

/// Renders for a while, because an idle GPU lowers its clock, some to a sixth.
fn raise_clock(
    device: &Device,
    render: &mut impl FnMut() -> lumencut_core::error::Result<Frame>,
) -> Result<()> {
    let start = Instant::now();
    while !device.description().is_software && start.elapsed() < WARM_UP {
        render()?;
    }
    Ok(())
}

fn measure(device: &Arc<Device>, phantom: &Phantom, side: usize, frames: usize) -> Result<Measured> {
    let scene = Scene::new(phantom.volume()?, phantom.tree.clone());
    let camera = fitted(&phantom.tree, DVec3::Y, side);
    let (mut gpu, mut cpu) = (GpuRenderer::new(Arc::clone(device)), CpuRenderer::default());
    let plain = Settings { context: None, ..Settings::default() };
    let mida = Settings::default();
    let mut on_gpu = |settings: &Settings, images: ImageSet| -> Result<StageTimes> {
        let request = Request { images, ..Request::new(&camera, settings) };
        let mut render = || pollster::block_on(gpu.render(&scene, &request));
        raise_clock(device, &mut render)?;
        Ok(stage_medians(frames, render)?)
    };
    let picture = on_gpu(&mida, ImageSet::of(&[Image::Picture]))?;
    let (gpu, mut gpu_mida) = (on_gpu(&plain, ASKED)?, on_gpu(&mida, ASKED)?);
    gpu_mida.insert(PICTURE_ALONE, picture["frame"]);
    let mut on_cpu = |settings: &Settings| {
        let request = Request { images: ASKED, ..Request::new(&camera, settings) };
        stage_medians(frames, || cpu.render(&scene, &request))
    };
    Ok(Measured { gpu, gpu_mida, cpu: on_cpu(&plain)?, cpu_mida: on_cpu(&mida)? })
}

fn cell(time: Option<&f64>) -> String {
    time.map_or_else(|| "–".to_owned(), |time| format!("{time:.2}"))
}

fn table(side: usize, names: &[&str], all: &[Measured]) {
    let columns: Vec<String> =
        names.iter().flat_map(|name| [format!("{name} GPU"), "CPU".into(), "paper".into()]).collect();
    let columns: Vec<&str> = ["stage"].into_iter().chain(columns.iter().map(String::as_str)).collect();
    head(&format!("{side} × {side} pixels, from the front (ms)"), &columns);
    let print = |name: &str, times: &dyn Fn(&Measured) -> [Option<f64>; 2], paper: [f64; 3]| {
        let mut cells = vec![name.to_owned()];
        for (workload, paper) in all.iter().zip(paper) {
            cells.extend(times(workload).map(|time| cell(time.as_ref())));
            // The paper states times only for pictures of 512 × 512 pixels.
            cells.push(if paper > 0.0 && side == 512 { paper.to_string() } else { String::new() });
        }
        row(cells);
    };
    for PaperStage { stage, milliseconds, .. } in PAPER_STAGES {
        print(stage, &|m| [m.gpu.get(stage).copied(), m.cpu.get(stage).copied()], milliseconds);
    }
    let of = |gpu: &StageTimes, cpu: &StageTimes, key| [gpu.get(key).copied(), cpu.get(key).copied()];
    print("frame without context", &|m| of(&m.gpu, &m.cpu, "frame"), [0.0; 3]);
    print("context, MIDA", &|m| of(&m.gpu_mida, &m.cpu_mida, "context"), [0.0; 3]);
    print("frame with MIDA", &|m| of(&m.gpu_mida, &m.cpu_mida, "frame"), PAPER_FRAMES);
    print("frame with MIDA, the picture alone", &|m| of(&m.gpu_mida, &m.cpu_mida, PICTURE_ALONE), [0.0; 3]);
}

/// Times of the cut surface of a random tree: on the GPU's clock, and for the caller, including the readback.
fn cut_surface(device: &Arc<Device>, effort: Effort) -> Result<()> {
    let tree = random_tree(7, 31, 160, 1.5, 150.0)?;
    let title = format!("Cut surface of {} segments, all levels (ms)", tree.segment_count());
    head(&title, &["side", "rule", "GPU, its clock", "GPU, the caller's", "CPU", "CPU / GPU, its clock"]);
    let scene = Scene::default().with_tree(tree.clone());
    let (mut gpu, mut cpu) = (GpuRenderer::new(Arc::clone(device)), CpuRenderer::default());
    for side in effort.sides {
        let camera = fitted(&tree, DVec3::new(0.1, 1.0, 0.2), side);
        for (rule, rules) in [("default", Settings::default()), ("paper's", Settings::paper())] {
            let settings = Settings { depth_filter: false, ..rules };
            let request = Request { images: ASKED, ..Request::new(&camera, &settings) };
            let mut render = || pollster::block_on(gpu.render(&scene, &request));
            raise_clock(device, &mut render)?;
            let on_gpu = stage_medians(effort.frames, render)?;
            let on_cpu = stage_medians(effort.frames, || cpu.render(&scene, &request))?;
            let stages = |times: &StageTimes| -> f64 {
                times.iter().filter(|(stage, _)| **stage != "frame").map(|(_, time)| time).sum()
            };
            let (on_gpu_clock, on_cpu_clock) = (stages(&on_gpu), stages(&on_cpu));
            let ratio = if on_gpu_clock > 0.0 {
                format!("{:.2}", on_cpu_clock / on_gpu_clock)
            } else {
                "no clock".to_owned()
            };
            row([
                side.to_string(),
                rule.to_owned(),
                format!("{on_gpu_clock:.2}"),
                cell(on_gpu.get("frame")),
                format!("{on_cpu_clock:.2}"),
                ratio,
            ]);
        }
    }
    Ok(())
}

fn main() -> Result<()> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let effort = if quick {
        Effort { frames: 5, sides: [256, 512] }
    } else {
        Effort { frames: 31, sides: [512, 1024] }
    };
    let device = Arc::new(pollster::block_on(Device::open(Choice::Any))?);
    let adapter = device.description();
    println!("GPU: {} by {} ({})", adapter.name, adapter.backend, adapter.driver);
    if adapter.is_software {
        println!("This is SOFTWARE on the CPU, not a GPU: its times say nothing about one.");
    }
    println!("CPU: {} threads; medians of {} frames", std::thread::available_parallelism()?, effort.frames);
    cut_surface(&device, effort)?;
    let mut measured = [Vec::new(), Vec::new()];
    for (_, make) in WORKLOADS {
        // Measures one volume after the other: the largest takes 684 MB on both CPU and GPU.
        let phantom = make(0, if quick { 0.5 } else { 1.0 })?;
        for (side, measured) in effort.sides.into_iter().zip(&mut measured) {
            measured.push(measure(&device, &phantom, side, effort.frames)?);
        }
    }
    let names = WORKLOADS.map(|(name, _)| name);
    if quick {
        println!(
            "\nThe workloads have half their size along each side: the paper's figures are of whole ones."
        );
    }
    effort.sides.into_iter().zip(&measured).for_each(|(side, all)| table(side, &names, all));
    Ok(())
}

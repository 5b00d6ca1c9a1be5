//! Times of the context: vectorised sampling against a scalar loop, and each mode with and without skipping.

use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::math::lanes::{FAN, Isa, Kernel, dispatch, larger};
use lumencut_core::math::ray::WHOLE;
use lumencut_core::math::sampling::{Grid, Places, SampledRun};
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::{Scene, SharedVolume, VolumeKey};
use lumencut_core::settings::{Context, ContextMode, Preset, Settings};
use lumencut_core::stages::context::{Surroundings, context};
use lumencut_core::volume::{Real, Volume, Voxel, Voxels};
use lumencut_phantom::Phantom;
use lumencut_scenes::timing::{head, once, row, time};
use lumencut_scenes::views::{fitted, on_cpu};
use lumencut_scenes::volumes::volume;
use lumencut_scenes::workloads::WORKLOADS;

const SIDE: usize = 256;
const PACKETS: usize = 2048;
const SAMPLES: usize = 128;
/// Number of samples of a ray that are taken in one call.
const STEPS: usize = 8;

struct Line {
    toward: [f32; 3],
    from: usize,
}

impl SampledRun for Line {
    #[inline(always)]
    fn places(&self, n: usize) -> Places {
        let mut places = [[0.0; FAN]; 3];
        for l in 0..FAN {
            places[0][l] = (l % 4) as f32 * 0.7;
            places[1][l] = (l / 4) as f32 * 0.7;
            for a in 0..3 {
                places[a][l] += self.toward[a] * (self.from + n) as f32;
            }
        }
        places
    }
}

fn base(packet: usize) -> [i32; 3] {
    [4 + (packet % 64 * 2) as i32, 3 + (packet / 64 * 2 % 64) as i32, 2]
}

struct ByLanes<'a, T> {
    grid: Grid,
    voxels: &'a [T],
    toward: [f32; 3],
}

impl<T: Voxel> Kernel for ByLanes<'_, T> {
    type Output = f32;

    #[inline(always)]
    fn run(self) -> f32 {
        let mut sum = 0.0;
        for packet in 0..PACKETS {
            let mut most = [-1e9; FAN];
            for from in (0..SAMPLES).step_by(STEPS) {
                let line = Line { toward: self.toward, from };
                let values: [_; STEPS] = self.grid.sample(self.voxels, base(packet), &line);
                for value in &values {
                    for l in 0..FAN {
                        most[l] = larger(most[l], value[l]);
                    }
                }
            }
            sum += most.iter().sum::<f32>();
        }
        sum
    }
}

fn one_by_one<T: Voxel>(voxels: &[T], toward: [f32; 3]) -> f32 {
    let last = (SIDE - 1) as f32;
    let strides = [1, SIDE, SIDE * SIDE];
    let mut sum = 0.0;
    for packet in 0..PACKETS {
        for l in 0..FAN {
            let start = [(l % 4) as f32 * 0.7, (l / 4) as f32 * 0.7, 0.0];
            let mut most = -1e9;
            for n in 0..SAMPLES {
                let (mut first, mut weight) = (0, [0.0; 3]);
                for a in 0..3 {
                    let c = base(packet)[a] as f32 + start[a] + toward[a] * n as f32;
                    let c = c.clamp(0.0, last);
                    let floor = (c as usize).min(SIDE - 2);
                    weight[a] = c - floor as f32;
                    first += floor * strides[a];
                }
                let line = |o: usize| {
                    let (near, far) =
                        (voxels[first + o].real().to_f32(), voxels[first + o + 1].real().to_f32());
                    near + (far - near) * weight[0]
                };
                let plane = |o: usize| line(o) + (line(o + SIDE) - line(o)) * weight[1];
                let (near, far) = (plane(0), plane(SIDE * SIDE));
                most = larger(most, std::hint::black_box(near + (far - near) * weight[2]));
            }
            sum += most;
        }
    }
    sum
}

fn sampler<T: Voxel>(name: &str, voxels: &[T], volume: &Volume) {
    let grid = Grid::new(volume);
    let samples = (PACKETS * SAMPLES * FAN) as f64 / 1e3;
    for (direction, toward) in
        [("oblique", [0.3, 0.5, 0.8]), ("along i", [0.9, 0.1, 0.1]), ("along k", [0.02, 0.03, 0.9])]
    {
        let scalar = time(5, || {
            std::hint::black_box(one_by_one(voxels, toward));
        });
        for isa in Isa::available() {
            let lanes = time(5, || {
                std::hint::black_box(dispatch(isa, ByLanes { grid, voxels, toward }));
            });
            let set = format!("{isa:?}");
            let [ours, theirs] = [lanes, scalar].map(|t| format!("{:.0}", samples / t.minimum));
            let ratio = format!("{:.1}", scalar.minimum / lanes.minimum);
            row([name, direction, &set, &ours, &theirs, &ratio]);
        }
    }
}

fn samplers() {
    let numbers = || (0..SIDE * SIDE * SIDE).map(|n| (n * 7919 % 3001) as i16 - 1000);
    head(
        "Trilinear samples (millions per second, one thread)",
        &["voxels", "rays", "set", "lanes", "scalar", "ratio"],
    );
    let cube = |voxels| volume(voxels, [SIDE; 3], DAffine3::IDENTITY);
    let integers: Vec<i16> = numbers().collect();
    sampler("int16", &integers, &cube(Voxels::I16(&integers)));
    let floats: Vec<f32> = numbers().map(f32::from).collect();
    sampler("float32", &floats, &cube(Voxels::F32(&floats)));
}

fn modes() -> Vec<(&'static str, Context)> {
    let preset = |preset: Preset| preset.transfer_function(Context::default().window);
    let blend = |gamma| Context { mode: ContextMode::Blend { gamma }, ..Context::default() };
    let mode = |mode| Context { mode, ..Context::default() };
    vec![
        ("mida", blend(0.0)),
        ("mida, preview", Context { preview: true, ..blend(0.0) }),
        ("mida, shaded", Context { shading: true, ..blend(0.0) }),
        ("mida, soft tissue", Context { transfer: preset(Preset::SoftTissue), ..blend(0.0) }),
        ("dvr", blend(-1.0)),
        ("dvr, shaded", Context { shading: true, ..blend(-1.0) }),
        ("mip", Context { transfer: preset(Preset::Grey), ..blend(1.0) }),
        ("minip", mode(ContextMode::Minimum)),
        ("average", mode(ContextMode::Average)),
    ]
}

/// Time (ms) of one mode if every ray crosses the entire volume.
fn whole(shared: &SharedVolume, camera: &Camera, settings: &Context, skip: bool, runs: usize) -> Result<f64> {
    let work = on_cpu(camera);
    let start = vec![WHOLE; 512 * 512];
    let mut pixels = vec![[0.0; 4]; 512 * 512];
    let blocks = if skip { Some(shared.blocks(work.stop)?) } else { None };
    let surroundings = Surroundings { camera, volume: &shared.volume, blocks };
    let all = Settings::default();
    let mut result = Ok(());
    let times = time(runs, || result = context(&work, &surroundings, &all, settings, &start, &mut pixels));
    result.map(|()| times.median)
}

fn workload(name: &str, phantom: &Phantom) -> Result<()> {
    let scene = Scene::new(phantom.volume()?, phantom.tree.clone());
    let shared = SharedVolume::new(phantom.volume()?, VolumeKey::default());
    let (made, blocks) = once(|| shared.blocks(&|| false).map(drop));
    blocks?;
    row([name, "", "the blocks, once", &*format!("{made:.1}"), "", ""]);
    for (direction, toward) in [("front", DVec3::Y), ("oblique", DVec3::new(-0.6, 0.7, 0.4))] {
        let camera = fitted(&phantom.tree, toward, 512);
        for (mode, settings) in modes() {
            let fast = whole(&shared, &camera, &settings, true, 5)?;
            let slow = whole(&shared, &camera, &settings, false, 1)?;
            let cells = [fast, slow, slow / fast].map(|c| format!("{c:.1}"));
            row([name, direction, mode, &cells[0], &cells[1], &cells[2]]);
        }
        let mut renderer = CpuRenderer::default();
        for (what, preview) in [("whole frame, mida", false), ("whole frame, mida, preview", true)] {
            let context = Some(Context { preview, ..Context::default() });
            let settings = Settings { context, ..Settings::default() };
            let mut result = Ok(());
            let request = Request::new(&camera, &settings);
            let frame = time(9, || result = renderer.render(&scene, &request).map(drop));
            result?;
            row([name, direction, what, &*format!("{:.1}", frame.median), "", ""]);
        }
    }
    Ok(())
}

fn main() -> Result<()> {
    samplers();
    head(
        "Context, 512 × 512 pixels; but for whole frames every ray through the whole volume",
        &["workload", "direction", "mode", "ms", "ms without blocks", "ratio"],
    );
    for (name, make) in WORKLOADS {
        workload(name, &make(0, 1.0)?)?;
    }
    Ok(())
}

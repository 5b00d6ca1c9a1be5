//! Optimally oriented flux: the flow of the gradient into balls of several radii. Law and Chung, "Three dimensional
//! curvilinear structure detection using optimally oriented flux", ECCV 2008, doi:10.1007/978-3-540-88693-8_27. The
//! flux into a ball is the integral of the second derivatives within it. So the volume is averaged over the ball, and
//! then differentiated.

use std::sync::OnceLock;

use lumencut_core::math::lanes::{Isa, Kernel, dispatch};

/// Ball radii (voxels). The finest level uses the first three, the coarsest the last three, others the middle ones.
pub(crate) const RADII: [f64; 4] = [1.0, 1.5, 2.1, 3.0];

/// Weights of a Gaussian with a standard deviation of 0.7 voxels.
const SMOOTHING: [f32; 3] = [0.561_8, 0.202_5, 0.016_6];

/// Blur of the cylinder with which responses are calibrated (voxels).
const BLUR: f64 = 0.6;

/// Voxels that the largest ball reaches from its centre, and border that a tile needs.
const TILE_BORDER: usize = 3;
pub(crate) const HALO: usize = 2 + TILE_BORDER + 2;

/// In a tube, the trace (sum of inflows) is at least this many responses. Testing it first saves most eigenvalues.
const LEAST_TRACE: f32 = 1.2;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Gain {
    /// Factor that makes the response of a cylinder of contrast 1 equal to 1.
    pub factor: f32,
    /// Response to noise of standard deviation 1.
    pub noise: f32,
}

pub(crate) struct Responses {
    pub size: [usize; 3],
    /// Strongest response of each voxel, as a contrast; 0 if there is none.
    pub strongest: Vec<f32>,
    pub radius: Vec<u8>,
    /// Index of each ball radius, with the averages over that ball.
    averages: Vec<(usize, Vec<f32>)>,
    average_size: [usize; 3],
}

pub(crate) struct FluxOf<'a> {
    /// Values of the tile with a border of `HALO` voxels.
    pub values: Vec<f32>,
    pub size: [usize; 3],
    /// Index of each ball radius, with the factor and the threshold of its response.
    pub radii: &'a [(usize, f32, f32)],
}

impl Kernel for FluxOf<'_> {
    type Output = Responses;

    #[inline(always)]
    fn run(self) -> Responses {
        let smooth = smoothed(&self.values, self.size);
        let smooth_size = self.size.map(|n| n - 4);
        let average_size = smooth_size.map(|n| n - 2 * TILE_BORDER);
        let size = average_size.map(|n| n - 2);
        let count = size.iter().product();
        let mut found = Responses {
            size,
            strongest: vec![0.0; count],
            radius: vec![0; count],
            averages: Vec::with_capacity(self.radii.len()),
            average_size,
        };
        for &(number, factor, threshold) in self.radii {
            let average = averaged(&smooth, smooth_size, &ball(RADII[number]));
            respond(&mut found, &average, number, [factor, threshold]);
            found.averages.push((number, average));
        }
        found
    }
}

impl FluxOf<'_> {
    pub(crate) fn responses(self) -> Responses {
        dispatch(Isa::widest(), self)
    }
}

impl Responses {
    pub(crate) fn direction(&self, voxel: [usize; 3]) -> [f64; 3] {
        let radius = usize::from(self.radius[self.number(voxel)]);
        let average = self.averages.iter().find(|(number, _)| *number == radius);
        let Some((_, average)) = average else { return [0.0, 0.0, 1.0] };
        let strides = [1, self.average_size[0], self.average_size[0] * self.average_size[1]];
        let center: usize = (0..3).map(|a| (voxel[a] + 1) * strides[a]).sum();
        let flows = flows(average, center, strides);
        along(flows, eigenvalues(flows)[2])
    }

    pub(crate) fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.size[0] * (j + self.size[1] * k)
    }
}

/// Smooths along each axis; the result is smaller by two voxels on each side.
#[inline(always)]
fn smoothed(values: &[f32], size: [usize; 3]) -> Vec<f32> {
    let mut made = values.to_vec();
    let mut size = size;
    for a in 0..3 {
        let mut next = size;
        next[a] -= 4;
        let stride = [1, size[0], size[0] * size[1]][a];
        let mut smooth = vec![0.0_f32; next.iter().product()];
        for (row, out) in smooth.chunks_exact_mut(next[0]).enumerate() {
            let (j, k) = (row % next[1], row / next[1]);
            let from = &made[(j + k * size[1]) * size[0]..];
            for (i, value) in out.iter_mut().enumerate() {
                let outer = from[i] + from[i + 4 * stride];
                let inner = from[i + stride] + from[i + 3 * stride];
                *value = SMOOTHING[0] * from[i + 2 * stride] + SMOOTHING[1] * inner + SMOOTHING[2] * outer;
            }
        }
        (made, size) = (smooth, next);
    }
    made
}

fn ball(radius: f64) -> Vec<([i32; 3], f32)> {
    let reach = TILE_BORDER as i32;
    let mut found = Vec::new();
    for k in -reach..=reach {
        for j in -reach..=reach {
            for i in -reach..=reach {
                let share = share_within([i, j, k], radius);
                if share > 0.0 {
                    found.push(([i, j, k], share));
                }
            }
        }
    }
    let sum: f32 = found.iter().map(|(_, share)| share).sum();
    for (_, share) in &mut found {
        *share /= sum;
    }
    found
}

fn share_within(voxel: [i32; 3], radius: f64) -> f32 {
    const PARTS: i32 = 5;
    let mut inside = 0;
    for part in 0..PARTS * PARTS * PARTS {
        let parts = [part % PARTS, part / PARTS % PARTS, part / (PARTS * PARTS)];
        let square: f64 = (0..3)
            .map(|a| f64::from(voxel[a]) + (f64::from(parts[a]) + 0.5) / f64::from(PARTS) - 0.5)
            .map(|x| x * x)
            .sum();
        inside += i32::from(square <= radius * radius);
    }
    inside as f32 / (PARTS * PARTS * PARTS) as f32
}

/// Averages over a ball; the result is smaller by `TILE_BORDER` voxels on each side.
#[inline(always)]
fn averaged(values: &[f32], size: [usize; 3], ball: &[([i32; 3], f32)]) -> Vec<f32> {
    let next = size.map(|n| n - 2 * TILE_BORDER);
    let reach = TILE_BORDER as i32;
    let offsets: Vec<(usize, f32)> = ball
        .iter()
        .map(|(voxel, weight)| {
            let [i, j, k] = voxel.map(|c| (c + reach) as usize);
            (i + size[0] * (j + size[1] * k), *weight)
        })
        .collect();
    let mut made = vec![0.0_f32; next.iter().product()];
    for (row, out) in made.chunks_exact_mut(next[0]).enumerate() {
        let first = (row % next[1] + row / next[1] * size[1]) * size[0];
        for &(offset, weight) in &offsets {
            for (sum, value) in out.iter_mut().zip(&values[first + offset..]) {
                *sum += weight * value;
            }
        }
    }
    made
}

#[inline(always)]
fn respond(found: &mut Responses, average: &[f32], number: usize, [factor, threshold]: [f32; 2]) {
    let (size, wide) = (found.size, found.average_size);
    let strides = [1, wide[0], wide[0] * wide[1]];
    let mut traces = vec![0.0_f32; size[0]];
    for row in 0..size[1] * size[2] {
        let first = 1 + (row % size[1] + 1) * strides[1] + (row / size[1] + 1) * strides[2];
        for (i, trace) in traces.iter_mut().enumerate() {
            let n = first + i;
            let beside = average[n - 1] + average[n + 1] + average[n - strides[1]] + average[n + strides[1]];
            let outer = beside + average[n - strides[2]] + average[n + strides[2]];
            *trace = 6.0 * average[n] - outer;
        }
        for i in 0..size[0] {
            if traces[i] * factor < LEAST_TRACE * threshold {
                continue;
            }
            let response = -eigenvalues(flows(average, first + i, strides))[1] * factor;
            let place = row * size[0] + i;
            if response >= threshold && response > found.strongest[place] {
                found.strongest[place] = response;
                found.radius[place] = number as u8;
            }
        }
    }
}

#[inline(always)]
fn flows(average: &[f32], n: usize, strides: [usize; 3]) -> [f32; 6] {
    let [x, y, z] = strides;
    let twice = 2.0 * average[n];
    let pure = |s: usize| average[n - s] + average[n + s] - twice;
    let mixed = |s: usize, t: usize| {
        0.25 * (average[n - s - t] + average[n + s + t] - average[n - s + t] - average[n + s - t])
    };
    [pure(x), pure(y), pure(z), mixed(x, y), mixed(x, z), mixed(y, z)]
}

#[inline(always)]
fn eigenvalues([xx, yy, zz, xy, xz, yz]: [f32; 6]) -> [f32; 3] {
    let mean = (xx + yy + zz) / 3.0;
    let (a, b, c) = (xx - mean, yy - mean, zz - mean);
    let spread = ((a * a + b * b + c * c + 2.0 * (xy * xy + xz * xz + yz * yz)) / 6.0).sqrt();
    if spread < 1e-20 {
        return [mean; 3];
    }
    let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
    let angle = (0.5 * determinant / (spread * spread * spread)).clamp(-1.0, 1.0).acos() / 3.0;
    let largest = mean + 2.0 * spread * angle.cos();
    let smallest = mean + 2.0 * spread * (angle + 2.0 * std::f32::consts::FRAC_PI_3).cos();
    [smallest, 3.0 * mean - largest - smallest, largest]
}

fn along([xx, yy, zz, xy, xz, yz]: [f32; 6], value: f32) -> [f64; 3] {
    let rows = [[xx - value, xy, xz], [xy, yy - value, yz], [xz, yz, zz - value]]
        .map(|row| glam::DVec3::from_array(row.map(f64::from)));
    let products = [rows[0].cross(rows[1]), rows[0].cross(rows[2]), rows[1].cross(rows[2])];
    let longest = products.into_iter().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    longest.and_then(glam::DVec3::try_normalize).unwrap_or(glam::DVec3::Z).to_array()
}

pub(crate) fn gains() -> &'static [Gain; 4] {
    static GAINS: OnceLock<[Gain; 4]> = OnceLock::new();
    GAINS.get_or_init(|| std::array::from_fn(gain))
}

fn gain(number: usize) -> Gain {
    let middle = HALO as f64;
    let side = 2 * HALO + 1;
    let cylinder: Vec<f32> = (0..side * side * side)
        .map(|n| {
            let [x, y] = [n % side, n / side % side].map(|c| c as f64 - middle);
            blurred_disc(x, y, RADII[number])
        })
        .collect();
    let response = |values: Vec<f32>, size: [usize; 3]| {
        FluxOf { values, size, radii: &[(number, 1.0, 1e-6)] }.responses()
    };
    let around = response(cylinder, [side; 3]);
    let peak = around.strongest[around.number([1; 3])];
    let wide = 2 * HALO + 24;
    let noise = response(noise(wide * wide * wide), [wide; 3]);
    let square: f32 = noise.strongest.iter().map(|r| r * r).sum();
    // Only positive responses are recorded. For noise, these are half of all responses.
    let spread = (2.0 * square / noise.strongest.len() as f32).sqrt();
    Gain { factor: 1.0 / peak, noise: spread / peak }
}

fn blurred_disc(x: f64, y: f64, radius: f64) -> f32 {
    let distance = x.hypot(y);
    // Approximates the disc's edge by a half-plane: accurate for radii above one standard deviation of the blur.
    let edge = (radius - distance) / (BLUR * std::f64::consts::SQRT_2);
    (0.5 * (1.0 + (std::f64::consts::FRAC_2_SQRT_PI * edge * (1.0 + 0.089 * edge * edge)).tanh())) as f32
}

fn noise(count: usize) -> Vec<f32> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut even = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1_u64 << 24) as f32
    };
    (0..count).map(|_| (0..12).map(|_| even()).sum::<f32>() - 6.0).collect()
}

#[cfg(test)]
#[path = "tests/flux.rs"]
mod tests;

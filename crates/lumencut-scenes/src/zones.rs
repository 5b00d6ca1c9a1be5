//! Depths and zones as input for filters, made without a tree.

use crate::random::Random;

/// A depth and a zone per pixel: an uneven surface with jumps, in zones of all shapes.
#[derive(Clone, Debug)]
pub struct Zones {
    /// The depth of each pixel, from −300 to 300 mm.
    pub depth: Vec<f32>,
    /// The zone of each pixel, from 0 to 2.
    pub vessel: Vec<i32>,
}

impl Zones {
    pub fn new(seed: u64, [width, height]: [usize; 2]) -> Self {
        const BLOCK: usize = 5;
        let mut random = Random::new(seed);
        let across = width.div_ceil(BLOCK) + 1;
        let blocks = across * (height.div_ceil(BLOCK) + 1);
        let zones: Vec<i32> = (0..blocks).map(|_| random.between(0.0, 3.0) as i32).collect();
        let leaps: Vec<f32> = (0..blocks).map(|_| if random.once_in(4) { 40.0 } else { 0.0 }).collect();
        let (mut depth, mut vessel) = (Vec::new(), Vec::new());
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            // Blocks of zones are offset from blocks of depths, and some zones are single pixels.
            let zone = zones[y / BLOCK * across + (x + y % 2) / BLOCK];
            let wave = 240.0 * (0.02 * x as f32).sin() * (0.03 * y as f32 + 0.5).cos();
            depth.push(wave + leaps[(y + 2) / BLOCK * across + (x + 3) / BLOCK] + random.between(-0.4, 0.4));
            vessel.push(if random.once_in(40) { (zone + 1) % 3 } else { zone });
        }
        Self { depth, vessel }
    }
}

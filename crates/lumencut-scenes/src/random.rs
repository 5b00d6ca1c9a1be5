//! Reproducible random numbers.

use glam::DVec3;
use lumencut_phantom::random::{hash, uniform};

#[derive(Clone, Debug)]
pub struct Random {
    seed: u64,
    place: u64,
}

impl Random {
    pub fn new(seed: u64) -> Self {
        Self { seed: hash(seed, 1), place: 0 }
    }

    pub fn number(&mut self) -> f64 {
        self.place += 1;
        uniform(self.seed, self.place)
    }

    /// The next point in the cube [−1, 1)³.
    pub fn next_point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number()) * 2.0 - 1.0
    }

    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.number() as f32
    }

    /// Returns true once in `n` times on average.
    pub fn once_in(&mut self, n: u32) -> bool {
        self.number() * f64::from(n) < 1.0
    }

    /// An image of numbers from `low` to `high`.
    pub fn image(&mut self, pixels: usize, low: f32, high: f32) -> Vec<f32> {
        (0..pixels).map(|_| self.between(low, high)).collect()
    }
}

//! What rays are reduced to. The shader follows each ray on its own; on the CPU sixteen are followed together, by
//! `stages/along_rays.rs`.

/// What is kept of the values along a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// The largest.
    Largest,
    /// The smallest.
    Smallest,
    /// The mean, each value weighted with the length that it takes of the ray.
    Mean,
}

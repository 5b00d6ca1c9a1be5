//! The stages as WGSL, each next to its Rust file; nothing else in this crate concerns GPUs.

/// A module's shader.
#[derive(Clone, Copy, Debug)]
pub struct Shader {
    /// The module, such as `stages/depth`.
    pub room: &'static str,
    /// WGSL; lines `// import MODULE` name the modules whose declarations it uses.
    pub text: &'static str,
}

#[cfg(not(target_arch = "wasm32"))]
macro_rules! shaders {
    ($($(#[$when:meta])? $room:literal),* $(,)?) => {
        &[$($(#[$when])? Shader { room: $room, text: include_str!(concat!($room, ".wgsl")) }),*]
    };
}

/// Builds for browsers include the shaders without comments (`build.rs`).
#[cfg(target_arch = "wasm32")]
macro_rules! shaders {
    ($($(#[$when:meta])? $room:literal),* $(,)?) => {
        &[$($(#[$when])? Shader { room: $room, text: include_str!(concat!(env!("OUT_DIR"), "/", $room, ".wgsl")) }),*]
    };
}

/// The shaders of all modules. Browsers make endoscopies on the CPU.
pub const SHADERS: &[Shader] = shaders![
    "math/accumulate",
    "math/blocks",
    "math/candidates",
    "math/cell_walk",
    "math/context_parameters",
    "math/cost",
    "math/cubic",
    "math/hierarchy",
    "math/lanes",
    "math/leaps",
    "math/levels",
    "math/light",
    "math/nearest",
    "math/own_pieces",
    "math/pieces",
    "math/projection",
    "math/ray",
    "math/reduce",
    "math/sampling",
    "math/thickness",
    "math/tile",
    "math/trace",
    "math/transfer",
    #[cfg(not(target_arch = "wasm32"))]
    "math/tube",
    "math/view",
    "math/walk",
    "math/walls",
    "math/whole_curve",
    "math/window",
    #[cfg(not(target_arch = "wasm32"))]
    "reformations/endoscopy/wall",
    "stages/body",
    "stages/composite",
    "stages/context",
    "stages/depth",
    "stages/depth_filter",
    "stages/distance",
    "stages/far_rim",
    "stages/focus",
    "stages/leap",
    "stages/occlusion",
    "stages/rim",
    "stages/silhouette",
    "stages/steady",
    "stages/surface",
];

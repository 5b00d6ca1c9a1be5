//! The rules of the cut surface that are chosen by name.

use crate::named::Named;

/// The rule that decides to which vessel a pixel's levels of detail belong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelChoice {
    /// The vessel that the pixel shows at the finest level, so one decision for each pixel.
    Own,
    /// At each level the vessel with the smallest cost, which may change (paper section 3.1.4).
    Nearest,
}

impl Named for LevelChoice {
    const NAMES: &'static [(&'static str, Self)] = &[("own", Self::Own), ("nearest", Self::Nearest)];
}

/// The distance that the cost of a piece counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistanceRule {
    /// To the segment or point of the piece.
    Local,
    /// To the nearest point of its entire vessel (paper Eq. 2).
    WholeCurve,
}

impl Named for DistanceRule {
    const NAMES: &'static [(&'static str, Self)] =
        &[("local", Self::Local), ("whole curve", Self::WholeCurve)];
}

/// The values that a rim around the vessels shows by colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RimValue {
    /// The diameter of the lumen (mm).
    Diameter,
    /// By how much a graded stenosis is narrower than its reference (%).
    Narrowing,
    /// The diameter minus that of the reference of a graded stenosis (mm).
    Deviation,
    /// The standard deviation of the measured diameter (mm).
    Uncertainty,
}

impl Named for RimValue {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("diameter", Self::Diameter),
        ("narrowing", Self::Narrowing),
        ("deviation", Self::Deviation),
        ("uncertainty", Self::Uncertainty),
    ];
}

/// How a picture shows the walls of the vessel tree, besides cutting them open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeShown {
    /// Not at all.
    Hidden,
    /// As wires over the picture: rings across the vessels and lines along them.
    Wireframe,
}

impl Named for TreeShown {
    const NAMES: &'static [(&'static str, Self)] =
        &[("hidden", Self::Hidden), ("wireframe", Self::Wireframe)];
}

/// The rule that decides where silhouettes are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SilhouetteRule {
    /// Lines lie between neighbours whose depths do not belong to one surface.
    Leap,
    /// Lines lie where the depth is steep, mostly at borders of influence zones (paper section 3.3.5).
    Gradient,
}

impl Named for SilhouetteRule {
    const NAMES: &'static [(&'static str, Self)] = &[("leap", Self::Leap), ("gradient", Self::Gradient)];
}

//! The profile of a vessel: its lumen at each arc length.

pub(crate) mod bright_wall;
pub mod by_hand;
pub mod cross_section;
pub mod flap_stretch;
pub(crate) mod lung;
pub mod measuring;
pub mod outer_volume;
pub(crate) mod prepared;
pub mod radii;
pub mod request;
pub mod stretch;
pub(crate) mod unsure_spread;

use glam::{DVec2, DVec3};

use crate::measure::fit::Fit;
use crate::measure::fit::sections::{Section, center};
use crate::measure::flap::OnLine;
use crate::measure::flap::found::{Flap, LumenPair};
use crate::measure::model::contour::inscribed;
use crate::measure::model::ellipse::Ellipse;
use crate::measure::model::wall::Wall;
use crate::measure::outer::Inner;
use crate::measure::outer::found::{Outer, OuterWall};
use crate::measure::section::SectionPlane;
use crate::measure::section::flags::{CALCIUM, LEFT_OUT, METAL};
use crate::measure::section::rays::RAYS;
use crate::measure::section::scale::Scale;
use crate::measure::uncertainty::Parts;
use crate::measure::wall::WallSource;
use crate::measure::wall::tree::VesselWall;
use lumencut_core::polarity::Polarity;

/// Number of points of a contour; a section without a lumen has none.
pub const CONTOUR_POINTS: usize = RAYS;

/// Where the width of the point spread comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// Given by the caller.
    Given,
    /// Estimated on wide parts of the vessel.
    Estimated {
        /// Description of the sections used.
        on: String,
    },
    /// Assumed, because it was neither given nor could be estimated.
    Assumed {
        /// Description of what the assumption is based on.
        from: String,
    },
}

/// The point spread of a scanner.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSpread {
    /// FWHM (mm).
    pub fwhm: f64,
    /// Standard deviation of the FWHM (mm); 0 if the FWHM was given.
    pub deviation: f64,
    /// Where the width comes from.
    pub source: Source,
    /// In lung, the FWHM (mm) if the wall is too thin to be seen.
    pub(crate) without_wall: Option<f64>,
}

/// The lumen of a vessel at each arc length. Values are NaN if not measured.
#[derive(Clone, Debug)]
pub struct Profile {
    /// Arc length of each section (mm).
    pub arc_length: Vec<f64>,
    /// Shortest diameter of each lumen (mm).
    pub diameter_min: Vec<f64>,
    /// Longest diameter of each lumen (mm).
    pub diameter_max: Vec<f64>,
    /// Area of each lumen (mm²).
    pub area: Vec<f64>,
    /// Standard deviation of the equivalent diameter (mm).
    pub uncertainty: Vec<f64>,
    /// Parts of the standard deviation of the equivalent diameter (mm).
    pub uncertainty_parts: Vec<Parts>,
    /// Wall thickness and its standard deviation (mm); NaN if the wall is not visible.
    pub wall: Vec<[f64; 2]>,
    /// Equivalent diameter of the outer wall and its standard deviation (mm); NaN if the wall is not visible.
    pub diameter_outer: Vec<[f64; 2]>,
    /// Whether the outside of a wall that is thick because of thrombus or plaque is visible.
    pub outer_wall: Vec<OuterWall>,
    /// Points of that outer wall (mm, LPS), one per ray; empty if it is not visible.
    pub outer_contour: Vec<Vec<DVec3>>,
    /// Whether both lumens of a dissected vessel are visible.
    pub flap: Vec<Flap>,
    /// Contour of the lumen in which the line lies, if both are visible (mm, LPS), else empty.
    pub own_lumen: Vec<Vec<DVec3>>,
    /// Contour of the other lumen behind the flap (mm, LPS), else empty.
    pub other_lumen: Vec<Vec<DVec3>>,
    /// Area within `own_lumen` and its standard deviation (mm²), else NaN.
    pub area_own_lumen: Vec<[f64; 2]>,
    /// Area within `other_lumen` and its standard deviation (mm²), else NaN.
    pub area_other_lumen: Vec<[f64; 2]>,
    /// Equivalent diameter (mm) without, and with, the bright material at the wall; NaN if there is no such material.
    pub bounds: Vec<[f64; 2]>,
    /// Largest diameter (mm) that the values allow where the lumen of a tight stenosis is dim and does not count, else NaN.
    pub at_most: Vec<f64>,
    /// Flags of each section; see [`crate::measure::section::flags`].
    pub flags: Vec<u32>,
    /// Centre of the lumen (mm, LPS); the centerline point if no lumen was found.
    pub center: Vec<DVec3>,
    /// Unit vector along the vessel, perpendicular to the section.
    pub normal: Vec<DVec3>,
    /// Unit vectors within the section (LPS) that point right and down in its image.
    pub axes: Vec<[DVec3; 2]>,
    /// Points of the wall (mm, LPS), one per ray.
    pub contour: Vec<Vec<DVec3>>,
    /// Vectors from the centre to the ends of the shortest and the longest diameter (mm, LPS).
    pub half_axes: Vec<[DVec3; 2]>,
    /// Radius of the largest ball around the centre that fits into the lumen (mm).
    pub inscribed_radius: Vec<f64>,
    /// Intensity levels of lumen and background, in the volume's unit.
    pub levels: Vec<[f64; 2]>,
    /// Noise of a voxel, in the volume's unit.
    pub noise: f64,
    /// FWHM of the point spread (mm).
    pub fwhm: f64,
    /// Standard deviation of the FWHM (mm); 0 if the FWHM was given.
    pub fwhm_deviation: f64,
    /// Where the FWHM comes from.
    pub fwhm_source: Source,
    /// Whether walls were modelled, and where their level comes from.
    pub wall_source: WallSource,
    /// Points of the centerline at the sections (mm, LPS).
    pub on_vessel: Vec<DVec3>,
    /// Value of the volume on the centerline at each section.
    pub line_values: Vec<f64>,
    /// End parts that were not measured because lumen and surroundings look alike (arc lengths, mm).
    pub without_wall: Vec<[f64; 2]>,
}

impl Profile {
    /// Whether most sections have a lumen that is brighter, or darker, than its surroundings.
    pub fn polarity(&self) -> Polarity {
        let count = |is: fn(&f64, &f64) -> bool| {
            self.levels.iter().filter(|[lumen, around]| is(lumen, around)).count()
        };
        if count(f64::lt) > count(f64::gt) { Polarity::Dark } else { Polarity::Bright }
    }

    pub(crate) fn new(
        places: &[SectionPlane],
        sections: &[Section],
        scale: &Scale,
        noise: f64,
        spread: PointSpread,
        wall_source: WallSource,
    ) -> Self {
        let number = |of: &dyn Fn(&Fit) -> f64| -> Vec<f64> {
            sections.iter().map(|section| section.fit.as_ref().map_or(f64::NAN, of)).collect()
        };
        let middle = |n: usize| sections[n].fit.map_or(places[n].origin, |fit: Fit| center(&places[n], &fit));
        let arc_length: Vec<f64> = places.iter().map(|place| place.at).collect();
        let flags: Vec<u32> = sections.iter().map(|section| section.flags).collect();
        let center: Vec<DVec3> = (0..places.len()).map(middle).collect();
        let contour: Vec<Vec<DVec3>> = sections.iter().map(|section| section.contour.clone()).collect();
        let axis = |fit: &Fit, n: usize| 2.0 * fit.ellipse.semi_axes()[n];
        Self {
            diameter_min: number(&|fit| axis(fit, 0)),
            diameter_max: number(&|fit| axis(fit, 1)),
            area: number(&|fit| fit.ellipse.area()),
            uncertainty: number(&|fit| fit.uncertainty),
            uncertainty_parts: sections
                .iter()
                .map(|section| section.fit.map_or(Parts::unknown(), |fit| fit.parts))
                .collect(),
            wall: sections.iter().zip(&flags).map(wall).collect(),
            diameter_outer: sections.iter().zip(&flags).map(outer).collect(),
            outer_wall: vec![OuterWall::NoLevel; places.len()],
            outer_contour: vec![Vec::new(); places.len()],
            flap: vec![Flap::NoLevel; places.len()],
            own_lumen: vec![Vec::new(); places.len()],
            other_lumen: vec![Vec::new(); places.len()],
            area_own_lumen: vec![[f64::NAN; 2]; places.len()],
            area_other_lumen: vec![[f64::NAN; 2]; places.len()],
            bounds: sections.iter().map(|section| section.bounds).collect(),
            at_most: sections.iter().map(|section| section.at_most).collect(),
            flags,
            normal: places.iter().map(|place| place.normal).collect(),
            axes: places.iter().map(|place| place.axes).collect(),
            half_axes: (0..places.len()).map(|n| half_axes(&places[n], sections[n].fit.as_ref())).collect(),
            inscribed_radius: inscribed(&arc_length, &center, &contour),
            levels: sections
                .iter()
                .map(|section| {
                    section.fit.map_or([f64::NAN; 2], |fit| {
                        [fit.lumen[0], fit.background].map(|share| scale.value(share))
                    })
                })
                .collect(),
            on_vessel: places.iter().map(|place| place.origin).collect(),
            noise,
            fwhm: spread.fwhm,
            fwhm_deviation: spread.deviation,
            fwhm_source: spread.source,
            wall_source,
            line_values: vec![f64::NAN; places.len()],
            without_wall: Vec::new(),
            arc_length,
            center,
            contour,
        }
    }

    /// Includes the outer walls of thick walls, which replace those of the fit.
    pub(crate) fn with_outer(mut self, found: Vec<Outer>) -> Self {
        for (n, one) in found.into_iter().enumerate() {
            if one.found == OuterWall::Seen {
                self.diameter_outer[n] = one.diameter;
            }
            self.outer_wall[n] = one.found;
            self.outer_contour[n] = one.contour;
        }
        self
    }

    /// The sections as the search for outer walls needs them; `places` are theirs.
    pub(crate) fn inner<'a>(&'a self, places: &'a [SectionPlane]) -> Vec<Inner<'a>> {
        let none = |n: usize| {
            let is_lumen = self.counts(n) && !self.contour[n].is_empty();
            let metal = (self.flags[n] & METAL != 0).then_some(OuterWall::Metal);
            if is_lumen { metal } else { Some(OuterWall::NotCounted) }
        };
        let one = |n: usize| Inner {
            place: &places[n],
            contour: &self.contour[n],
            lumen: self.levels[n][0],
            none: none(n),
        };
        (0..self.len()).map(one).collect()
    }

    /// Includes the lumens on both sides of a flap.
    pub(crate) fn with_lumen_pairs(mut self, found: Vec<LumenPair>) -> Self {
        for (n, one) in found.into_iter().enumerate() {
            self.flap[n] = one.found;
            [self.own_lumen[n], self.other_lumen[n]] = one.contours;
            [self.area_own_lumen[n], self.area_other_lumen[n]] = one.areas;
        }
        self
    }

    /// The sections as the search for flaps needs them; `places` are theirs, `lumen` is the level of a lumen where none was
    /// fitted.
    pub(crate) fn on_line<'a>(&self, places: &'a [SectionPlane], lumen: f64) -> Vec<OnLine<'a>> {
        let one = |n: usize| {
            let [level, _] = self.levels[n];
            OnLine {
                place: &places[n],
                lumen: if level.is_finite() { level } else { lumen },
                none: (self.flags[n] & METAL != 0).then_some(Flap::Metal),
            }
        };
        (0..self.len()).map(one).collect()
    }

    /// Areas of both lumens of a dissected vessel together, and their standard deviations (mm²), per section.
    pub fn area_both_lumens(&self) -> Vec<[f64; 2]> {
        let both = |(a, b): (&[f64; 2], &[f64; 2])| [a[0] + b[0], a[1] + b[1]];
        self.area_own_lumen.iter().zip(&self.area_other_lumen).map(both).collect()
    }

    /// Number of sections.
    pub fn len(&self) -> usize {
        self.arc_length.len()
    }

    /// Always false: a profile has at least one section.
    pub fn is_empty(&self) -> bool {
        self.arc_length.is_empty()
    }

    /// Diameter of a circle with the area of the lumen (mm), per section.
    pub fn diameter_equivalent(&self) -> Vec<f64> {
        self.area.iter().map(|area| 2.0 * (area / std::f64::consts::PI).sqrt()).collect()
    }

    /// Mean of the shortest and the longest diameter (mm), per section.
    pub fn diameter_mean(&self) -> Vec<f64> {
        self.diameter_min.iter().zip(&self.diameter_max).map(|(a, b)| f64::midpoint(*a, *b)).collect()
    }

    /// Index of the section nearest to an arc length (mm); the first one of two equally near ones.
    pub fn nearest_section(&self, at: f64) -> usize {
        let away = |n: &usize| (self.arc_length[*n] - at).abs();
        (0..self.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
    }

    /// Plane of section `n`.
    pub fn place(&self, n: usize) -> SectionPlane {
        SectionPlane {
            at: self.arc_length[n],
            origin: self.on_vessel[n],
            axes: self.axes[n],
            normal: self.normal[n],
        }
    }

    /// Length of the vessel (mm).
    pub fn length(&self) -> f64 {
        self.arc_length.last().copied().unwrap_or(0.0)
    }

    /// Whether a section may be chosen as the widest, narrowest or a suggested place.
    pub fn counts(&self, n: usize) -> bool {
        self.flags[n] & LEFT_OUT == 0 && self.area[n].is_finite()
    }
}

/// Walls are reported only if the standard deviation of the logarithm of their thickness is at most this.
const MAX_WALL_DEVIATION: f64 = 0.35;

/// Maximum thickness of a reported wall (mm); thicker layers are thrombus or other tissue.
const THICKEST_WALL: f64 = 3.0;

/// No wall is reported in sections with these flags.
const WALL_HIDDEN: u32 = LEFT_OUT | CALCIUM | METAL;

fn wall((section, flags): (&Section, &u32)) -> [f64; 2] {
    let wall = section.fit.and_then(|fit| fit.wall);
    let is_measured_wall =
        |wall: &Wall| wall.log_thickness[1] <= MAX_WALL_DEVIATION && wall.thickness() < THICKEST_WALL;
    let wall = wall.filter(|wall| is_measured_wall(wall) && flags & WALL_HIDDEN == 0);
    wall.map_or([f64::NAN; 2], |wall| [wall.thickness(), wall.thickness() * wall.log_thickness[1]])
}

fn outer((section, flags): (&Section, &u32)) -> [f64; 2] {
    let [thickness, unsure] = wall((section, flags));
    section.fit.map_or([f64::NAN; 2], |fit| {
        let around = Ellipse { mean: fit.ellipse.mean + thickness, ..fit.ellipse };
        let is_measured_wall = thickness.is_finite();
        let diameter = if is_measured_wall { around.equivalent_diameter() } else { f64::NAN };
        [diameter, (2.0 * unsure).hypot(fit.uncertainty)]
    })
}

fn half_axes(place: &SectionPlane, fit: Option<&Fit>) -> [DVec3; 2] {
    fit.map_or([DVec3::NAN; 2], |fit| half_axes_of(place, &fit.ellipse))
}

pub(crate) fn half_axes_of(place: &SectionPlane, ellipse: &Ellipse) -> [DVec3; 2] {
    ellipse.half_axes().map(|axis: DVec2| place.axes[0] * axis.x + place.axes[1] * axis.y)
}

/// Values estimated on a tree that apply to all its vessels.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeFindings {
    /// Point spread of the scan.
    pub spread: PointSpread,
    /// Wall levels of the vessels whose walls are visible.
    pub(crate) walls: Vec<VesselWall>,
}

//! The profile of a vessel: its lumen by arc length.

use glam::{DVec2, DVec3};

use super::blooming::join_rings;
use super::contour::inscribed;
use super::ellipse::Ellipse;
use super::fit::Fit;
use super::flags::{CALCIUM, LEFT_OUT, METAL};
use super::parts::Parts;
use super::place::Place;
use super::scale::Scale;
use super::sections::{Section, center};
use super::wall::Wall;
use super::wall_level::WallSource;

/// Where the width of the point spread is from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// The caller gave it.
    Given,
    /// It was estimated on wide stretches of the vessel.
    Estimated {
        /// What it was estimated on.
        on: String,
    },
    /// Nothing told it.
    Assumed {
        /// From what it was assumed.
        from: String,
    },
}

/// The point spread of a scanner.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSpread {
    /// Its full width at half maximum (mm).
    pub fwhm: f64,
    /// The standard deviation of that (mm); 0 where it was given.
    pub deviation: f64,
    /// Where it is from.
    pub source: Source,
}

/// The lumen of a vessel by arc length. What could not be measured is NaN.
#[derive(Clone, Debug)]
pub struct Profile {
    /// Arc length on the vessel (mm).
    pub arc_length: Vec<f64>,
    /// The shortest diameter (mm).
    pub diameter_min: Vec<f64>,
    /// The longest diameter (mm).
    pub diameter_max: Vec<f64>,
    /// The area (mm²).
    pub area: Vec<f64>,
    /// The standard deviation of the diameter of a circle of the same area (mm).
    pub uncertainty: Vec<f64>,
    /// What that is made of (mm).
    pub uncertainty_parts: Vec<Parts>,
    /// The thickness of the wall and its standard deviation (mm); NaN where it is not told apart.
    pub wall: Vec<[f64; 2]>,
    /// The diameter of a circle of the area that the wall encloses, and its standard deviation (mm); NaN where the wall is.
    pub diameter_outer: Vec<[f64; 2]>,
    /// The diameter of a circle of the same area (mm) if nothing that is brighter than lumen at its wall is lumen, and if all of it is;
    /// NaN where nothing is brighter.
    pub bounds: Vec<[f64; 2]>,
    /// What there is to know of each section; see [`super::flags`].
    pub flags: Vec<u32>,
    /// The middle of the lumen (mm, LPS); the vessel's point where there is none.
    pub center: Vec<DVec3>,
    /// The unit vector along the vessel, across which the section lies.
    pub normal: Vec<DVec3>,
    /// Two unit vectors in the plane of each section (LPS): to the right and downwards in a picture of it.
    pub axes: Vec<[DVec3; 2]>,
    /// The points of the wall (mm, LPS), one for each ray.
    pub contour: Vec<Vec<DVec3>>,
    /// From the middle to the ends of the shortest and of the longest diameter (mm, LPS).
    pub half_axes: Vec<[DVec3; 2]>,
    /// The radius of the largest ball around the middle within the lumen (mm).
    pub inscribed_radius: Vec<f64>,
    /// The level of the lumen and that of its background, in the volume's unit.
    pub levels: Vec<[f64; 2]>,
    /// The noise of a voxel, in the volume's unit.
    pub noise: f64,
    /// The full width at half maximum of the point spread (mm).
    pub fwhm: f64,
    /// The standard deviation of that (mm); 0 where it was given.
    pub fwhm_deviation: f64,
    /// Where that is from.
    pub fwhm_source: Source,
    /// Whether walls were told apart from what surrounds the vessel, and by which level.
    pub wall_source: WallSource,
    /// The points of the vessel's places (mm, LPS).
    pub on_vessel: Vec<DVec3>,
    /// Stretches at the ends of the vessel that were not measured, as nothing tells lumen from its surroundings there (arc lengths,
    /// mm); none of most vessels. See [`super::measured_part`].
    pub without_wall: Vec<[f64; 2]>,
}

impl Profile {
    /// The profile of sections at places; the noise is in the volume's unit.
    pub fn new(
        places: &[Place],
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
        let mut flags: Vec<u32> = sections.iter().map(|section| section.flags).collect();
        join_rings(&arc_length, &mut flags);
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
            bounds: sections.iter().map(|section| section.bounds).collect(),
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
            without_wall: Vec::new(),
            arc_length,
            center,
            contour,
        }
    }

    /// How many sections there are.
    pub fn len(&self) -> usize {
        self.arc_length.len()
    }

    /// Whether there are none, which never is.
    pub fn is_empty(&self) -> bool {
        self.arc_length.is_empty()
    }

    /// The diameter of a circle of the same area (mm).
    pub fn diameter_equivalent(&self) -> Vec<f64> {
        self.area.iter().map(|area| 2.0 * (area / std::f64::consts::PI).sqrt()).collect()
    }

    /// The mean of the shortest and the longest diameter (mm).
    pub fn diameter_mean(&self) -> Vec<f64> {
        self.diameter_min.iter().zip(&self.diameter_max).map(|(a, b)| f64::midpoint(*a, *b)).collect()
    }

    /// The number of the section that is nearest to an arc length (mm), the first of two.
    pub fn nearest_section(&self, at: f64) -> usize {
        let away = |n: &usize| (self.arc_length[*n] - at).abs();
        (0..self.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
    }

    /// The plane in which a section was measured.
    pub fn place(&self, n: usize) -> Place {
        Place {
            at: self.arc_length[n],
            origin: self.on_vessel[n],
            axes: self.axes[n],
            normal: self.normal[n],
        }
    }

    /// The length of the vessel (mm).
    pub fn length(&self) -> f64 {
        self.arc_length.last().copied().unwrap_or(0.0)
    }

    /// Whether a section counts for what is largest, narrowest or suggested.
    pub fn counts(&self, n: usize) -> bool {
        self.flags[n] & LEFT_OUT == 0 && self.area[n].is_finite()
    }
}

/// A wall is told where the standard deviation of the logarithm of its thickness is at most this.
const WALL_TOLD: f64 = 0.35;

/// What is thicker (mm) is no wall, but a thrombus or another tissue.
const THICKEST_TOLD: f64 = 3.0;

/// Beside these the thickness of the wall is not told.
const WALL_HIDDEN: u32 = LEFT_OUT | CALCIUM | METAL;

/// The thickness of the wall of a section and its standard deviation (mm).
fn wall((section, flags): (&Section, &u32)) -> [f64; 2] {
    let told = section.fit.and_then(|fit| fit.wall);
    let is_told = |wall: &Wall| wall.log_thickness[1] <= WALL_TOLD && wall.thickness() < THICKEST_TOLD;
    let told = told.filter(|wall| is_told(wall) && flags & WALL_HIDDEN == 0);
    told.map_or([f64::NAN; 2], |wall| [wall.thickness(), wall.thickness() * wall.log_thickness[1]])
}

/// The diameter of a circle of the area within the wall of a section, and its standard deviation (mm).
fn outer((section, flags): (&Section, &u32)) -> [f64; 2] {
    let [thickness, unsure] = wall((section, flags));
    section.fit.map_or([f64::NAN; 2], |fit| {
        let around = Ellipse { mean: fit.ellipse.mean + thickness, ..fit.ellipse };
        let is_told = thickness.is_finite();
        let diameter = if is_told { around.equivalent_diameter() } else { f64::NAN };
        [diameter, (2.0 * unsure).hypot(fit.uncertainty)]
    })
}

/// The shorter and the longer half axis of a lumen (mm, LPS).
fn half_axes(place: &Place, fit: Option<&Fit>) -> [DVec3; 2] {
    let in_world = |axis: DVec2| place.axes[0] * axis.x + place.axes[1] * axis.y;
    fit.map_or([DVec3::NAN; 2], |fit| fit.ellipse.half_axes().map(in_world))
}

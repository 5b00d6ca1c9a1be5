//! Curvicircular feature aggregation (CFA) of a straightened vessel. Each pixel aggregates the values of a half circle on its side
//! of the vessel (our reading of Mistelbauer et al. 2013, DOI 10.1111/cgf.12110).

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::Cpr;

/// The number that is computed from the values of a half circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feature {
    /// The largest value.
    Max,
    /// The mean.
    Mean,
    /// The smallest value.
    Min,
    /// Largest minus smallest value: how uneven the surroundings are.
    Range,
    /// The fraction of values above this level, 0 to 1.
    Share(f64),
}

impl Feature {
    /// The feature named `max`, `mean`, `min`, `range` or `share`; only `share` has a level. Fails with
    /// [`ErrorKind::Settings`] for an unknown name, a share without a finite level, or a level for another feature.
    pub fn named(name: &str, level: Option<f64>) -> Result<Self> {
        let wrong = |subject: &str, found: String, expected: &str| {
            Err(Error::new(ErrorKind::Settings, subject, found, expected))
        };
        let subject = "level of the CFA";
        match (name, level) {
            ("share", Some(level)) if level.is_finite() => Ok(Self::Share(level)),
            ("share", Some(level)) => wrong(subject, format!("{level}"), "a finite value of the volume"),
            ("share", None) => {
                wrong(subject, "none".into(), "the value above which the feature 'share' counts")
            }
            ("max" | "mean" | "min" | "range", Some(level)) => {
                wrong(subject, format!("{level} with the feature '{name}'"), "a level with 'share' alone")
            }
            ("max", None) => Ok(Self::Max),
            ("mean", None) => Ok(Self::Mean),
            ("min", None) => Ok(Self::Min),
            ("range", None) => Ok(Self::Range),
            (other, _) => wrong("feature of the CFA", format!("'{other}'"), "max, mean, min, range or share"),
        }
    }

    /// Level and width for pictures of the feature, from those of the volume. A range begins at 0; a share lies between 0 and 1.
    pub fn window(self, [level, width]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Max | Self::Mean | Self::Min => [level, width],
            Self::Range => [width / 2.0, width],
            Self::Share(_) => [0.5, 1.0],
        }
    }

    /// What a value contributes to the mean; for [`Self::Share`], 1 if it is above the level, else 0.
    fn counted(self, value: f64) -> f64 {
        match self {
            Self::Share(level) => f64::from(u8::from(value > level)),
            _ => value,
        }
    }

    /// The index of the value that the feature shows (the first of equal ones); None if it shows no single value or none is known.
    pub fn place(self, values: &[f32]) -> Option<usize> {
        let known = values.iter().enumerate().filter(|(_, value)| !value.is_nan());
        let larger = |best: Option<(usize, f32)>, (n, value): (usize, f32)| {
            if best.is_some_and(|(_, known)| known >= value) { best } else { Some((n, value)) }
        };
        let best = match self {
            Self::Max => known.map(|(n, value)| (n, *value)).fold(None, larger),
            Self::Min => known.map(|(n, value)| (n, -value)).fold(None, larger),
            Self::Mean | Self::Range | Self::Share(_) => None,
        };
        best.map(|(n, _)| n)
    }

    fn shown(self, Gathered { least, most, sum, count }: Gathered) -> f32 {
        if count == 0 {
            return f32::NAN;
        }
        match self {
            Self::Max => most,
            Self::Min => least,
            Self::Range => most - least,
            Self::Mean | Self::Share(_) => (sum / f64::from(count)) as f32,
        }
    }
}

#[derive(Clone, Copy)]
struct Gathered {
    least: f32,
    most: f32,
    sum: f64,
    count: u32,
}

impl Gathered {
    const NOTHING: Self = Self { least: f32::MAX, most: f32::MIN, sum: 0.0, count: 0 };

    fn add(&mut self, feature: Feature, value: f32) {
        self.least = self.least.min(value);
        self.most = self.most.max(value);
        self.sum += feature.counted(f64::from(value));
        self.count += 1;
    }
}

/// Number of directions of a half circle. On the largest half circle, samples are at most `pixel_spacing` (mm) apart. The number is
/// odd, so that the middle direction is that of the straightened vessel.
pub fn angle_count(cpr: &Cpr, pixel_spacing: f64) -> usize {
    let largest = (cpr.size()[0] / 2) as f64 * pixel_spacing;
    ((PI * largest / pixel_spacing).ceil() as usize) | 1
}

/// The rotation of the straightened vessel for each direction (radians).
fn turns(cpr: &Cpr, pixel_spacing: f64) -> impl Iterator<Item = f64> {
    let angles = angle_count(cpr, pixel_spacing);
    (0..angles).map(move |n| (n as f64 - (angles / 2) as f64) / angles as f64 * PI)
}

/// World points of the half circle that a CFA pixel (column, row) aggregates.
pub(crate) fn half_circle(cpr: &Cpr, pixel_spacing: f64, pixel: DVec2) -> Result<Vec<DVec3>> {
    turns(cpr, pixel_spacing).map(|aside| Ok(cpr.rotated(aside)?.world_from_pixel(pixel))).collect()
}

/// The CFA in the layout of `cpr`, row by row; NaN where the half circle lies outside the volume. `look` samples the vessel rotated
/// about itself, on any device.
pub fn feature_aggregation(
    cpr: &Cpr,
    pixel_spacing: f64,
    feature: Feature,
    mut look: impl FnMut(&Cpr) -> Result<Vec<f32>>,
) -> Result<Vec<f32>> {
    let [width, height] = cpr.size();
    let mut gathered = vec![Gathered::NOTHING; width * height];
    for aside in turns(cpr, pixel_spacing) {
        let values = look(&cpr.rotated(aside)?)?;
        for (kept, value) in gathered.iter_mut().zip(values) {
            if !value.is_nan() {
                kept.add(feature, value);
            }
        }
    }
    Ok(gathered.into_iter().map(|gathered| feature.shown(gathered)).collect())
}

//! Curvicircular feature aggregation (CFA) of a straightened vessel: a pixel beside the vessel stands for the half circle on
//! its side, so that whatever lies around the vessel shows without turning it (Mistelbauer et al. 2013,
//! DOI 10.1111/cgf.12110, in our reading).

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::Cpr;

/// What of a half circle is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feature {
    /// The largest value.
    Max,
    /// The mean.
    Mean,
    /// The smallest value.
    Min,
    /// By how much the largest exceeds the smallest: how uneven the surroundings are.
    Range,
    /// How much of the half circle lies above this level, from 0 to 1.
    Share(f64),
}

impl Feature {
    /// The feature of this name: `max`, `mean`, `min`, `range` or `share`, which alone has a level.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for another name, a share without a finite level, and a level without a share.
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

    /// The level and width in which the feature is shown where the values of the volume are shown in those given: a range begins
    /// at 0, and a share lies between 0 and 1.
    pub fn window(self, [level, width]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Max | Self::Mean | Self::Min => [level, width],
            Self::Range => [width / 2.0, width],
            Self::Share(_) => [0.5, 1.0],
        }
    }

    /// What counts in the mean of the feature: a share counts which values lie above its level.
    fn counted(self, value: f64) -> f64 {
        match self {
            Self::Share(level) => f64::from(u8::from(value > level)),
            _ => value,
        }
    }

    /// Which of the values of a half circle the feature shows, the first of several: the largest or the smallest; None for features
    /// that show no single one, and where no value is known.
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

    /// What the pixel shows.
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

/// What is known of the values of a half circle so far.
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

/// How many directions a half circle has in the layout of a straightened vessel: samples on the largest one are no farther apart
/// than a pixel, `pixel_spacing` (mm). The number is odd: the middle direction is that of the straightened vessel itself.
pub fn angle_count(cpr: &Cpr, pixel_spacing: f64) -> usize {
    let largest = (cpr.size()[0] / 2) as f64 * pixel_spacing;
    ((PI * largest / pixel_spacing).ceil() as usize) | 1
}

/// By how much a straightened vessel is turned (radians) for each direction of a half circle.
fn turns(cpr: &Cpr, pixel_spacing: f64) -> impl Iterator<Item = f64> {
    let angles = angle_count(cpr, pixel_spacing);
    (0..angles).map(move |n| (n as f64 - (angles / 2) as f64) / angles as f64 * PI)
}

/// The world points of the half circle that a place in a CFA, column and row, stands for.
///
/// # Errors
/// Those of the layout.
pub(crate) fn half_circle(cpr: &Cpr, pixel_spacing: f64, pixel: DVec2) -> Result<Vec<DVec3>> {
    turns(cpr, pixel_spacing).map(|aside| Ok(cpr.rotated(aside)?.world_from_pixel(pixel))).collect()
}

/// The values of a CFA in the layout of `cpr`, a straightened vessel, row by row; NaN where the whole half circle lies outside the
/// volume. `look` gives the values of the vessel turned about itself, from whatever computes them.
///
/// # Errors
/// Those of the layout and of `look`.
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

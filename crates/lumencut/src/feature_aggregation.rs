//! Curvicircular feature aggregation (CFA) of a straightened vessel: a pixel beside the vessel stands for the half circle on
//! its side, so that whatever lies around the vessel shows without turning it (Mistelbauer et al. 2013,
//! DOI 10.1111/cgf.12110, in our reading).

use std::f64::consts::PI;

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::Cpr;

/// Which value of a half circle is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The largest.
    Max,
    /// The mean.
    Mean,
    /// The smallest.
    Min,
}

impl Feature {
    /// The feature of this name: `max`, `mean` or `min`.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for another name.
    pub fn named(name: &str) -> Result<Self> {
        match name {
            "max" => Ok(Self::Max),
            "mean" => Ok(Self::Mean),
            "min" => Ok(Self::Min),
            other => {
                let found = format!("'{other}'");
                Err(Error::new(ErrorKind::Settings, "feature of the CFA", found, "max, mean or min"))
            }
        }
    }

    fn gathered(self, before: f64, value: f64) -> f64 {
        match self {
            Self::Max => before.max(value),
            Self::Mean => before + value,
            Self::Min => before.min(value),
        }
    }

    fn first(self) -> f64 {
        match self {
            Self::Max => f64::MIN,
            Self::Mean => 0.0,
            Self::Min => f64::MAX,
        }
    }
}

/// How many directions a half circle has in the layout of a straightened vessel: samples on the largest one are no farther apart
/// than a pixel, `pixel_spacing` (mm).
pub fn angle_count(cpr: &Cpr, pixel_spacing: f64) -> usize {
    let largest = (cpr.size()[0] / 2) as f64 * pixel_spacing;
    ((PI * largest / pixel_spacing).ceil() as usize).max(1)
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
    let angles = angle_count(cpr, pixel_spacing);
    let mut gathered = vec![(feature.first(), 0u32); width * height];
    for n in 0..angles {
        let values = look(&cpr.rotated(((n as f64 + 0.5) / angles as f64 - 0.5) * PI)?)?;
        for (kept, value) in gathered.iter_mut().zip(values) {
            if !value.is_nan() {
                *kept = (feature.gathered(kept.0, f64::from(value)), kept.1 + 1);
            }
        }
    }
    let shown = |(value, count): (f64, u32)| match (count, feature) {
        (0, _) => f32::NAN,
        (count, Feature::Mean) => (value / f64::from(count)) as f32,
        _ => value as f32,
    };
    Ok(gathered.into_iter().map(shown).collect())
}

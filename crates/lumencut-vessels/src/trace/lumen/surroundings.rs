//! Derives the lumen model from the values around the clicks, or explains what a click hit instead.

use glam::DVec3;

use crate::trace::lumen::lumen_model::{
    LumenModel, in_words, lower_median, noise_of, quantile, tissue_beside, tissue_level,
};
use crate::voxels::Voxels;
use lumencut_core::error::{Clicked, Error, ErrorKind, Result};
use lumencut_core::polarity::Polarity;

/// A volume is in HU if this fraction of its voxels is below the limit, because fat and air are negative only in CT.
const HOUNSFIELD_SHARE: f64 = 0.01;
const HOUNSFIELD_LIMIT: f64 = -50.0;

/// Upper limits (HU) of air, of fat, and of soft tissue or blood without contrast medium. Values above `BONE`
/// are bone, metal or calcium.
const AIR: f64 = -400.0;
const FAT: f64 = -20.0;
const SOFT_TISSUE: f64 = 100.0;
const BONE: f64 = 900.0;

/// Maximum ratio of the contrasts at two clicks. They may differ, because contrast medium fades.
const MOST_TIMES: f64 = 3.5;

/// Minimum contrast of the lumen in a model, as a fraction of the contrast at the median click.
const LEAST_PART: f64 = 0.6;

/// Minimum level (HU) of tissue: muscle, vessel walls and blood without contrast medium.
const LEAST_TISSUE: f64 = 50.0;

/// Values within this radius around the clicks (mm) are sampled, but no more voxels than `MOST_SAMPLES`.
const SURROUNDINGS: f64 = 30.0;
const MOST_SAMPLES: f64 = 200_000.0;

/// A rejected click is moved to lumen if there is some within this distance (mm).
const SNAP: f64 = 2.0;

/// Minimum fraction of the surroundings that must be darker than the lumen.
const DARKER: f64 = 0.75;

/// Surroundings contain something far brighter than tissue if it exceeds the tissue by this multiple of the noise.
const CLEAR_NOISES: f64 = 8.0;

/// What a click hit that is far brighter, or no brighter, than the lumen. Bone and slow blood are dark in MR.
const CT_MISTAKES: [&str; 2] = ["bone, metal or calcium", "tissue, or blood without contrast medium"];
const OTHER_MISTAKES: [&str; 2] =
    ["something far brighter than the lumen", "tissue, or blood without signal"];
const DARK_MISTAKES: [&str; 2] = ["something far darker than the lumen", "tissue, such as lung"];

type Mistake = (&'static str, String);

/// The values around the clicks, before any click is checked.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings {
    tissue: f64,
    /// The quantiles 0.75 and 0.995 of the values.
    most: f64,
    bright: f64,
    is_hounsfield: bool,
    polarity: Polarity,
}

/// Values at a click: the click's own value, median and spread of the lumen around it, and the noise.
#[derive(Clone, Copy, Debug)]
struct Hit {
    value: f64,
    lumen: f64,
    spread: f64,
    noise: f64,
}

impl Surroundings {
    /// Samples the values around the clicks.
    pub fn of(voxels: &Voxels, clicks: &[DVec3]) -> Self {
        Self::within(voxels, clicks, SURROUNDINGS)
    }

    /// Samples the values up to `reach` mm around the clicks.
    pub fn within(voxels: &Voxels, clicks: &[DVec3], reach: f64) -> Self {
        let samples = samples_around(voxels, clicks, reach);
        // The entire scan is sampled, because a heart contains neither fat nor air.
        let is_hounsfield = voxels.polarity == Polarity::Bright && are_hounsfield(voxels);
        let first = if is_hounsfield { samples.partition_point(|v| f64::from(*v) < AIR) } else { 0 };
        let values: Vec<f64> = clicks.iter().map(|click| value_at(voxels, *click)).collect();
        let around = &samples[first..];
        let level =
            tissue_level(if is_hounsfield { without_blood(around, &values) } else { around }, &values);
        let lumen = values.into_iter().fold(f64::MAX, f64::min);
        let level = tissue_beside(voxels.polarity, lumen, level);
        let tissue = if is_hounsfield { level.max(LEAST_TISSUE) } else { level };
        let [most, bright] = [DARKER, 0.995].map(|share| quantile(around, share));
        Self { tissue, most, bright, is_hounsfield, polarity: voxels.polarity }
    }

    /// Intensity level of the tissue around the lumen.
    pub fn tissue(&self) -> f64 {
        self.tissue
    }

    /// The lumen model of the clicks. Errors: [`ErrorKind::Tracing`] for a click outside lumen. If clicks
    /// disagree, the error names the one least like lumen; if several are equal, the later one.
    pub fn model(&self, voxels: &Voxels, clicks: &[DVec3]) -> Result<LumenModel> {
        for click in clicks {
            self.check_alone(voxels, *click)?;
        }
        let hit = |click: &DVec3| self.hit(voxels, *click, value_at(voxels, *click));
        let hits: Vec<Hit> = clicks.iter().map(hit).collect();
        let usual = lower_median(hits.iter().map(|hit| hit.lumen).collect());
        if hits.iter().any(|hit| self.unlike(hit, usual).is_some()) {
            // If the median click is itself implausible, it must not be the reference.
            for expected in [self.reference_lumen(&hits), usual] {
                for (click, hit) in clicks.iter().zip(&hits) {
                    self.check(voxels, *click, hit.value, self.unlike(hit, expected))?;
                }
            }
        }
        Ok(self.model_of(&hits, usual))
    }

    /// The model at one position; None if [`Surroundings::model`] would reject the position.
    pub(crate) fn model_at(&self, voxels: &Voxels, place: DVec3) -> Option<LumenModel> {
        let value = value_at(voxels, place);
        let hit = self.hit(voxels, place, value);
        let is_lumen = self.mistaken(value).is_none() && self.unlike(&hit, hit.lumen).is_none();
        is_lumen.then(|| self.model_of(&[hit], hit.lumen))
    }

    pub(crate) fn check_alone(&self, voxels: &Voxels, click: DVec3) -> Result<()> {
        let value = value_at(voxels, click);
        self.check(voxels, click, value, self.mistaken(value))
    }

    /// As [`Surroundings::check_alone`], and rejects a first click in values of no known unit that is no brighter than most of
    /// its surroundings, if these contain something far brighter.
    pub(crate) fn check_first(&self, voxels: &Voxels, click: DVec3) -> Result<()> {
        self.check_alone(voxels, click)?;
        let value = value_at(voxels, click);
        let Hit { lumen, noise, .. } = self.hit(voxels, click, value);
        let least = self.least_bright();
        let is_clear = self.bright - self.tissue > CLEAR_NOISES * noise;
        if self.is_hounsfield || !is_clear || lumen > self.most || lumen >= least {
            return Ok(());
        }
        self.check(voxels, click, value, Some((self.mistakes()[1], self.beyond(least))))
    }

    /// What a click hit instead of lumen: something far brighter (darker), or no brighter (darker).
    fn mistakes(&self) -> [&'static str; 2] {
        match self.polarity {
            Polarity::Dark => DARK_MISTAKES,
            Polarity::Bright if self.is_hounsfield => CT_MISTAKES,
            Polarity::Bright => OTHER_MISTAKES,
        }
    }

    fn beyond(&self, least: f64) -> String {
        format!("lumen, {} than {:.0}", self.polarity.brighter(), self.polarity.turned(least))
    }

    /// The least value that surely looks like lumen, if the unit is unknown.
    fn least_bright(&self) -> f64 {
        self.tissue + 0.4 * (self.bright - self.tissue)
    }

    /// Moves rejected clicks to adjacent lumen, which the user probably meant. If there is none, the click stays.
    pub(crate) fn snapped(&self, voxels: &Voxels, clicks: &[DVec3]) -> Vec<DVec3> {
        let is_taken = |place: DVec3| self.mistaken(value_at(voxels, place)).is_none();
        let moved = clicks.iter().map(|click| self.taken(voxels, *click, is_taken));
        let hit = |place: DVec3| self.hit(voxels, place, value_at(voxels, place));
        let (moved, hits): (Vec<DVec3>, Vec<Hit>) = moved.map(|click| (click, hit(click))).unzip();
        let lumens: Vec<Hit> = hits.into_iter().filter(|hit| self.mistaken(hit.value).is_none()).collect();
        let usual = self.reference_lumen(&lumens);
        let is_like = |place: DVec3| self.unlike(&hit(place), usual).is_none();
        moved.into_iter().map(|click| self.taken(voxels, click, is_like)).collect()
    }

    fn taken(&self, voxels: &Voxels, click: DVec3, is_taken: impl Fn(DVec3) -> bool) -> DVec3 {
        let near = if is_taken(click) { None } else { self.nearest_lumen(voxels, click) };
        near.filter(|near| near.distance(click) <= SNAP && is_taken(*near)).unwrap_or(click)
    }

    fn hit(&self, voxels: &Voxels, click: DVec3, value: f64) -> Hit {
        let [lumen, spread] = local_lumen(voxels, click, value, self.tissue);
        Hit { value, lumen, spread, noise: noise(voxels, click) }
    }

    /// Reference lumen of clicks that disagree. It is brighter than most surroundings and similar to most
    /// other clicks. If several are equal, the earliest click is used, because users begin in the vessel.
    fn reference_lumen(&self, hits: &[Hit]) -> f64 {
        let worth = |hit: &Hit| {
            let alike = hits.iter().filter(|other| self.unlike(other, hit.lumen).is_none()).count();
            (hit.lumen > self.most && self.unlike(hit, hit.lumen).is_none(), alike)
        };
        // `max_by_key` returns the last maximum, which is the earliest click here.
        hits.iter().rev().max_by_key(|hit| worth(hit)).map_or(f64::NAN, |hit| hit.lumen)
    }

    fn model_of(&self, hits: &[Hit], usual: f64) -> LumenModel {
        let lumens = || hits.iter().map(|hit| hit.lumen);
        // A click in the throat of a stenosis also hits tissue, so the lowest level is limited.
        let least = self.tissue + LEAST_PART * (usual - self.tissue);
        LumenModel {
            tissue: self.tissue,
            low: lumens().fold(f64::MAX, f64::min).max(least),
            high: lumens().fold(f64::MIN, f64::max),
            noise: hits.iter().map(|hit| hit.spread).fold(0.0, f64::max),
            is_hounsfield: self.is_hounsfield,
            polarity: self.polarity,
        }
    }

    fn check(&self, voxels: &Voxels, click: DVec3, value: f64, mistake: Option<Mistake>) -> Result<()> {
        let Some((tissue, expected)) = mistake else { return Ok(()) };
        let found = format!("{tissue}, about {:.0} around it", self.polarity.turned(value));
        let error = Error::new(ErrorKind::Tracing, format!("point {}", in_words(click)), found, expected);
        // The value that a viewer shows at this place.
        let error = error.about(Clicked::Single).at(click, voxels.shown_at(click));
        Err(match self.nearest_lumen(voxels, click) {
            Some(place) => {
                let away = place.distance(click);
                let nearest = in_words(place);
                let mend = format!("the nearest place that looks like lumen is {nearest}, {away:.1} mm away");
                error.mend(mend).nearest(place)
            }
            None => error.mend("no place within 10 mm looks like lumen"),
        })
    }

    fn mistaken(&self, value: f64) -> Option<Mistake> {
        if !value.is_finite() {
            return Some(("no number", "a finite value".to_owned()));
        }
        let tissue = match value {
            _ if !self.is_hounsfield => return None,
            v if v < AIR => "air",
            v if v < FAT => "fat",
            v if v < SOFT_TISSUE => "soft tissue, or blood without contrast medium",
            v if v > BONE => "bone, metal or calcium",
            _ => return None,
        };
        Some((tissue, format!("lumen with contrast medium, from {SOFT_TISSUE:.0} to {BONE:.0} HU")))
    }

    /// The mistake, if the click is far brighter than the reference lumen or no brighter than tissue.
    fn unlike(&self, hit: &Hit, usual: f64) -> Option<Mistake> {
        let contrast = usual - self.tissue;
        let least = self.tissue + (0.3 * contrast).max(1.5 * hit.noise);
        let [bright, dark] = self.mistakes();
        if hit.lumen - self.tissue > MOST_TIMES * contrast && contrast > 0.0 {
            return Some((
                bright,
                format!("lumen of about {:.0}, as at another point", self.polarity.turned(usual)),
            ));
        }
        // False if the value is NaN.
        let is_bright = hit.lumen > least;
        (!is_bright).then(|| (dark, self.beyond(least)))
    }

    /// The nearest position within 10 mm that is surrounded by lumen values.
    fn nearest_lumen(&self, voxels: &Voxels, click: DVec3) -> Option<DVec3> {
        let (least, most) =
            if self.is_hounsfield { (SOFT_TISSUE * 1.5, BONE) } else { (self.least_bright(), f64::MAX) };
        let is_bright = |value: f32| (least..most).contains(&f64::from(value));
        let mut near = voxels.ball(click, 10.0);
        near.retain(|(_, value)| is_bright(*value));
        near.sort_by(|a, b| a.0.distance_squared(click).total_cmp(&b.0.distance_squared(click)));
        let is_lumen = |place: DVec3| {
            voxels.ball(place, 1.75 * voxels.smallest_side).iter().all(|(_, value)| is_bright(*value))
        };
        near.iter().map(|(place, _)| *place).find(|place| is_lumen(*place))
    }
}

/// Whether the values of a scan look like Hounsfield units.
pub fn are_hounsfield(voxels: &Voxels) -> bool {
    let samples = samples_between(voxels, [0; 3], voxels.size.map(|n| n as i32 - 1));
    let dark = samples.iter().filter(|value| f64::from(**value) < HOUNSFIELD_LIMIT).count();
    dark > 0 && dark as f64 >= HOUNSFIELD_SHARE * samples.len() as f64
}

/// Drops blood with contrast medium from sorted values (HU), because its noise would count as tissue.
fn without_blood<'a>(around: &'a [f32], clicks: &[f64]) -> &'a [f32] {
    let lumen = clicks.iter().copied().filter(|value| value.is_finite()).fold(f64::MAX, f64::min);
    let is_mostly_blood = quantile(around, 0.5) > SOFT_TISSUE && lumen < f64::MAX;
    let end = around.partition_point(|value| f64::from(*value) < f64::midpoint(SOFT_TISSUE, lumen));
    if is_mostly_blood && end > 0 { &around[..end] } else { around }
}

fn samples_around(voxels: &Voxels, clicks: &[DVec3], reach: f64) -> Vec<f32> {
    let (mut first, mut last) = (voxels.size.map(|n| n as i32 - 1), [0; 3]);
    for click in clicks {
        let (low, count) = voxels.around(*click, reach);
        for a in 0..3 {
            first[a] = first[a].min(low[a]);
            last[a] = last[a].max(low[a] + count[a] - 1);
        }
    }
    let mut values = samples_between(voxels, first, last);
    values.sort_unstable_by(f32::total_cmp);
    values
}

fn samples_between(voxels: &Voxels, first: [i32; 3], last: [i32; 3]) -> Vec<f32> {
    let count: f64 = (0..3).map(|a| f64::from(last[a] - first[a] + 1).max(1.0)).product();
    let step = (count / MOST_SAMPLES).cbrt().ceil().max(1.0) as usize;
    let mut values = Vec::new();
    for k in (first[2]..=last[2]).step_by(step) {
        for j in (first[1]..=last[1]).step_by(step) {
            for i in (first[0]..=last[0]).step_by(step) {
                let value = voxels.voxel([i, j, k]);
                if value.is_finite() {
                    values.push(value);
                }
            }
        }
    }
    values
}

pub(crate) fn value_at(voxels: &Voxels, click: DVec3) -> f64 {
    let near = voxels.smallest_side * 1.05;
    let mut values: Vec<f32> =
        voxels.ball(click, near).into_iter().map(|(_, value)| value).filter(|v| v.is_finite()).collect();
    if values.is_empty() {
        return f64::from(voxels.at(click));
    }
    values.sort_unstable_by(f32::total_cmp);
    // A click may lie at the wall, so a quantile above the median is used.
    quantile(&values, 0.6)
}

pub(crate) fn noise(voxels: &Voxels, click: DVec3) -> f64 {
    let near = voxels.ball(click, (4.0 * voxels.smallest_side).max(3.0));
    noise_of(&near.into_iter().map(|(_, value)| value).collect::<Vec<f32>>())
}

fn local_lumen(voxels: &Voxels, click: DVec3, value: f64, tissue: f64) -> [f64; 2] {
    let near = voxels.ball(click, (2.5 * voxels.smallest_side).max(1.5));
    let mut lumen = value;
    let mut spread = 0.0;
    for _ in 0..3 {
        let contrast = (lumen - tissue).abs().max(1e-9);
        let mut values: Vec<f32> = near
            .iter()
            .map(|(_, value)| *value)
            .filter(|v| (-0.35 * contrast..0.6 * contrast).contains(&(f64::from(*v) - lumen)))
            .collect();
        if values.is_empty() {
            break;
        }
        values.sort_unstable_by(f32::total_cmp);
        lumen = quantile(&values, 0.5);
        let mut away: Vec<f32> = values.iter().map(|v| (f64::from(*v) - lumen).abs() as f32).collect();
        away.sort_unstable_by(f32::total_cmp);
        spread = 1.4826 * quantile(&away, 0.5);
    }
    [lumen, spread]
}

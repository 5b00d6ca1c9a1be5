//! Prior knowledge for all sections of a vessel, pooled from sections that were fitted one by one.

use crate::measure::estimation::Level;
use crate::measure::fit::Fit;
use crate::measure::fit::sections::Known;
use crate::measure::model::ellipse::Ellipse;
use crate::measure::model::wall::KnownWall;
use crate::measure::uncertainty::texture::Texture;

pub(crate) struct AllSections {
    pub fits: Vec<Option<Fit>>,
    /// Noise of a voxel (standard deviation), as a fraction of the contrast.
    pub noise: f64,
    pub lumen: Vec<Level>,
    /// The pooled walls; None if walls cannot be separated from the surroundings.
    pub walls: Option<Vec<KnownWall>>,
    pub texture: Texture,
}

impl AllSections {
    /// Prior knowledge of section `n`, and the second solution of its fit ([`Fit::other`]). Only every `every`-th
    /// section was fitted; between these the lumen is interpolated, or is `estimate` if a fit is missing.
    pub(crate) fn known(
        &self,
        n: usize,
        every: usize,
        estimate: Option<Ellipse>,
    ) -> Option<(Known, Option<Ellipse>)> {
        let ([before, after], share) = self.around(n, every);
        let nearest = if share > 0.5 { after } else { before };
        let fitted = self.fits[before].zip(self.fits[after]);
        let between = fitted.map(|(before, after)| before.ellipse.towards(&after.ellipse, share));
        let known = Known {
            ellipse: between.or(estimate)?,
            lumen: self.lumen[nearest],
            noise: Some(self.noise),
            wall: self.walls.as_ref().map(|walls| walls[nearest]),
        };
        Some((known, self.fits[nearest].and_then(|fit| fit.other)))
    }

    /// Level of the lumen at section `n`, as a fraction of the contrast.
    pub(crate) fn lumen_near(&self, n: usize, every: usize) -> f64 {
        let (around, share) = self.around(n, every);
        self.lumen[around[usize::from(share > 0.5)]][0]
    }

    /// The fitted sections before and after section `n`, and how far it lies towards the latter.
    fn around(&self, n: usize, every: usize) -> ([usize; 2], f64) {
        let (before, share) = (n / every, (n % every) as f64 / every as f64);
        ([before, (before + usize::from(share > 0.0)).min(self.fits.len() - 1)], share)
    }
}

#[cfg(test)]
#[path = "tests/all_sections.rs"]
mod tests;

//! What the sections of a vessel that were fitted by themselves tell of all of its sections.

use super::ellipse::Ellipse;
use super::fit::Fit;
use super::pooled::Level;
use super::sections::Known;
use super::texture::Texture;
use super::wall::KnownWall;

/// What sections tell by themselves and together.
pub struct AllSections {
    /// Their fits by themselves.
    pub fits: Vec<Option<Fit>>,
    /// The noise of a voxel, as a share.
    pub noise: f64,
    /// The level of the lumen at each of them, as a share.
    pub lumen: Vec<Level>,
    /// The wall at each of them, where it is told apart.
    pub walls: Option<Vec<KnownWall>>,
    /// The texture of the noise.
    pub texture: Texture,
}

impl AllSections {
    /// What is known of a section of the vessel, of which every so many were fitted by themselves, and where else its lumen may be
    /// ([`Fit::other`]). Its lumen is what lies between those of the fitted sections around it, else about where it looked to be.
    pub fn known(&self, n: usize, every: usize, rough: Option<Ellipse>) -> Option<(Known, Option<Ellipse>)> {
        let (before, share) = (n / every, (n % every) as f64 / every as f64);
        let after = (before + usize::from(share > 0.0)).min(self.fits.len() - 1);
        let nearest = if share > 0.5 { after } else { before };
        let fitted = self.fits[before].zip(self.fits[after]);
        let between = fitted.map(|(before, after)| before.ellipse.towards(&after.ellipse, share));
        let known = Known {
            ellipse: between.or(rough)?,
            lumen: self.lumen[nearest],
            noise: Some(self.noise),
            wall: self.walls.as_ref().map(|walls| walls[nearest]),
        };
        Some((known, self.fits[nearest].and_then(|fit| fit.other)))
    }
}

#[cfg(test)]
#[path = "tests/all_sections.rs"]
mod tests;

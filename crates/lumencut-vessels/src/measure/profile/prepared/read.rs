//! Measures the sections of a vessel with one point spread and wall.

use rayon::prelude::*;

use super::{FirstFits, PreparedVessel, too_noisy};
use crate::measure::along::all_sections::AllSections;
use crate::measure::along::levels::lumen_levels;
use crate::measure::along::throats::Throats;
use crate::measure::estimation::Level;
use crate::measure::fit::sections::{Bench, Doubt, Known, LEAST_CONTRAST, Section, noise};
use crate::measure::model::ellipse::Ellipse;
use crate::measure::model::wall::KnownWall;
use crate::measure::section::blur::Blur;
use crate::measure::wall::pool::pooled;
use crate::measure::wall::tree::PooledWall;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// The sections of a vessel, measured for one point spread and wall.
pub(in crate::measure::profile) struct Read<'a, 'v> {
    pub sections: Vec<Section>,
    pub bench: Bench<'a, 'v>,
    /// Pooled level of the lumen at each section.
    pub lumen: Vec<f64>,
    /// Noise of a voxel, as a fraction of the contrast.
    pub noise: f64,
    /// Number of sections from one with own voxels to the next.
    pub every: usize,
    /// Whether the wall is as bright as its surroundings.
    pub is_wall_hidden: bool,
}

impl PreparedVessel {
    /// Measures all sections with a point spread (FWHM and its standard deviation, mm).
    pub(in crate::measure::profile) fn read<'a, 'v>(
        &self,
        voxels: &'a Voxels<'v>,
        [fwhm, deviation]: Level,
        by_others: Option<PooledWall>,
        stop: Stop,
    ) -> Result<Read<'a, 'v>> {
        let (every, fitted) = self.fitted(voxels, fwhm);
        let first = self.kept_fits(voxels, fwhm, stop)?;
        let hidden = first.hidden;
        let mut bench = self.bench(voxels, fwhm, hidden);
        let all = fitted.all_sections(&bench, first, by_others, stop)?;
        let wider = (deviation > 0.0).then(|| Blur::new(fwhm + deviation, voxels.world_from_index.matrix3));
        bench.doubt = Some(Doubt { texture: all.texture.clone(), wider, wall: hidden });
        let section = |n: usize, lumen: Option<Level>| {
            go_on(stop)?;
            let estimate = self.estimates[n].map(|one| Ellipse::circle(one.center, one.radius));
            Ok(match all.known(n, every, estimate) {
                Some((known, other)) => {
                    let lumen = lumen.unwrap_or(known.lumen);
                    bench.section(&self.places[n], &Known { lumen, ..known }, other)
                }
                None => Section::none(),
            })
        };
        let mut sections: Vec<Section> =
            (0..self.places.len()).into_par_iter().map(|n| section(n, None)).collect::<Result<_>>()?;
        let lumen: Vec<f64> = (0..self.places.len()).map(|n| all.lumen_near(n, every)).collect();
        Throats { bench: &bench, places: &self.places, lumen: &lumen, noise: all.noise }
            .refit(&mut sections, |n, lumen| section(n, Some(lumen)))?;
        Ok(Read { sections, bench, lumen, noise: all.noise, every, is_wall_hidden: hidden.is_some() })
    }

    /// Pools the separate fits of a vessel, and includes the wall level from other vessels.
    fn all_sections(
        &self,
        bench: &Bench,
        first: FirstFits,
        by_others: Option<PooledWall>,
        stop: Stop,
    ) -> Result<AllSections> {
        let FirstFits { fits, texture, .. } = first;
        let noise = noise(&fits);
        if LEAST_CONTRAST * noise > 1.0 {
            return Err(too_noisy(&self.scale, noise));
        }
        let lumen = lumen_levels(bench, &self.places, &fits, stop)?;
        let inflation = self.inflation(bench, &texture);
        let walls = bench.wall.map(|known| {
            let expected = by_others.map_or(known.level, |wall| KnownWall::of(wall.level, &self.scale).level);
            pooled(&self.arc_lengths(), &fits, &known, expected, inflation)
        });
        Ok(AllSections { fits, noise, lumen, walls, texture })
    }
}

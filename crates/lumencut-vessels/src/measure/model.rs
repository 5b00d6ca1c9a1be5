//! Models of a section: lumen, optional wall, and surroundings, each with its own level.

pub(crate) mod contour;
pub mod ellipse;
pub(crate) mod parameters;
pub(crate) mod wall;

use glam::DVec2;

use self::ellipse::{Blurred, Boundary, Ellipse, SHAPE, Whitening};
use self::parameters::{BACKGROUND, HARMONICS, LUMEN, PLAIN, SECTORS, THICKNESS, WALL, WALLED};
use self::wall::Wall;
use lumencut_core::math::lanes::FAN;

/// Range of the wall thickness (mm). Thicker layers are thrombus or other tissue.
const THINNEST: f64 = 0.2;
const THICKEST: f64 = 3.3;

/// Model values at sixteen points (fractions of the contrast), and their derivatives.
pub(crate) struct Modelled<const N: usize> {
    pub share: [f32; FAN],
    /// Derivatives of the values with respect to each parameter.
    pub by: [[f32; FAN]; N],
}

pub(crate) trait Model<const N: usize>: Sized + Sync {
    /// The model for the parameters `at`; directions are measured from `origin` (mm).
    fn new(at: &[f64; N], ellipse: &Ellipse, whitening: Whitening, origin: DVec2) -> Self;

    fn allows(_: &[f64; N]) -> bool {
        true
    }

    fn modelled(&self, x: &[f32; FAN], y: &[f32; FAN]) -> Modelled<N>;
}

pub(crate) struct TwoLevels {
    boundary: Boundary,
    lumen: f32,
    background: f32,
}

impl TwoLevels {
    pub(crate) fn of(ellipse: &Ellipse, [lumen, background]: [f64; 2], whitening: Whitening) -> Self {
        let [lumen, background] = [lumen, background].map(|level| level as f32);
        Self { boundary: Boundary::new(ellipse, whitening), lumen, background }
    }
}

impl Model<PLAIN> for TwoLevels {
    fn new(at: &[f64; PLAIN], ellipse: &Ellipse, whitening: Whitening, _: DVec2) -> Self {
        Self::of(ellipse, [at[LUMEN], at[BACKGROUND]], whitening)
    }

    #[inline(always)]
    fn modelled(&self, x: &[f32; FAN], y: &[f32; FAN]) -> Modelled<PLAIN> {
        let blurred = self.boundary.blurred(x, y);
        let contrast = self.lumen - self.background;
        let mut all = Modelled { share: [0.0; FAN], by: [[0.0; FAN]; PLAIN] };
        for a in 0..SHAPE {
            for l in 0..FAN {
                all.by[a][l] = contrast * blurred.slopes[a][l];
            }
        }
        for l in 0..FAN {
            all.by[LUMEN][l] = blurred.value[l];
            all.by[BACKGROUND][l] = 1.0 - blurred.value[l];
            all.share[l] = self.background + contrast * blurred.value[l];
        }
        all
    }
}

/// The model of a lumen with a wall of constant thickness, in surroundings that differ from side to side.
pub(crate) struct ThreeLevels {
    inner: Boundary,
    outer: Boundary,
    origin: [f32; 2],
    lumen: f32,
    wall: f32,
    thickness: f32,
    background: f32,
    sectors: [f32; HARMONICS],
}

impl ThreeLevels {
    pub(crate) fn of(
        ellipse: &Ellipse,
        wall: &Wall,
        [lumen, background]: [f64; 2],
        whitening: Whitening,
    ) -> Self {
        let mut at = [0.0; WALLED];
        at[..SHAPE].copy_from_slice(&ellipse.parameters());
        (at[LUMEN], at[BACKGROUND]) = (lumen, background);
        (at[THICKNESS], at[WALL]) = (wall.log_thickness[0], wall.level[0]);
        at[SECTORS..].copy_from_slice(&wall.sectors);
        Self::new(&at, ellipse, whitening, wall.origin)
    }

    #[inline(always)]
    fn harmonics(&self, x: f32, y: f32) -> [f32; HARMONICS] {
        let (dx, dy) = (x - self.origin[0], y - self.origin[1]);
        // 1e-6 avoids a division by 0 at the centre, where the surroundings have no influence.
        let length = (dx * dx + dy * dy + 1e-6).sqrt();
        let (cos, sin) = (dx / length, dy / length);
        let (cos_2, sin_2) = (cos * cos - sin * sin, 2.0 * cos * sin);
        [cos, sin, cos_2, sin_2, cos * cos_2 - sin * sin_2, sin * cos_2 + cos * sin_2]
    }
}

impl Model<WALLED> for ThreeLevels {
    fn new(at: &[f64; WALLED], ellipse: &Ellipse, whitening: Whitening, origin: DVec2) -> Self {
        let thickness = at[THICKNESS].exp();
        let around = Ellipse { mean: ellipse.mean + thickness, ..*ellipse };
        Self {
            inner: Boundary::new(ellipse, whitening),
            outer: Boundary::new(&around, whitening),
            origin: origin.as_vec2().to_array(),
            lumen: at[LUMEN] as f32,
            wall: at[WALL] as f32,
            thickness: thickness as f32,
            background: at[BACKGROUND] as f32,
            sectors: std::array::from_fn(|h| at[SECTORS + h] as f32),
        }
    }

    fn allows(at: &[f64; WALLED]) -> bool {
        (THINNEST.ln()..=THICKEST.ln()).contains(&at[THICKNESS])
    }

    #[inline(always)]
    fn modelled(&self, x: &[f32; FAN], y: &[f32; FAN]) -> Modelled<WALLED> {
        let inner = self.inner.blurred(x, y);
        let outer = self.outer.blurred(x, y);
        let Blurred { value: within, slopes: inwards } = inner;
        let Blurred { value: enclosed, slopes: outwards } = outer;
        let mut all = Modelled { share: [0.0; FAN], by: [[0.0; FAN]; WALLED] };
        let mut background = [0.0; FAN];
        for l in 0..FAN {
            let harmonics = self.harmonics(x[l], y[l]);
            background[l] = self.background;
            for h in 0..HARMONICS {
                background[l] += self.sectors[h] * harmonics[h];
                all.by[SECTORS + h][l] = (1.0 - enclosed[l]) * harmonics[h];
            }
        }
        for a in 0..SHAPE {
            for l in 0..FAN {
                all.by[a][l] =
                    (self.lumen - self.wall) * inwards[a][l] + (self.wall - background[l]) * outwards[a][l];
            }
        }
        for l in 0..FAN {
            all.by[LUMEN][l] = within[l];
            all.by[WALL][l] = enclosed[l] - within[l];
            all.by[BACKGROUND][l] = 1.0 - enclosed[l];
            // The mean outer semi-axis grows as much as the thickness.
            all.by[THICKNESS][l] = (self.wall - background[l]) * outwards[2][l] * self.thickness;
            all.share[l] = self.lumen * within[l]
                + self.wall * (enclosed[l] - within[l])
                + background[l] * (1.0 - enclosed[l]);
        }
        all
    }
}

//! The network map: an untangled tree as lines of true length, as wide as the vessels, coloured by values along them. Eulzer,
//! Meuschke, Mistelbauer and Lawonn, "Vessel maps: a survey of map-like visualizations of the cardiovascular system", Computer
//! Graphics Forum 41 (2022), doi:10.1111/cgf.14576, call such maps network maps.

use glam::DVec2;
use lumencut_core::error::Result;
use lumencut_core::reformations::Layout as _;
use lumencut_core::reformations::untangled::{LaidOut, Untangled};
use lumencut_core::stop::{Stop, go_on};

use crate::along_vessels::ValuesAlong;

/// Colour of a vessel where it has no value.
const UNKNOWN: [u8; 3] = [110; 3];
/// Half the width of the thinnest line (pixels).
const THINNEST: f64 = 1.25;

/// RGBA, transparent outside the lines, row by row; the size is that of the layout.
pub fn drawn(laid: &Untangled, along: &ValuesAlong, stop: Stop) -> Result<Vec<[u8; 4]>> {
    let [width, height] = laid.size();
    let mut sheet = Sheet {
        pixels: vec![[0; 4]; width * height],
        inside: vec![f64::NEG_INFINITY; width * height],
        size: [width, height],
    };
    let colours = along.colours();
    for part in laid.laid_out() {
        go_on(stop)?;
        let line = Line { colours: &colours[part.vessel], along, spacing: laid.pixel_spacing(), part };
        for n in 1..part.pixels.len() {
            sheet.draw(&line, n);
        }
    }
    Ok(sheet.pixels)
}

struct Line<'a> {
    colours: &'a [[u8; 4]],
    along: &'a ValuesAlong,
    spacing: f64,
    part: &'a LaidOut,
}

impl Line<'_> {
    /// Half the width of the line (pixels) at an arc length (mm).
    fn half(&self, at: f64) -> f64 {
        (self.along.radius(self.part.vessel, at) / self.spacing).max(THINNEST)
    }

    fn colour(&self, at: f64) -> [u8; 3] {
        let found = self.along.place(self.part.vessel, at).and_then(|n| self.colours.get(n));
        found.filter(|[.., alpha]| *alpha > 0).map_or(UNKNOWN, |[red, green, blue, _]| [*red, *green, *blue])
    }
}

struct Sheet {
    pixels: Vec<[u8; 4]>,
    /// How far inside its line each pixel lies (pixels).
    inside: Vec<f64>,
    size: [usize; 2],
}

impl Sheet {
    /// Draws the segment that ends at point `n`; where lines overlap, a pixel shows the one in which it lies deepest.
    fn draw(&mut self, line: &Line, n: usize) {
        let [start, end] = [n - 1, n].map(|n| line.part.pixels[n]);
        let [from, to] = [n - 1, n].map(|n| line.part.arc_length[n]);
        let edge = end - start;
        let reach = line.half(from).max(line.half(to)) + 1.0;
        let (low, high) = (start.min(end) - reach, start.max(end) + reach);
        let [columns, rows] = [(low.x, high.x, 0), (low.y, high.y, 1)].map(|(low, high, axis)| {
            let last = self.size[axis];
            (low.ceil().max(0.0) as usize).min(last)..(high.floor().max(0.0) as usize + 1).min(last)
        });
        for row in rows {
            for column in columns.clone() {
                let q = DVec2::new(column as f64, row as f64);
                let t =
                    ((q - start).dot(edge) / edge.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                let at = from + t * (to - from);
                let inside = line.half(at) - (start + edge * t).distance(q);
                let place = row * self.size[0] + column;
                if inside > self.inside[place] {
                    let ([red, green, blue], cover) = (line.colour(at), (inside + 0.5).clamp(0.0, 1.0));
                    self.inside[place] = inside;
                    self.pixels[place] = [red, green, blue, (cover * 255.0).round() as u8];
                }
            }
        }
    }
}

#[cfg(test)]
#[path = "tests/network.rs"]
mod tests;

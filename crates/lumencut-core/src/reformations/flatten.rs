//! Free-form flattening: the surface through several curves as an image. Lengths are true along one reference curve, and along
//! all curves that run across it. The paper (section 2) cites such a surface between curves by Saroul et al.; the layout is ours.

mod line;
mod surface;

use std::sync::OnceLock;

use glam::{DMat2, DVec2, DVec3};

use self::line::Line;
use self::surface::Surface;
use super::layout::{Layout, by_rows, checked_size, curved_by_rows, whole_pixels};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::Curved;
use crate::limits::Limits;
use crate::math::centerline_path::CenterlinePath;
use crate::named::Named;
use crate::stop::Stop;

const SIDE: Limits = Limits::new(1e-6, 1e4, "mm");
/// The share and the place of the reference curves.
const MIDDLE: f64 = 0.5;
/// Number of places along each side from which the search for a point begins.
const STARTS: usize = 48;
const STEPS: usize = 24;
/// Change of a place by which the search has ended (pixels).
const FOUND: f64 = 1e-9;

/// The curves along which lengths are true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// The lines across all curves, and the curve in the middle, which crosses them.
    Lines,
    /// The curves that run with the given ones, and the line in the middle, which crosses them.
    Rows,
}

impl Named for Keep {
    const NAMES: &'static [(&'static str, Self)] = &[("lines", Self::Lines), ("rows", Self::Rows)];
}

/// A flattened surface: rows run with the given curves, columns across them.
pub struct Flattened {
    surface: Surface,
    pixel_spacing: f64,
    size: [usize; 2],
    /// The pixel in which the reference curves meet.
    middle: DVec2,
    /// The lengths of the reference curve at its nodes: along the curves for lines, else along the line in the middle (mm).
    reference: Reference,
    starts: OnceLock<Vec<(DVec2, DVec3)>>,
}

enum Reference {
    /// Lengths from its middle to each node of the surface.
    Curve(Vec<f64>),
    /// The line in the middle; for each column, its place on the line, and the lengths of the curve through it.
    Line(Line, Vec<(f64, Vec<f64>)>),
}

impl Flattened {
    /// The surface through at least two curves, in their order. Fails with [`ErrorKind::Camera`] for an invalid pixel
    /// side or too many pixels, and with [`ErrorKind::VesselTree`] for less than two curves, and curves that cross.
    pub fn new(curves: &[CenterlinePath], keep: Keep, pixel_spacing: f64) -> Result<Self> {
        SIDE.check("pixel_spacing of the flattening", pixel_spacing)
            .map_err(|error| Error { kind: ErrorKind::Camera, ..error })?;
        let surface = Surface::new(curves)?;
        let (reference, [left, right, up, down]) = match keep {
            Keep::Lines => along_curves(&surface),
            Keep::Rows => along_lines(&surface),
        };
        let [left, right, up, down] =
            [left, right, up, down].map(|length| whole_pixels(length, pixel_spacing));
        let size = checked_size("size of the flattening", [left + right + 1.0, up + down + 1.0])?;
        let mut made = Self {
            surface,
            pixel_spacing,
            size,
            middle: DVec2::new(left, up),
            reference,
            starts: OnceLock::new(),
        };
        if let Reference::Line(line, columns) = &mut made.reference {
            let origin = line.length_to(MIDDLE);
            let places = (0..size[0]).map(|i| line.place_at((i as f64 - left) * pixel_spacing + origin));
            *columns = places.map(|place| (place, lengths_at(&made.surface, place))).collect();
        }
        Ok(made)
    }

    /// The share of the curves, the line there, and the place on it at an image position; beyond the curves, no place.
    fn place(&self, pixel: DVec2) -> Option<(f64, Line, f64)> {
        let [across, along] = ((pixel - self.middle) * self.pixel_spacing).to_array();
        let (share, line, place) = match &self.reference {
            Reference::Curve(lengths) => {
                let share = share_at(self.surface.shares(), lengths, along)?;
                let line = self.surface.line(share);
                let place = line.place_at(across + line.length_to(MIDDLE));
                (share, line, place)
            }
            Reference::Line(_, columns)
                if pixel.x.fract() == 0.0 && (0.0..columns.len() as f64).contains(&pixel.x) =>
            {
                let (place, lengths) = &columns[pixel.x as usize];
                let share = share_at(self.surface.shares(), lengths, along)?;
                (share, self.surface.line(share), *place)
            }
            Reference::Line(middle, _) => {
                let place = middle.place_at(across + middle.length_to(MIDDLE));
                let share = share_at(self.surface.shares(), &lengths_at(&self.surface, place), along)?;
                (share, self.surface.line(share), place)
            }
        };
        (0.0..=1.0).contains(&place).then_some((share, line, place))
    }

    /// The point and the unit normal of the surface at an image position.
    fn point(&self, pixel: DVec2) -> Option<(DVec3, DVec3)> {
        let (share, line, place) = self.place(pixel)?;
        let (point, across) = line.at(place);
        let normal = across.cross(self.surface.along(share, place));
        Some((point, normal.try_normalize().unwrap_or(DVec3::ZERO)))
    }

    fn centre(&self, i: usize, j: usize) -> DVec2 {
        DVec2::new(i as f64, j as f64)
    }

    /// Evenly spread image positions with their points, from which the search for a point begins.
    fn starts(&self) -> &[(DVec2, DVec3)] {
        self.starts.get_or_init(|| {
            let step = |n: usize, side: usize| (n * (side - 1) / (STARTS - 1)) as f64;
            let places = (0..STARTS).flat_map(|j| (0..STARTS).map(move |i| [i, j]));
            let places = places.map(|[i, j]| DVec2::new(step(i, self.size[0]), step(j, self.size[1])));
            places.filter_map(|place| Some((place, self.point(place)?.0))).collect()
        })
    }
}

/// Lengths along the curve in the middle, and how far the image reaches to each side of its middle (mm).
fn along_curves(surface: &Surface) -> (Reference, [f64; 4]) {
    let lengths = lengths_at(surface, MIDDLE);
    let sides = surface.shares().iter().map(|share| {
        let line = surface.line(*share);
        let before = line.length_to(MIDDLE);
        [before, line.length() - before]
    });
    let [left, right] =
        sides.fold([0.0; 2], |most: [f64; 2], side| [most[0].max(side[0]), most[1].max(side[1])]);
    let reach = [left, right, -lengths[0], lengths[lengths.len() - 1]];
    (Reference::Curve(lengths), reach)
}

/// The line in the middle, and how far the image reaches to each side of its middle (mm).
fn along_lines(surface: &Surface) -> (Reference, [f64; 4]) {
    let line = surface.line(MIDDLE);
    let before = line.length_to(MIDDLE);
    let [left, right] = [before, line.length() - before];
    // Curves between the given ones are no longer than these are, but for rounding of cubic lines.
    let places = (0..=STARTS).map(|n| n as f64 / STARTS as f64);
    let reach = places.map(|place| lengths_at(surface, place));
    let [up, down] = reach.fold([0.0; 2], |most: [f64; 2], lengths| {
        [most[0].max(-lengths[0]), most[1].max(lengths[lengths.len() - 1])]
    });
    (Reference::Line(line, Vec::new()), [left, right, up, down])
}

/// Lengths from the middle share to each node, along the curve at a place of the lines (mm).
fn lengths_at(surface: &Surface, place: f64) -> Vec<f64> {
    let points = surface.curve(place);
    let mut lengths = vec![0.0];
    for pair in points.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
    }
    // The node in the middle may differ from it by rounding.
    let middle = surface.shares().partition_point(|share| *share < MIDDLE - 1e-9);
    let origin = lengths[middle];
    lengths.iter().map(|length| length - origin).collect()
}

/// The share at a length along a curve with straight parts; none beyond its ends.
fn share_at(shares: &[f64], lengths: &[f64], length: f64) -> Option<f64> {
    let rounding = 1e-9 * (lengths[lengths.len() - 1] - lengths[0]);
    if !(lengths[0] - rounding..=lengths[lengths.len() - 1] + rounding).contains(&length) {
        return None;
    }
    let next = lengths.partition_point(|end| *end <= length).clamp(1, lengths.len() - 1);
    let [from, to] = [lengths[next - 1], lengths[next]];
    let way = if to > from { ((length - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
    Some(shares[next - 1] + (shares[next] - shares[next - 1]) * way)
}

impl Layout for Flattened {
    fn size(&self) -> [usize; 2] {
        self.size
    }

    fn pixel_spacing(&self) -> f64 {
        self.pixel_spacing
    }

    fn curved(&self, stop: Stop) -> Result<Curved> {
        curved_by_rows(self.size, stop, |j, position, direction| {
            for i in 0..position.len() {
                if let Some((point, normal)) = self.point(self.centre(i, j)) {
                    position[i] = point;
                    direction[i] = normal.as_vec3();
                }
            }
        })
    }

    fn arc_length(&self, _: Stop) -> Result<Vec<f64>> {
        Ok((0..self.size[1]).map(|j| j as f64 * self.pixel_spacing).collect())
    }

    fn folded(&self, stop: Stop) -> Result<Vec<bool>> {
        by_rows(self.size, false, stop, |j, row| {
            for (i, folded) in row.iter_mut().enumerate() {
                let centre = self.centre(i, j);
                let Some((_, normal)) = self.point(centre) else { continue };
                // Across the pixel: the one in the middle of a fold has a normal between those of its sides.
                *folded = [DVec2::X, DVec2::Y].into_iter().any(|step| {
                    let sides =
                        [-step, step].map(|step| self.point(centre + step).map_or(normal, |side| side.1));
                    sides[0].dot(sides[1]) <= 0.0
                });
            }
        })
    }

    fn world_from_pixel(&self, pixel: DVec2) -> DVec3 {
        self.point(pixel).map_or(DVec3::NAN, |(point, _)| point)
    }

    fn pixel_from_world(&self, point: DVec3) -> DVec2 {
        let nearest = |start: &&(DVec2, DVec3)| start.1.distance_squared(point);
        let start = self.starts().iter().min_by(|a, b| nearest(a).total_cmp(&nearest(b)));
        let Some((mut place, _)) = start.copied() else { return DVec2::NAN };
        for _ in 0..STEPS {
            let Some((own, _)) = self.point(place) else { return DVec2::NAN };
            // Towards the middle, so that both differences exist.
            let step = (self.middle - place).signum() * 1e-4;
            let [right, down] = [DVec2::new(step.x, 0.0), DVec2::new(0.0, step.y)].map(|one| {
                let moved = self.point(place + one).map_or(own, |(point, _)| point);
                (moved - own) / (one.x + one.y)
            });
            let squares = DMat2::from_cols(
                DVec2::new(right.dot(right), right.dot(down)),
                DVec2::new(right.dot(down), down.dot(down)),
            );
            if squares.determinant().abs() < 1e-12 {
                return DVec2::NAN;
            }
            let left = point - own;
            let change = squares.inverse() * DVec2::new(right.dot(left), down.dot(left));
            // Half a pixel beyond the outermost centres belongs to the image.
            let limit = DVec2::new(self.size[0] as f64, self.size[1] as f64) - 0.5;
            let next = (place + change.clamp_length_max(self.size[0].max(self.size[1]) as f64 / 4.0))
                .clamp(DVec2::splat(-0.5), limit);
            let is_there = (next - place).length() < FOUND;
            place = next;
            if is_there {
                break;
            }
        }
        if self.point(place).is_some() { place } else { DVec2::NAN }
    }
}

#[cfg(test)]
#[path = "tests/flatten.rs"]
mod tests;

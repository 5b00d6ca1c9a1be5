//! Tiles of pixels, which share one walk through the hierarchy; a part of a tile fills one vector.

use super::lanes::{Bits, COLUMNS, PART_PIXELS, PART_SIDE, PARTS, PIXELS, ROWS, larger, smaller};
use crate::camera::Camera;

const PARTS_ACROSS: usize = COLUMNS / PART_SIDE;

/// The lane of the pixel in row `r` and column `c` of a tile; lanes run part by part, and by rows in a part.
#[inline(always)]
pub(crate) const fn lane(r: usize, c: usize) -> usize {
    let part = r / PART_SIDE * PARTS_ACROSS + c / PART_SIDE;
    part * PART_PIXELS + r % PART_SIDE * PART_SIDE + c % PART_SIDE
}

pub(crate) const PIXEL_OF_LANE: [(usize, usize); PIXELS] = {
    let mut places = [(0, 0); PIXELS];
    let mut n = 0;
    while n < PIXELS {
        places[lane(n / COLUMNS, n % COLUMNS)] = (n / COLUMNS, n % COLUMNS);
        n += 1;
    }
    places
};

/// The values of the tile at `column` in `rows`, by lane; beyond the image its last column and row repeat.
#[inline(always)]
pub(crate) fn gather(rows: &[f32], width: usize, column: usize) -> [f32; PIXELS] {
    let last_row = rows.len() / width - 1;
    let mut lanes = [0.0; PIXELS];
    for (n, run) in lanes.as_chunks_mut::<PART_SIDE>().0.iter_mut().enumerate() {
        let (r, c) = PIXEL_OF_LANE[n * PART_SIDE];
        let row = &rows[r.min(last_row) * width..][..width];
        if let Some(whole) = row.get(column + c..).and_then(|rest| rest.first_chunk()) {
            *run = *whole;
        } else {
            for (l, lane) in run.iter_mut().enumerate() {
                *lane = row[(column + c + l).min(width - 1)];
            }
        }
    }
    lanes
}

/// Writes the lanes of the tile at `column` into its `rows`, without those beyond the image.
#[inline(always)]
pub(crate) fn scatter<T: Copy>(lanes: &[T; PIXELS], rows: &mut [T], width: usize, column: usize) {
    for (n, run) in lanes.as_chunks::<PART_SIDE>().0.iter().enumerate() {
        let (r, c) = PIXEL_OF_LANE[n * PART_SIDE];
        let Some(row) = rows.get_mut(r * width..(r + 1) * width) else { continue };
        let Some(rest) = row.get_mut(column + c..) else { continue };
        if let Some(whole) = rest.first_chunk_mut() {
            *whole = *run;
        } else {
            rest.copy_from_slice(&run[..rest.len()]);
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Area {
    pub center: [f32; 2],
    /// Half the sides of the area (mm), plus a bound on the rounding of its middle.
    pub half: [f32; 2],
}

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Tile {
    pub x: [f32; PIXELS],
    pub y: [f32; PIXELS],
    pub area: Area,
    pub parts: [Area; PARTS],
    pub radius: f32,
    pub bits: Bits,
}

impl Tile {
    /// The tile whose first pixel is (`i`, `j`); pixels beyond the image repeat its last column and row.
    #[inline(always)]
    pub(crate) fn new(camera: &Camera, i: usize, j: usize) -> Self {
        let [width, height] = camera.size();
        let (mut columns, mut rows) = ([0.0; COLUMNS], [0.0; ROWS]);
        for c in 0..COLUMNS {
            columns[c] = camera.view_x((i + c).min(width - 1)) as f32;
        }
        for r in 0..ROWS {
            rows[r] = camera.view_y((j + r).min(height - 1)) as f32;
        }
        let (mut x, mut y) = ([0.0; PIXELS], [0.0; PIXELS]);
        for l in 0..PIXELS {
            let (r, c) = PIXEL_OF_LANE[l];
            (x[l], y[l]) = (columns[c], rows[r]);
        }
        let area = around(&columns, &rows);
        let mut parts = [area; PARTS];
        for p in 0..PARTS {
            let (r, c) = (p / PARTS_ACROSS * PART_SIDE, p % PARTS_ACROSS * PART_SIDE);
            parts[p] = around(&columns[c..c + PART_SIDE], &rows[r..r + PART_SIDE]);
        }
        let [hx, hy] = area.half;
        Self { x, y, area, parts, radius: (hx * hx + hy * hy).sqrt(), bits: Bits::new() }
    }

    /// The tile of these places (view x and y, mm), by lane, wherever they lie.
    #[inline(never)]
    pub(crate) fn of_places(places: &[[f32; 2]; PIXELS]) -> Self {
        let (mut x, mut y) = ([0.0; PIXELS], [0.0; PIXELS]);
        for l in 0..PIXELS {
            [x[l], y[l]] = places[l];
        }
        let area = around(&extent(&x), &extent(&y));
        let mut parts = [area; PARTS];
        for (p, part) in parts.iter_mut().enumerate() {
            let lanes = p * PART_PIXELS..(p + 1) * PART_PIXELS;
            *part = around(&extent(&x[lanes.clone()]), &extent(&y[lanes]));
        }
        let [hx, hy] = area.half;
        Self { x, y, area, parts, radius: (hx * hx + hy * hy).sqrt(), bits: Bits::new() }
    }
}

fn extent(values: &[f32]) -> [f32; 2] {
    let start = [values[0]; 2];
    values.iter().fold(start, |[low, high], value| [smaller(low, *value), larger(high, *value)])
}

#[inline(always)]
fn around(columns: &[f32], rows: &[f32]) -> Area {
    let middle = |values: &[f32]| (values[0] + values[values.len() - 1]) * 0.5;
    let half = |values: &[f32]| {
        let (first, last) = (values[0], values[values.len() - 1]);
        (last - first).abs() * 0.500_001 + 4e-7 * larger(first.abs(), last.abs())
    };
    Area { center: [middle(columns), middle(rows)], half: [half(columns), half(rows)] }
}

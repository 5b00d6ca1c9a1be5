//! CR for the tiles of a view: two walks find each pixel's nearest and foremost piece, and a search decides.

use super::stretch::StretchSearch;
use super::view::{CrView, NO_PIECE, Seen};
use crate::math::lanes::{COLUMNS, Kernel, PIXELS, ROWS};
use crate::math::tile::{Tile, scatter};
use crate::math::walk::Seeds;
use crate::stages::depth::Sheet;

pub(super) struct CrRow<'a> {
    pub view: &'a CrView<'a>,
    pub row: usize,
    pub depth: &'a mut [f32],
    pub vessel: &'a mut [i32],
    pub sheet: &'a mut [Sheet],
}

impl Kernel for CrRow<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (view, width) = (self.view, self.view.camera.size()[0]);
        let (mut seeds, mut search) = ([Seeds::default(); 2], StretchSearch::new(view));
        for column in (0..width).step_by(COLUMNS) {
            let tile = Tile::new(view.camera, column, self.row * ROWS);
            search.begin_tile();
            let nearest = view.nearest_pieces(&tile, &mut seeds[0]);
            let foremost = view.foremost(&tile, &mut seeds[1]);
            let (mut depth, mut vessel, mut sheet) = ([0.0; PIXELS], [0; PIXELS], [[0.0; 4]; PIXELS]);
            for l in 0..PIXELS {
                let seen = shown(view, &mut search, &tile, [nearest[l], foremost[l]], l);
                (depth[l], vessel[l], sheet[l]) = (seen.z, seen.vessel, seen.sheet());
            }
            scatter(&depth, self.depth, width, column);
            scatter(&vessel, self.vessel, width, column);
            scatter(&sheet, self.sheet, width, column);
        }
    }
}

/// The nearest piece in the image; if it is not in the foremost piece's stretch, the nearest piece of that stretch.
#[inline(always)]
fn shown(view: &CrView, search: &mut StretchSearch, tile: &Tile, pieces: [u32; 2], l: usize) -> Seen {
    let ([nearest, foremost], [x, y]) = (pieces, [tile.x[l], tile.y[l]]);
    let near = view.seen(nearest, x, y);
    if foremost == NO_PIECE || foremost == nearest {
        return near;
    }
    let front = view.seen(foremost, x, y);
    if view.connections.are_near(front.place(), near.place()) {
        return near;
    }
    search.nearest_piece(tile, front, [x, y])
}

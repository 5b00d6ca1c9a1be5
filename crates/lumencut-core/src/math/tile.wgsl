// Tiles of pixels, one per thread, so that a piece read once serves many pixels. Four pixels of a row make a
// vector, a quad.
// import math/view

// Number of quads side by side in a tile, and of its rows; at most MAX_ACROSS and MAX_ROWS.
override ACROSS: u32 = 1u;
override ROWS: u32 = 4u;
const MAX_ACROSS = 2u;
const MAX_ROWS = 8u;
const MAX_QUADS = 16u;
const QUAD = 4u;
// Tiles of a workgroup form short rows, so that threads in lockstep work on nearby pixels. Software adapters
// run only the first workgroup dimension in lockstep, so it must exceed their vector width.
const TILES = 64u;
const TILES_ACROSS = 4u;

// The pixel centres of a tile in view space (mm); pixels beyond the image repeat its last column and row.
struct Tile {
    pixel: vec2u,
    center: vec2f,
    half: vec2f,
    radius: f32,
}

var<private> quad_x: array<vec4f, MAX_ACROSS>;
var<private> row_y: array<f32, MAX_ROWS>;

// The tile of a thread of a workgroup; its pixels go to `quad_x` and `row_y`.
fn tile_at(group: vec2u, thread: u32) -> Tile {
    let place = vec2u(thread % TILES_ACROSS, thread / TILES_ACROSS);
    let pixel = (group * vec2u(TILES_ACROSS, TILES / TILES_ACROSS) + place) * vec2u(ACROSS * QUAD, ROWS);
    let last = view.size - 1u;
    for (var a = 0u; a < ACROSS; a++) {
        let i = vec4u(pixel.x + a * QUAD) + vec4u(0u, 1u, 2u, 3u);
        quad_x[a] = views_x(min(i, vec4u(last.x)));
    }
    for (var r = 0u; r < ROWS; r++) {
        row_y[r] = view_y(min(pixel.y + r, last.y));
    }
    let first = vec2f(quad_x[0].x, row_y[0]);
    let end = vec2f(quad_x[ACROSS - 1u].w, row_y[ROWS - 1u]);
    var tile: Tile;
    tile.pixel = pixel;
    tile.center = (first + end) * 0.5;
    tile.half = abs(end - first) * 0.500001 + 4e-7 * max(abs(first), abs(end));
    tile.radius = length(tile.half);
    return tile;
}

fn quad_of(a: u32, r: u32) -> u32 {
    return r * ACROSS + a;
}

fn pixel_of(tile: Tile, a: u32, r: u32, c: u32) -> vec2u {
    return tile.pixel + vec2u(a * QUAD + c, r);
}

fn largest(numbers: array<vec4f, MAX_QUADS>) -> f32 {
    var most = numbers[0];
    for (var q = 1u; q < ACROSS * ROWS; q++) {
        most = max(most, numbers[q]);
    }
    return max(max(most.x, most.y), max(most.z, most.w));
}

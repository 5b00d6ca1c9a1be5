//! Simple points: voxels of the lumen that can be removed without changing the topology. Lumen is 26-connected,
//! background is 6-connected. Bertrand and Malandain, "A new characterization of three-dimensional simple points",
//! Pattern Recognition Letters 15(2), 1994, doi:10.1016/0167-8655(94)90046-9. A point is simple if the lumen around
//! it is one component, and the background that touches it by a face is one component within the 18 neighbours.

/// Index of the middle of a 3 × 3 × 3 cube, whose positions are numbered i + 3 j + 9 k.
const CENTER: usize = 13;

/// The 26-neighbours of each position, as bits.
const TOUCHING: [u32; 27] = neighbours(3, 0);
/// The 6-neighbours of each position, as bits; corners of the cube do not count.
const BY_FACES: [u32; 27] = neighbours(1, CORNERS);
const CORNERS: u32 = 1 | 1 << 2 | 1 << 6 | 1 << 8 | 1 << 18 | 1 << 20 | 1 << 24 | 1 << 26;
const FACES: u32 = 1 << 4 | 1 << 10 | 1 << 12 | 1 << 14 | 1 << 16 | 1 << 22;
const NEIGHBORS: u32 = ((1 << 27) - 1) & !(1 << CENTER);

/// Positions within one step along each axis and `most` steps in total, except `left_out` and the centre.
const fn neighbours(most: usize, left_out: u32) -> [u32; 27] {
    let mut all = [0; 27];
    let mut place = 0_usize;
    while place < 27 {
        let mut other = 0_usize;
        while other < 27 {
            let [i, j, k] = [
                (place % 3).abs_diff(other % 3),
                (place / 3 % 3).abs_diff(other / 3 % 3),
                (place / 9).abs_diff(other / 9),
            ];
            let near = i <= 1 && j <= 1 && k <= 1 && i + j + k <= most && other != place;
            if near && other != CENTER && left_out >> other & 1 == 0 {
                all[place] |= 1 << other;
            }
            other += 1;
        }
        place += 1;
    }
    all
}

/// One bit for each of the 27 positions, set if it is lumen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Neighbourhood(u32);

impl Neighbourhood {
    #[inline(always)]
    pub(crate) fn of(cells: &[u8], cell: usize, strides: [usize; 3]) -> Self {
        let mut bits = 0;
        let first = cell - strides[1] - strides[2] - 1;
        for k in 0..3 {
            for j in 0..3 {
                let start = first + j * strides[1] + k * strides[2];
                for (i, &value) in cells[start..start + 3].iter().enumerate() {
                    bits |= u32::from(value != 0) << (i + 3 * j + 9 * k);
                }
            }
        }
        Self(bits & NEIGHBORS)
    }

    pub(crate) fn count(self) -> u32 {
        self.0.count_ones()
    }

    pub(crate) fn is_simple(self) -> bool {
        let background = !self.0 & NEIGHBORS & !CORNERS;
        let faces = background & FACES;
        if self.0 == 0 || faces == 0 {
            return false;
        }
        part(self.0, self.0, &TOUCHING) == self.0 && faces & !part(background, faces, &BY_FACES) == 0
    }
}

fn part(places: u32, seeds: u32, touching: &[u32; 27]) -> u32 {
    let mut reached = seeds & seeds.wrapping_neg();
    let mut new = reached;
    while new != 0 {
        let mut around = 0;
        while new != 0 {
            around |= touching[new.trailing_zeros() as usize];
            new &= new - 1;
        }
        new = around & places & !reached;
        reached |= new;
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(places: u32, touch: impl Fn(usize, usize) -> bool) -> Vec<u32> {
        let mut parts: Vec<u32> = (0..27).filter(|n| places >> n & 1 == 1).map(|n| 1 << n).collect();
        while let Some((a, b)) = (0..parts.len()).flat_map(|b| (0..b).map(move |a| (a, b))).find(|&(a, b)| {
            (0..27).any(|p| (0..27).any(|q| parts[a] >> p & 1 == 1 && parts[b] >> q & 1 == 1 && touch(p, q)))
        }) {
            let joined = parts.swap_remove(b);
            parts[a] |= joined;
        }
        parts
    }

    fn steps(p: usize, q: usize) -> [usize; 3] {
        [(p % 3).abs_diff(q % 3), (p / 3 % 3).abs_diff(q / 3 % 3), (p / 9).abs_diff(q / 9)]
    }

    #[test]
    fn simple_points_are_those_of_the_definition() {
        let mut state = 1_u32;
        let mut simple = 0;
        for round in 0..4000 {
            let mut bits = 0;
            for place in 0..27 {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                bits |= u32::from((state >> 16) % 8 < 1 + round % 7) << place;
            }
            bits &= NEIGHBORS;
            let lumen = parts(bits, |p, q| steps(p, q).into_iter().max() == Some(1)).len();
            let background =
                parts(!bits & NEIGHBORS & !CORNERS, |p, q| steps(p, q).into_iter().sum::<usize>() == 1);
            let touching = background.iter().filter(|part| **part & FACES != 0).count();
            assert_eq!(Neighbourhood(bits).is_simple(), lumen == 1 && touching == 1, "{bits:027b}");
            simple += u32::from(lumen == 1 && touching == 1);
        }
        assert!((500..3500).contains(&simple));
    }

    #[test]
    fn neighbourhoods_are_read_in_order() {
        let mut cells = [0; 5 * 4 * 3];
        let strides = [1, 5, 20];
        let middle = 2 + 5 + 20;
        assert_eq!(Neighbourhood::of(&cells, middle, strides), Neighbourhood(0));
        cells[middle] = 1;
        cells[middle + 1 - 5 + 20] = 1;
        assert_eq!(Neighbourhood::of(&cells, middle, strides), Neighbourhood(1 << (2 + 18)));
    }
}

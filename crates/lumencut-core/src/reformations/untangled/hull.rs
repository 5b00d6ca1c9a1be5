//! The hulls of vessels in the image: discs as wide as the lumen and a margin, and whether those of two vessels overlap.

use glam::DVec2;

use super::pieces::Piece;

/// How many discs that follow one another share a circle around them.
const RUN: usize = 16;

/// Discs may touch (mm).
const TOUCHING: f64 = 1e-9;

/// A disc around a place of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub center: DVec2,
    pub radius: f64,
    /// The piece.
    pub piece: usize,
    /// Where along the vessel it is (mm).
    pub at: f64,
}

impl Disc {
    fn overlaps(&self, other: &Self) -> bool {
        let reach = self.radius + other.radius - TOUCHING;
        reach > 0.0 && self.center.distance_squared(other.center) < reach * reach
    }

    /// The disc on the way to the next one of its piece.
    fn towards(&self, next: &Self, share: f64) -> Self {
        let between = |from: f64, to: f64| from + (to - from) * share;
        Self {
            center: self.center.lerp(next.center, share),
            radius: between(self.radius, next.radius),
            at: between(self.at, next.at),
            ..*self
        }
    }
}

/// The discs at the stations of a piece.
pub(super) fn discs(number: usize, piece: &Piece, places: &[DVec2], margin: f64) -> Vec<Disc> {
    let stations = places.iter().zip(&piece.radius).zip(&piece.at);
    stations
        .map(|((center, radius), at)| Disc {
            center: *center,
            radius: radius + margin,
            piece: number,
            at: *at,
        })
        .collect()
}

/// The discs whose centres lie at least `distance` from the origin; where a piece crosses that distance it has one more there.
pub(super) fn beyond(discs: &[Disc], distance: f64) -> Vec<Disc> {
    let is_beyond = |disc: &Disc| disc.center.length() >= distance;
    let mut kept = Vec::new();
    for (n, disc) in discs.iter().enumerate() {
        if is_beyond(disc) {
            kept.push(*disc);
        }
        if let Some(next) = discs.get(n + 1)
            && next.piece == disc.piece
            && is_beyond(next) != is_beyond(disc)
        {
            kept.push(disc.towards(next, crossing(disc.center, next.center, distance)));
        }
    }
    kept
}

/// The share of the way between two places at which a distance from the origin is crossed.
fn crossing(from: DVec2, to: DVec2, distance: f64) -> f64 {
    let step = to - from;
    let [a, b, c] = [step.length_squared(), from.dot(step), from.length_squared() - distance * distance];
    let root = (b * b - a * c).max(0.0).sqrt();
    // Outwards the larger solution, inwards the smaller one.
    let share = if c < 0.0 { (root - b) / a } else { (-root - b) / a };
    share.clamp(0.0, 1.0)
}

/// Discs that move as one.
#[derive(Clone, Debug, Default)]
pub(super) struct Hull {
    discs: Vec<Disc>,
    /// A circle around the discs of each run.
    runs: Vec<(DVec2, f64)>,
}

impl Hull {
    pub fn new(discs: Vec<Disc>) -> Self {
        let circle = |discs: &[Disc]| {
            let center = discs.iter().map(|disc| disc.center).sum::<DVec2>() / discs.len() as f64;
            let reach = |disc: &Disc| disc.center.distance(center) + disc.radius.max(0.0);
            (center, discs.iter().map(reach).fold(0.0, f64::max))
        };
        Self { runs: discs.chunks(RUN).map(circle).collect(), discs }
    }

    pub fn discs(&self) -> &[Disc] {
        &self.discs
    }

    /// The hull turned about the origin (radians).
    pub fn turned(&self, angle: f64) -> Self {
        let turn = DVec2::from_angle(angle);
        let discs = self.discs.iter().map(|disc| Disc { center: turn.rotate(disc.center), ..*disc });
        Self {
            discs: discs.collect(),
            runs: self.runs.iter().map(|(center, radius)| (turn.rotate(*center), *radius)).collect(),
        }
    }

    /// Whether a disc of this hull overlaps one of another.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.pairs(other, &mut |_, _| true)
    }

    /// Adds all pieces of two hulls whose discs overlap.
    pub fn add_overlapping(&self, other: &Self, pieces: &mut Vec<usize>) {
        self.pairs(other, &mut |disc, other| {
            pieces.extend([disc.piece, other.piece]);
            false
        });
    }

    /// Whether discs of this hull, one piece, overlap each other farther apart along it than twice the sum of their radii.
    pub fn overlaps_itself(&self) -> bool {
        self.pairs(self, &mut |disc, other| (disc.at - other.at).abs() > 2.0 * (disc.radius + other.radius))
    }

    /// Meets pairs of discs that overlap until one of them is the last that counts; tells whether there was one.
    fn pairs(&self, other: &Self, is_last: &mut impl FnMut(&Disc, &Disc) -> bool) -> bool {
        for (run, discs) in self.runs.iter().zip(self.discs.chunks(RUN)) {
            for (other_run, others) in other.runs.iter().zip(other.discs.chunks(RUN)) {
                let reach = run.1 + other_run.1;
                if run.0.distance_squared(other_run.0) > reach * reach {
                    continue;
                }
                for disc in discs {
                    for other in others {
                        if disc.overlaps(other) && is_last(disc, other) {
                            return true;
                        }
                    }
                }
            }
        }
        false
    }
}

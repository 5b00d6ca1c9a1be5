//! A line across the curves of a free-form surface: a natural cubic spline, straight through two curves.

use glam::DVec3;

/// Parts of a span between two curves, each with its own length.
const PARTS: usize = 8;
/// Nodes and weights of Gauss's quadrature on -1 to 1, exact for polynomials up to degree 9.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.538_469_310_105_683, 0.478_628_670_499_366_47),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];
const NEWTON_STEPS: usize = 8;

/// A natural cubic spline through one point of each curve; its parameter is 0 at the first and 1 at the last curve.
#[derive(Clone)]
pub(super) struct Spline {
    points: Vec<DVec3>,
    /// Second derivatives at the points, by spans.
    bends: Vec<DVec3>,
}

impl Spline {
    /// The spline through at least two points.
    pub(super) fn new(points: Vec<DVec3>) -> Self {
        let bends = bends(&points);
        Self { points, bends }
    }

    /// The spline between two others: points and bends are linear in the share.
    pub(super) fn between(one: &Self, other: &Self, way: f64) -> Self {
        let mixed = |a: &[DVec3], b: &[DVec3]| a.iter().zip(b).map(|(a, b)| *a + (*b - *a) * way).collect();
        Self { points: mixed(&one.points, &other.points), bends: mixed(&one.bends, &other.bends) }
    }

    fn spans(&self) -> usize {
        self.points.len() - 1
    }

    /// The point and the derivative at a parameter; beyond the ends the spline continues straight.
    pub(super) fn at(&self, place: f64) -> (DVec3, DVec3) {
        let inside = place.clamp(0.0, 1.0);
        let spans = self.spans() as f64;
        let span = ((inside * spans) as usize).min(self.spans() - 1);
        let way = inside * spans - span as f64;
        let [a, b] = [self.points[span], self.points[span + 1]];
        let [p, q] = [self.bends[span], self.bends[span + 1]];
        let rest = 1.0 - way;
        let point = a * rest + b * way + (p * (rest.powi(3) - rest) + q * (way.powi(3) - way)) / 6.0;
        let slope = b - a + (q * (3.0 * way * way - 1.0) - p * (3.0 * rest * rest - 1.0)) / 6.0;
        (point + slope * (place - inside) * spans, slope * spans)
    }
}

/// A spline with its lengths.
pub(super) struct Line {
    spline: Spline,
    /// Length from the first point to the end of each part (mm), beginning with 0.
    lengths: Vec<f64>,
}

impl Line {
    /// The line along a spline.
    pub(super) fn new(spline: Spline) -> Self {
        let mut line = Self { spline, lengths: vec![0.0] };
        for part in 0..line.parts() {
            let length = line.lengths[part] + line.part_length(part, 1.0);
            line.lengths.push(length);
        }
        line
    }

    fn parts(&self) -> usize {
        self.spline.spans() * PARTS
    }

    /// The point and the derivative at a parameter.
    pub(super) fn at(&self, place: f64) -> (DVec3, DVec3) {
        self.spline.at(place)
    }

    /// The length of a share of a part (mm).
    fn part_length(&self, part: usize, share: f64) -> f64 {
        let width = share / self.parts() as f64;
        let start = part as f64 / self.parts() as f64;
        GAUSS
            .iter()
            .map(|(node, weight)| weight * self.at(start + width * (node + 1.0) / 2.0).1.length())
            .sum::<f64>()
            * width
            / 2.0
    }

    /// The length from the first point to a parameter between 0 and 1 (mm).
    pub(super) fn length_to(&self, place: f64) -> f64 {
        let parts = self.parts() as f64;
        let part = ((place * parts) as usize).min(self.parts() - 1);
        self.lengths[part] + self.part_length(part, place * parts - part as f64)
    }

    /// The length of the whole line (mm).
    pub(super) fn length(&self) -> f64 {
        self.lengths[self.parts()]
    }

    /// The parameter at a length from the first point (mm); outside 0 to 1 beyond the ends.
    pub(super) fn place_at(&self, length: f64) -> f64 {
        let part = self.lengths.partition_point(|end| *end <= length).clamp(1, self.parts()) - 1;
        let [from, to] = [self.lengths[part], self.lengths[part + 1]];
        let first = part as f64 + if to > from { (length - from) / (to - from) } else { 0.0 };
        let mut place = first / self.parts() as f64;
        if !(0.0..=1.0).contains(&place) {
            return place;
        }
        for _ in 0..NEWTON_STEPS {
            let speed = self.at(place).1.length();
            if speed == 0.0 {
                break;
            }
            place = (place - (self.length_to(place) - length) / speed).clamp(0.0, 1.0);
        }
        place
    }
}

/// Second derivatives of the natural cubic spline through points one span apart; zero at its ends.
fn bends(points: &[DVec3]) -> Vec<DVec3> {
    let count = points.len();
    let mut bends = vec![DVec3::ZERO; count];
    // The tridiagonal system p(i-1) + 4 p(i) + p(i+1) = 6 (a(i-1) - 2 a(i) + a(i+1)), by elimination.
    let mut factors = vec![0.0; count];
    for i in 1..count.saturating_sub(1) {
        let right = (points[i - 1] - points[i] * 2.0 + points[i + 1]) * 6.0;
        let pivot = 4.0 - factors[i - 1];
        factors[i] = 1.0 / pivot;
        bends[i] = (right - bends[i - 1]) / pivot;
    }
    for i in (1..count.saturating_sub(1)).rev() {
        bends[i] = bends[i] - bends[i + 1] * factors[i];
    }
    bends
}

//! Builds a network of trunks, branches and bridges, and cuts it at junctions into unbranched vessels.

use glam::DVec3;

use crate::curve::{Curve, WayPoint};
use crate::lesion::{Calcification, Plaque, PlaqueKind, Rod, Stenosis, WHOLE_RING, narrowing};
use crate::random::{hash, uniform};
use crate::wall_thickness;

#[derive(Clone, Debug)]
pub(crate) struct KnownVessel {
    pub(crate) name: String,
    pub(crate) points: Vec<DVec3>,
    /// True lumen radius at each point (mm).
    pub(crate) lumen: Vec<f64>,
    /// Radius of the healthy lumen at each point (mm).
    pub(crate) reference: Vec<f64>,
    /// Thickness of the wall at each point (mm).
    pub(crate) wall: Vec<f64>,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Vasculature {
    pub(crate) vessels: Vec<KnownVessel>,
    pub(crate) stenoses: Vec<Stenosis>,
    pub(crate) plaques: Vec<Plaque>,
    pub(crate) calcium: Vec<Rod>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TrunkId(usize);

struct Trunk {
    name: String,
    curve: Curve,
    /// Arc lengths of junctions with other trunks.
    junctions: Vec<f64>,
    /// For each stenosis: arc length of the middle (mm), length (mm), and percent of the diameter.
    stenoses: Vec<[f64; 3]>,
    calcifications: Vec<Calcification>,
}

impl Trunk {
    /// The degree by which the lumen is narrowed at arc length `s`: 0 is not at all, 1 is closed.
    fn narrowed(&self, s: f64) -> f64 {
        let narrowed =
            |[middle, length, percent]: &[f64; 3]| percent / 100.0 * narrowing(s - middle, *length);
        self.stenoses.iter().map(narrowed).fold(0.0, f64::max)
    }

    fn lumen(&self, s: f64) -> f64 {
        self.curve.at(s).1 * (1.0 - self.narrowed(s))
    }
}

pub(crate) struct Network {
    seed: u64,
    trunks: Vec<Trunk>,
}

impl Network {
    pub(crate) fn new(seed: u64) -> Self {
        Self { seed, trunks: Vec::new() }
    }

    /// Adds a trunk through way points, with random bends of about `winding` mm.
    pub(crate) fn trunk(&mut self, name: &str, way: &[WayPoint], winding: f64) -> TrunkId {
        let seed = hash(self.seed, self.trunks.len() as u64);
        self.trunks.push(Trunk {
            name: name.to_owned(),
            curve: Curve::through(way).winding(winding, seed),
            junctions: Vec::new(),
            stenoses: Vec::new(),
            calcifications: Vec::new(),
        });
        TrunkId(self.trunks.len() - 1)
    }

    /// Adds a trunk that starts at the point of `parent` nearest to the first way point.
    pub(crate) fn branch(&mut self, parent: TrunkId, name: &str, way: &[WayPoint], winding: f64) -> TrunkId {
        let mut way = way.to_vec();
        self.attach(parent, &mut way[0]);
        self.trunk(name, &way, winding)
    }

    /// Adds a trunk from the point of `from` nearest to the first way point to the point of `to` nearest to the last one.
    pub(crate) fn bridge(
        &mut self,
        from: TrunkId,
        to: TrunkId,
        name: &str,
        way: &[WayPoint],
        winding: f64,
    ) -> TrunkId {
        let mut way = way.to_vec();
        let last = way.len() - 1;
        self.attach(from, &mut way[0]);
        self.attach(to, &mut way[last]);
        self.trunk(name, &way, winding)
    }

    /// Moves `way` to the nearest point of `parent` and records the junction.
    fn attach(&mut self, parent: TrunkId, way: &mut WayPoint) {
        let parent = &mut self.trunks[parent.0];
        let s = parent.curve.nearest_arc_length(DVec3::new(way[0], way[1], way[2]));
        let place = parent.curve.at(s).0;
        way[..3].copy_from_slice(&place.to_array());
        if s > 0.0 && s < parent.curve.length() {
            parent.junctions.push(s);
        }
    }

    /// Adds a stenosis of `percent`, `length` mm long, at `fraction` of the trunk's length.
    pub(crate) fn stenosis(&mut self, trunk: TrunkId, fraction: f64, length: f64, percent: f64) {
        let trunk = &mut self.trunks[trunk.0];
        trunk.stenoses.push([fraction * trunk.curve.length(), length, percent]);
    }

    /// Adds a calcification at `fraction` of the trunk's length.
    pub(crate) fn calcify(&mut self, trunk: TrunkId, fraction: f64, shape: Calcification) {
        let trunk = &mut self.trunks[trunk.0];
        let arc_length = fraction * trunk.curve.length();
        trunk.calcifications.push(Calcification { arc_length, ..shape });
    }

    /// Adds `count` random calcifications between two fractions of the trunk's length.
    pub(crate) fn scatter_calcium(&mut self, trunk: TrunkId, count: u64, between: [f64; 2]) {
        let seed = hash(self.seed, 1000 + trunk.0 as u64);
        for n in 0..count {
            let random = |what: u64, low: f64, high: f64| low + (high - low) * uniform(seed, 8 * n + what);
            // One calcification in each of `count` equal intervals avoids clusters.
            let along = (n as f64 + random(0, 0.2, 0.8)) / count as f64;
            let shape = Calcification {
                arc_length: 0.0,
                length: random(1, 3.0, 9.0),
                angle: random(2, -3.0, 3.0),
                angular_extent: random(3, 0.5, 1.4),
                thickness: random(4, 1.0, 2.0),
            };
            self.calcify(trunk, between[0] + along * (between[1] - between[0]), shape);
        }
    }

    /// Returns the unbranched vessels, with about `segments` evenly spaced segments in total.
    pub(crate) fn finish(mut self, segments: usize) -> Vasculature {
        let length: f64 = self.trunks.iter().map(|t| t.curve.length()).sum();
        let per_mm = segments as f64 / length;
        let mut made = Vasculature::default();
        for trunk in &mut self.trunks {
            let mut cuts = std::mem::take(&mut trunk.junctions);
            cuts.extend([0.0, trunk.curve.length()]);
            cuts.sort_by(f64::total_cmp);
            cuts.dedup();
            cut(trunk, &cuts, per_mm, &mut made);
        }
        made
    }
}

/// Adds the pieces of `trunk` between neighbouring `cuts`, with their lesions.
fn cut(trunk: &Trunk, cuts: &[f64], per_mm: f64, made: &mut Vasculature) {
    let pieces = cuts.len() - 1;
    for (n, ends) in cuts.windows(2).enumerate() {
        let [from, to] = [ends[0], ends[1]];
        let name = if pieces == 1 { trunk.name.clone() } else { format!("{} {}", trunk.name, n + 1) };
        let steps = (((to - from) * per_mm).round() as usize).max(2);
        // The ends are exactly at the cuts, so that neighbours share their end points.
        let place = |j: usize| if j == steps { to } else { from + (to - from) * j as f64 / steps as f64 };
        let places: Vec<f64> = (0..=steps).map(place).collect();
        let reference: Vec<f64> = places.iter().map(|s| trunk.curve.at(*s).1).collect();
        let vessel = KnownVessel {
            name,
            points: places.iter().map(|s| trunk.curve.at(*s).0).collect(),
            lumen: places.iter().map(|s| trunk.lumen(*s)).collect(),
            wall: reference.iter().copied().map(wall_thickness).collect(),
            reference,
        };
        let piece = Piece { trunk, from, to, vessel: made.vessels.len(), points: &vessel.points };
        piece.add_lesions(n + 1 == pieces, made);
        made.vessels.push(vessel);
    }
}

struct Piece<'a> {
    trunk: &'a Trunk,
    from: f64,
    to: f64,
    vessel: usize,
    points: &'a [DVec3],
}

impl Piece<'_> {
    /// Adds the lesions whose middle lies on this piece; a lesion at its end belongs to the next piece, if there is one.
    fn add_lesions(&self, last: bool, made: &mut Vasculature) {
        let mine = |s: f64| s >= self.from && (s < self.to || last);
        for [s, length, percent] in self.trunk.stenoses.iter().copied().filter(|s| mine(s[0])) {
            let (vessel, arc_length) = (self.vessel, self.arc_length(s));
            made.stenoses.push(Stenosis { vessel, arc_length, length, percent });
            made.plaques.push(Plaque {
                vessel,
                arc_length,
                kind: PlaqueKind::Soft,
                angle: 0.0,
                length,
                angular_extent: WHOLE_RING,
                thickness: percent / 100.0 * self.trunk.curve.at(s).1,
                position: self.trunk.curve.at(s).0,
            });
        }
        for calcium in self.trunk.calcifications.iter().filter(|c| mine(c.arc_length)) {
            let lumen = |s: f64| self.trunk.lumen(s);
            made.plaques.push(Plaque {
                vessel: self.vessel,
                arc_length: self.arc_length(calcium.arc_length),
                kind: PlaqueKind::Calcified,
                angle: calcium.angle,
                length: calcium.length,
                angular_extent: calcium.angular_extent,
                thickness: calcium.thickness,
                position: calcium.position(&self.trunk.curve, lumen(calcium.arc_length)),
            });
            made.calcium.extend(calcium.rods(&self.trunk.curve, lumen));
        }
    }

    /// Converts arc length `s` on the trunk to arc length along the vessel's points.
    fn arc_length(&self, s: f64) -> f64 {
        let steps = self.points.len() - 1;
        let place = (s - self.from) / (self.to - self.from) * steps as f64;
        let whole = (place as usize).min(steps - 1);
        let before: f64 = self.points[..=whole].windows(2).map(|p| p[0].distance(p[1])).sum();
        before + (place - whole as f64) * self.points[whole].distance(self.points[whole + 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fork() -> Vasculature {
        let mut network = Network::new(1);
        let trunk = network.trunk("trunk", &[[0.0, 0.0, 0.0, 5.0], [0.0, 3.0, 100.0, 4.0]], 2.0);
        network.branch(trunk, "branch", &[[0.0, 0.0, 50.0, 3.0], [40.0, 0.0, 80.0, 2.0]], 1.0);
        network.stenosis(trunk, 0.8, 12.0, 60.0);
        network.scatter_calcium(trunk, 3, [0.1, 0.4]);
        network.finish(100)
    }

    #[test]
    fn a_branch_cuts_its_parent_and_shares_the_junction() {
        let made = fork();
        let names: Vec<&str> = made.vessels.iter().map(|v| v.name.as_str()).collect();
        assert_eq!(names, ["trunk 1", "trunk 2", "branch"]);
        let junction = made.vessels[0].points.last();
        assert_eq!(junction, made.vessels[1].points.first());
        assert_eq!(junction, made.vessels[2].points.first());
    }

    #[test]
    fn lesions_lie_on_the_piece_that_carries_them() {
        let made = fork();
        let stenosis = made.stenoses[0];
        assert_eq!(stenosis.vessel, 1);
        let vessel = &made.vessels[1];
        let share = vessel.lumen.iter().zip(&vessel.reference).map(|(l, r)| l / r).fold(1.0, f64::min);
        assert!((share - 0.4).abs() < 1e-12);
        assert_eq!(
            made.plaques.iter().filter(|p| p.kind == PlaqueKind::Calcified && p.vessel == 0).count(),
            3
        );
    }

    #[test]
    fn segments_come_out_as_asked() {
        let segments: usize = fork().vessels.iter().map(|v| v.points.len() - 1).sum();
        assert!((98..=102).contains(&segments), "{segments}");
    }
}

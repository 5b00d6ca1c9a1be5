//! Wide vessels with their branches: the abdominal aorta above its bifurcation, and the aortic arch.

use glam::DVec3;

use crate::suggested_names::graph::{Course, Graph, Way};

/// Radii of an aorta (mm).
const AORTA: [f64; 2] = [5.5, 45.0];
/// The trunk above the bifurcation is followed this far, its branches and legs this far (mm).
const TRUNK: f64 = 400.0;
pub(super) const BRANCH: f64 = 120.0;
const LEGS: f64 = 80.0;
/// A trunk above a bifurcation rises at least this far over its first 60 mm; each leg falls at least this far (mm).
const RISE: f64 = 36.0;
const FALL: f64 = 30.0;
/// The legs of a bifurcation end at least this far apart (mm).
const APART: f64 = 22.0;
/// Radius of a leg as a share of the trunk's.
const LEG_SHARE: [f64; 2] = [0.25, 0.95];
/// A trunk ends where its radius falls below this share.
const TRUNK_ENDS: f64 = 0.5;
/// Both limbs of the arch fall within this length; the descending one ends this far behind the other one, not to its right (mm).
const LIMB: f64 = 90.0;
const BEHIND: f64 = 20.0;
/// Arches whose tops are nearer than this are the same (mm).
const SAME_TOP: f64 = 10.0;
/// Branches of the arch start within this distance from its top (mm).
const NEAR_TOP: f64 = 70.0;

/// A branch of a trunk.
pub(super) struct Branch {
    /// Where it starts on the trunk (mm).
    pub at: f64,
    pub course: Course,
    /// Its radius outside the trunk (mm).
    pub radius: f64,
    /// Its direction just outside the trunk.
    pub heading: DVec3,
}

/// A trunk with its branches, in order.
pub(super) struct Trunk {
    pub course: Course,
    pub branches: Vec<Branch>,
}

impl Trunk {
    fn of(graph: &Graph, mut course: Course) -> Self {
        let usual = course.radius();
        let kept = course.ways.iter().take_while(|way| graph.radius(**way) >= TRUNK_ENDS * usual).count();
        course.ways.truncate(kept.max(1));
        let starts = course.starts(graph);
        let mut branches = Vec::new();
        for (number, before) in course.ways.iter().enumerate() {
            let at = starts[number] + graph.length(*before);
            let others = graph.after(*before).into_iter().filter(|way| !course.has(way.piece));
            branches.extend(others.map(|way| Branch::of(graph, way, at, usual)));
        }
        Self { course, branches }
    }
}

impl Branch {
    fn of(graph: &Graph, way: Way, at: f64, trunk: f64) -> Self {
        let course = graph.course(way, BRANCH);
        let inner = trunk.min(0.5 * course.length());
        let radius = course.radius_between(inner, inner + 40.0);
        let heading = course.reach(trunk + 15.0).normalize_or_zero();
        Self { at, course, radius, heading }
    }

    pub(super) fn length(&self) -> f64 {
        self.course.length()
    }
}

/// The abdominal aorta, from its bifurcation upwards, and the right and left leg.
pub(super) struct Bifurcation {
    pub trunk: Trunk,
    pub legs: [Way; 2],
}

/// All bifurcations that may be that of the aorta. The inferior vena cava has one too.
pub(super) fn bifurcations(graph: &Graph) -> Vec<Bifurcation> {
    let mut found = Vec::new();
    for up in graph.ways().filter(|way| (AORTA[0]..AORTA[1]).contains(&graph.radius(*way))) {
        let course = graph.course(up, 60.0);
        if course.reach(60.0).z < RISE {
            continue;
        }
        let radius = course.radius();
        if let Some(legs) = legs(graph, up, radius) {
            let trunk = Trunk::of(graph, graph.course(up, TRUNK));
            found.push(Bifurcation { trunk, legs });
        }
    }
    found
}

/// The right and left vessel below a trunk.
fn legs(graph: &Graph, up: Way, trunk: f64) -> Option<[Way; 2]> {
    let falls = |way: &Way| {
        let course = graph.course(*way, LEGS);
        let share = course.radius_between(10.0, LEGS) / trunk;
        course.reach(LEGS).z <= -FALL && (LEG_SHARE[0]..LEG_SHARE[1]).contains(&share)
    };
    let below = graph.after(Graph::reversed(up));
    let legs: Vec<Way> = below.into_iter().filter(falls).collect();
    let &[a, b] = &legs[..] else { return None };
    let [first, second] = [a, b].map(|way| graph.course(way, LEGS).reach(LEGS).x);
    ((first - second).abs() >= APART).then_some(if first < second { [a, b] } else { [b, a] })
}

/// All vessels that may be the aortic arch, from the ascending to the descending limb. The pulmonary trunk has a similar shape.
pub(super) fn arches(graph: &Graph) -> Vec<Trunk> {
    let wide = graph.ways().filter(|way| (AORTA[0]..AORTA[1]).contains(&graph.radius(*way)));
    let mut arches: Vec<(DVec3, f64, Trunk)> = Vec::new();
    for (place, rise, arch) in wide.filter_map(|way| arch_from(graph, way)) {
        match arches.iter_mut().find(|(known, ..)| known.distance(place) < SAME_TOP) {
            Some(known) if known.1 < rise => *known = (place, rise, arch),
            Some(_) => {}
            None => arches.push((place, rise, arch)),
        }
    }
    arches.into_iter().map(|(_, _, arch)| arch).collect()
}

/// The top of an arch whose ascending limb begins with this way, where it is, and the arch.
fn arch_from(graph: &Graph, way: Way) -> Option<(DVec3, f64, Trunk)> {
    let course = graph.course(way, 2.0 * LIMB);
    let rise = top(&course);
    let [first, highest, last] = [0.0, rise, rise + LIMB].map(|at| course.point(at));
    let falls = [first, last].iter().all(|end| highest.z - end.z >= FALL);
    let is_behind = last.y - first.y >= BEHIND && last.x >= first.x;
    if !falls || !is_behind {
        return None;
    }
    let mut arch = Trunk::of(graph, graph.course(way, TRUNK));
    arch.branches.retain(|branch| (branch.at - rise).abs() <= NEAR_TOP);
    Some((highest, rise, arch))
}

/// Where a course is highest (mm).
fn top(course: &Course) -> f64 {
    let places = (0..=course.length() as usize).map(|at| at as f64);
    places.max_by(|a, b| course.point(*a).z.total_cmp(&course.point(*b).z)).unwrap_or_default()
}

//! Rules for the branches of the aortic arch.

use crate::suggested_names::given::Given;
use crate::suggested_names::graph::{Course, Graph, Way};
use crate::suggested_names::trunk::{BRANCH, Branch, Trunk};
use crate::vessel_names::Side;

/// A branch of the arch rises by this share of its length, has at least this radius (mm) and length (mm).
const RISES: f64 = 0.6;
const RADIUS: f64 = 1.4;
const LENGTH: f64 = 35.0;
/// The brachiocephalic trunk divides between these lengths (mm).
const BRACHIOCEPHALIC: [f64; 2] = [15.0, 75.0];
/// Its name holds for this length where the place is not seen (mm).
const UNDIVIDED: f64 = 60.0;
/// The first branch is at least this much wider than the second one if there are only two.
const CLEARLY_WIDER: f64 = 1.2;
/// Subclavian arteries lead this far to their side within 100 mm (mm).
const ASIDE: f64 = 35.0;
/// Common carotid arteries divide between these lengths (mm); behind it, each part has at least this length (mm) and radius (mm).
const COMMON_CAROTID: [f64; 2] = [50.0, 200.0];
const CAROTID_LENGTH: f64 = 25.0;
const CAROTID_RADIUS: f64 = 0.9;
/// The external carotid artery has branches within this length, the internal one has none (mm).
const BRANCHES_WITHIN: f64 = 45.0;
/// The name of a common carotid artery holds for this length where the bifurcation is not seen (mm).
const UNDIVIDED_CAROTID: f64 = 90.0;
/// A vertebral artery starts within this length of the subclavian artery, and rises at least this far (mm).
const TO_VERTEBRAL: f64 = 80.0;
const VERTEBRAL_RISE: f64 = 90.0;
/// It ends where the other one joins it, which falls this far from there (mm).
const VERTEBRAL_FALL: f64 = 30.0;
/// Vessels of the neck are followed this far (mm).
const LONG: f64 = 300.0;

/// Names the aorta and the branches of its arch, if they are those of an aorta.
pub(super) fn name_arch(graph: &Graph, arch: &Trunk, given: &mut Given) -> bool {
    let risers: Vec<&Branch> = arch.branches.iter().filter(|branch| rises(branch)).collect();
    let Some(first) = risers.first() else { return false };
    let is_right = risers[1..].iter().all(|other| other.course.reach(60.0).x > first.course.reach(60.0).x);
    let is_wide = risers[1..].iter().all(|other| first.radius >= CLEARLY_WIDER * other.radius);
    match risers[..] {
        [_, carotid, subclavian] if is_right && is_left_of(subclavian, carotid) => {
            name_brachiocephalic(graph, first, given);
            name_carotid(graph, &carotid.course, Side::Left, given);
            name_subclavian(graph, &subclavian.course, Side::Left, given);
        }
        [_, subclavian] if is_right && is_wide => {
            name_brachiocephalic(graph, first, given);
            if left_carotid_of(graph, first).is_some() {
                name_subclavian(graph, &subclavian.course, Side::Left, given);
            }
        }
        _ => return false,
    }
    given.name(graph, &arch.course.ways, "aorta", None, f64::INFINITY);
    true
}

fn rises(branch: &Branch) -> bool {
    let reach = branch.course.reach(60.0);
    branch.length() >= LENGTH && branch.radius >= RADIUS && reach.z >= RISES * reach.length()
}

/// Whether one of two neighbouring branches does not lead to the right of the other one.
fn is_left_of(left: &Branch, right: &Branch) -> bool {
    left.course.point(60.0).x >= right.course.point(60.0).x
}

/// A branch of the brachiocephalic trunk near its start that leads to the left: the left carotid artery of a bovine arch.
fn left_carotid_of(graph: &Graph, trunk: &Branch) -> Option<Way> {
    let ways = &trunk.course.ways;
    let mut near = ways
        .iter()
        .zip(trunk.course.starts(graph))
        .filter(|(way, start)| start + graph.length(**way) <= 0.5 * BRACHIOCEPHALIC[1]);
    near.find_map(|(way, _)| {
        graph.after(*way).into_iter().find(|next| {
            let course = graph.course(*next, BRANCH);
            let reach = course.reach(50.0);
            !trunk.course.has(next.piece) && reach.x > 0.0 && reach.z >= RISES * reach.length()
        })
    })
}

/// Names the brachiocephalic trunk, the right common carotid and the right subclavian artery, and a left carotid artery that starts
/// from it.
fn name_brachiocephalic(graph: &Graph, trunk: &Branch, given: &mut Given) {
    let ways = &trunk.course.ways;
    if let Some(carotid) = left_carotid_of(graph, trunk) {
        name_carotid(graph, &graph.course(carotid, LONG), Side::Left, given);
    }
    for (number, start) in trunk.course.starts(graph).into_iter().enumerate() {
        let end = start + graph.length(ways[number]);
        if !(BRACHIOCEPHALIC[0]..BRACHIOCEPHALIC[1]).contains(&end) {
            continue;
        }
        let after: Vec<Course> =
            graph.after(ways[number]).into_iter().map(|way| graph.course(way, LONG)).collect();
        let right: Vec<_> = after.iter().filter(|course| course.reach(100.0).x <= -ASIDE).collect();
        let up = |course: &&Course| {
            course.reach(60.0).z >= 0.8 * course.reach(60.0).length() && course.length() >= LENGTH
        };
        let up: Vec<_> = after.iter().filter(|course| course.reach(100.0).x > -ASIDE).filter(up).collect();
        if let ([subclavian], [carotid]) = (&right[..], &up[..]) {
            given.name(graph, &ways[..=number], "brachiocephalic trunk", None, f64::INFINITY);
            name_carotid(graph, carotid, Side::Right, given);
            name_subclavian(graph, subclavian, Side::Right, given);
            return;
        }
    }
    given.name(graph, ways, "brachiocephalic trunk", None, UNDIVIDED);
}

/// Names a common carotid artery, and the internal and the external one behind its bifurcation.
fn name_carotid(graph: &Graph, start: &Course, side: Side, given: &mut Given) {
    let course = graph.course(start.ways[0], COMMON_CAROTID[1]);
    for (number, start) in course.starts(graph).into_iter().enumerate() {
        let end = start + graph.length(course.ways[number]);
        if !(COMMON_CAROTID[0]..COMMON_CAROTID[1]).contains(&end) {
            continue;
        }
        if let Some([internal, external]) = carotids(graph, &graph.after(course.ways[number])) {
            given.name(graph, &course.ways[..=number], "common carotid artery", Some(side), f64::INFINITY);
            given.name(
                graph,
                graph.undivided(&internal),
                "internal carotid artery",
                Some(side),
                f64::INFINITY,
            );
            given.name(graph, &external.ways, "external carotid artery", Some(side), f64::INFINITY);
            return;
        }
    }
    given.name(graph, &course.ways, "common carotid artery", Some(side), UNDIVIDED_CAROTID);
}

/// The internal and the external one of two vessels.
fn carotids(graph: &Graph, after: &[Way]) -> Option<[Course; 2]> {
    let rising = after.iter().map(|way| graph.course(*way, LONG / 2.0));
    let mut rising: Vec<Course> = rising
        .filter(|course| {
            course.length() >= CAROTID_LENGTH
                && course.radius_between(5.0, 40.0) >= CAROTID_RADIUS
                && course.reach(CAROTID_LENGTH).z > 0.0
        })
        .collect();
    let [Some(a), Some(b), None] = [rising.pop(), rising.pop(), rising.pop()] else { return None };
    match [&a, &b].map(|course| branches_near(graph, course) > 0) {
        [false, true] => Some([a, b]),
        [true, false] => Some([b, a]),
        _ => None,
    }
}

fn branches_near(graph: &Graph, course: &Course) -> usize {
    let ends = course.starts(graph).into_iter().skip(1);
    ends.filter(|start| *start <= BRANCHES_WITHIN).count()
}

/// Names a subclavian artery and its vertebral artery.
fn name_subclavian(graph: &Graph, course: &Course, side: Side, given: &mut Given) {
    let aside = if side == Side::Left { 1.0 } else { -1.0 };
    if course.length() > 100.0 && course.reach(150.0).x * aside < ASIDE {
        return;
    }
    given.name(graph, &course.ways, "subclavian artery", Some(side), f64::INFINITY);
    let mut rising = Vec::new();
    for (number, start) in course.starts(graph).into_iter().enumerate() {
        if start + graph.length(course.ways[number]) <= TO_VERTEBRAL {
            let others = graph.after(course.ways[number]).into_iter().filter(|way| !course.has(way.piece));
            let courses = others.map(|way| graph.course(way, LONG));
            rising.extend(courses.filter(|course| course.reach(150.0).z >= VERTEBRAL_RISE));
        }
    }
    if let [vertebral] = &rising[..] {
        let is_joined = |way: &Way| {
            graph.after(*way).iter().any(|next| graph.course(*next, LONG).reach(100.0).z <= -VERTEBRAL_FALL)
        };
        let end = vertebral.ways.iter().position(is_joined).map_or(vertebral.ways.len(), |place| place + 1);
        given.name(graph, &vertebral.ways[..end], "vertebral artery", Some(side), f64::INFINITY);
    }
}

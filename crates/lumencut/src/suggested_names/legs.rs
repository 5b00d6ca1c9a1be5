//! Rules for the arteries of a leg, below the external iliac artery.

use crate::suggested_names::given::Given;
use crate::suggested_names::graph::{Course, Graph, Way};
use crate::vessel_names::{Side, offered_name};

/// A leg is followed this far (mm).
const LEG: f64 = 1000.0;
/// The common femoral artery divides after these lengths of the external iliac artery, the popliteal artery after these of the
/// superficial femoral artery, and the tibioperoneal trunk after these (mm).
const FEMORAL_FORK: [f64; 2] = [60.0, 250.0];
const KNEE: [f64; 2] = [200.0, 650.0];
const TRUNK_FORK: [f64; 2] = [4.0, 90.0];
/// Each vessel behind a fork is at least this long and falls this share of it (mm).
const LONG: f64 = 100.0;
const FALLS: f64 = 0.7;
/// The narrower one is at least this share as wide as the other one.
const FEMORAL_SHARE: f64 = 0.45;
const CALF_SHARE: f64 = 0.6;
/// The superficial femoral artery falls that share of this length: where it is occluded, the deep one and its branches have a
/// similar fork (mm).
const TO_KNEE: f64 = 300.0;
/// The deep femoral artery runs this far behind the superficial one, and outside it, after as many mm (mm).
const DEEP_BEHIND: f64 = 10.0;
const DEEP_OUTSIDE: f64 = 4.0;
/// The anterior tibial artery runs this far before the trunk after as many mm, the fibular one outside the posterior one (mm).
const BEFORE: f64 = 12.0;
const BEFORE_AFTER: f64 = 60.0;
const OUTSIDE: f64 = 6.0;
/// A vessel does not become narrower than this share where a branch leaves it.
const NARROWS: f64 = 0.7;
/// Found lines part up to this far (mm) behind the place where their vessels part.
const FORK: f64 = 12.0;
/// Lengths that a name surely holds for (mm): the ends of the thigh's arteries are not seen without bone.
const COMMON_FEMORAL: f64 = 35.0;
const SUPERFICIAL_FEMORAL: f64 = 180.0;
const DEEP_FEMORAL: f64 = 150.0;
const POPLITEAL: f64 = 80.0;
const CALF: f64 = 250.0;

/// Names the arteries of a leg. Those below the knee get names only if all three are found. Returns the length of the external iliac
/// artery (mm), infinite if its end is not known.
pub(super) fn name_leg(graph: &Graph, external: Way, side: Side, given: &mut Given) -> f64 {
    let iliac = graph.course(external, LEG);
    let femorals = |a: &Course, b: &Course| femorals(a, b, side);
    let Some((end, [deep, superficial])) = fork(graph, &iliac, FEMORAL_FORK, FEMORAL_SHARE, femorals) else {
        return f64::INFINITY;
    };
    name_above(graph, &iliac.ways[..=end], "common femoral artery", side, COMMON_FEMORAL, given);
    given.name(graph, steady(graph, graph.undivided(&deep)), "deep femoral artery", Some(side), DEEP_FEMORAL);
    name_calf(graph, &superficial, side, given);
    given.name(
        graph,
        steady(graph, &superficial.ways),
        "superficial femoral artery",
        Some(side),
        SUPERFICIAL_FEMORAL,
    );
    iliac.ways[..=end].iter().map(|way| graph.length(*way)).sum::<f64>() - FORK - COMMON_FEMORAL
}

fn name_calf(graph: &Graph, superficial: &Course, side: Side, given: &mut Given) {
    let Some((end, [anterior, trunk])) = fork(graph, superficial, KNEE, CALF_SHARE, tibials) else { return };
    let outside = |a: &Course, b: &Course| outside(a, b, side);
    let Some((_, [fibular, posterior])) = fork(graph, &trunk, TRUNK_FORK, CALF_SHARE, outside) else {
        return;
    };
    name_above(graph, &superficial.ways[..=end], "popliteal artery", side, POPLITEAL, given);
    for (course, name) in [
        (anterior, "anterior tibial artery"),
        (fibular, "fibular artery"),
        (posterior, "posterior tibial artery"),
    ] {
        given.name(graph, steady(graph, &course.ways), name, Some(side), CALF);
    }
}

/// Consecutive ways up to the first that is much narrower than the one before: a branch, if the vessel's own end was not found.
fn steady<'w>(graph: &Graph, ways: &'w [Way]) -> &'w [Way] {
    let narrows = |pair: &[Way]| graph.radius(pair[1]) < NARROWS * graph.radius(pair[0]);
    let end = ways.windows(2).position(narrows).map_or(ways.len(), |place| place + 1);
    &ways[..end]
}

fn name_above(graph: &Graph, ways: &[Way], name: &str, side: Side, length: f64, given: &mut Given) {
    let upwards: Vec<Way> = ways.iter().rev().map(|way| Graph::reversed(*way)).collect();
    given.name_between(graph, &upwards, &offered_name(name, Some(side)), [FORK, FORK + length]);
}

/// The first way of a course whose end, in this range (mm), divides in exactly two long vessels that a rule tells apart.
fn fork(
    graph: &Graph,
    course: &Course,
    [from, to]: [f64; 2],
    share: f64,
    rule: impl Fn(&Course, &Course) -> bool,
) -> Option<(usize, [Course; 2])> {
    let starts = course.starts(graph).into_iter().enumerate();
    let ends = starts.map(|(number, start)| (number, start + graph.length(course.ways[number])));
    ends.filter(|(_, end)| (from..=to).contains(end)).find_map(|(number, _)| {
        let behind = graph.after(course.ways[number]).into_iter().map(|way| graph.course(way, LEG));
        let mut falling: Vec<Course> = behind.filter(falls).collect();
        let [Some(a), Some(b), None] = [falling.pop(), falling.pop(), falling.pop()] else { return None };
        let [narrow, wide] = [f64::min, f64::max].map(|end| end(a.radius(), b.radius()));
        if narrow < share * wide {
            return None;
        }
        match [rule(&a, &b), rule(&b, &a)] {
            [true, false] => Some((number, [a, b])),
            [false, true] => Some((number, [b, a])),
            _ => None,
        }
    })
}

fn falls(course: &Course) -> bool {
    course.length() >= LONG && course.reach(LONG).z <= -FALLS * LONG
}

fn outwards(course: &Course, length: f64, side: Side) -> f64 {
    let aside = if side == Side::Left { 1.0 } else { -1.0 };
    course.reach(length).x * aside
}

fn femorals(deep: &Course, superficial: &Course, side: Side) -> bool {
    superficial.reach(TO_KNEE).z <= -FALLS * TO_KNEE
        && deep.reach(LONG).y - superficial.reach(LONG).y >= DEEP_BEHIND
        && outwards(deep, LONG, side) - outwards(superficial, LONG, side) >= DEEP_OUTSIDE
}

fn tibials(anterior: &Course, trunk: &Course) -> bool {
    trunk.reach(BEFORE_AFTER).y - anterior.reach(BEFORE_AFTER).y >= BEFORE
}

fn outside(fibular: &Course, posterior: &Course, side: Side) -> bool {
    outwards(fibular, LONG, side) - outwards(posterior, LONG, side) >= OUTSIDE
}

//! Rules for the branches of the abdominal aorta and of its legs.

use crate::suggested_names::given::Given;
use crate::suggested_names::graph::{Course, Graph, Way};
use crate::suggested_names::legs::name_leg;
use crate::suggested_names::trunk::{BRANCH, Bifurcation, Branch};
use crate::vessel_names::Side;

/// Heights above the bifurcation (mm).
const OF_VISCERAL: [f64; 2] = [50.0, 220.0];
const OF_RENAL: [f64; 2] = [40.0, 170.0];
const OF_INFERIOR_MESENTERIC: [f64; 2] = [12.0, 70.0];
/// A celiac trunk starts within this distance above the superior mesenteric artery (mm).
const ABOVE_MESENTERIC: [f64; 2] = [2.0, 45.0];
/// Renal arteries start at most this far above the superior mesenteric artery, and below it at most the second length (mm).
const AROUND_MESENTERIC: [f64; 2] = [-80.0, 12.0];
/// Smallest radius of each (mm).
const VISCERAL_RADIUS: f64 = 1.5;
const RENAL_RADIUS: f64 = 1.4;
const MESENTERIC_RADIUS: [f64; 2] = [0.7, 3.5];
/// A branch runs forwards, or sideways, if this share of its direction does.
const FORWARDS: f64 = 0.5;
const SIDEWAYS: f64 = 0.6;
/// A mesenteric artery falls at least this far (mm).
const MESENTERIC_FALL: f64 = 30.0;
/// A renal artery leads at least this far to its side over 80 mm, a splenic or hepatic artery over 50 mm (mm).
const ASIDE: f64 = 30.0;
const TO_ORGAN: f64 = 20.0;
/// The other branches of its side are at most this share as wide as the named one; otherwise none is named.
const CLEARLY_WIDER: f64 = 0.75;
/// Lengths that a name holds for (mm): beyond, the vessel has another name.
const ABDOMINAL_AORTA: f64 = 180.0;
const ABOVE_CELIAC: f64 = 60.0;
const EXTERNAL_ILIAC: f64 = 120.0;
const INTERNAL_ILIAC: f64 = 70.0;
/// The common hepatic artery is at least this share as wide as the splenic one.
const HEPATIC_SHARE: f64 = 0.65;
/// Celiac trunks end within this length (mm).
const CELIAC: f64 = 50.0;
/// Common iliac arteries end between these lengths (mm).
const COMMON_ILIAC: [f64; 2] = [20.0, 120.0];
/// The internal iliac artery runs this far behind the external one after as many mm (mm).
const ILIACS_APART: f64 = 12.0;
const ILIACS_AFTER: f64 = 50.0;
const ILIAC_RADIUS: f64 = 1.2;
/// The external one falls this far over that length (mm); the narrower one is at least this share as wide as the other one.
const ILIACS_FALL: f64 = 10.0;
const ILIAC_SHARE: f64 = 0.4;

/// Names the abdominal aorta and its branches, if it has a branch that veins do not have.
pub(super) fn name_abdominal(graph: &Graph, found: &Bifurcation, given: &mut Given) -> bool {
    let branches = &found.trunk.branches;
    let mesenteric = superior_mesenteric(branches);
    let celiac = mesenteric.and_then(|mesenteric| celiac_trunk(branches, mesenteric));
    let renals = Side::ALL.map(|side| renal(branches, side, mesenteric));
    if mesenteric.is_none() && renals.iter().any(Option::is_none) {
        return false;
    }
    let end = celiac.map_or(ABDOMINAL_AORTA, |celiac| celiac.at + ABOVE_CELIAC);
    given.name(graph, &found.trunk.course.ways, "abdominal aorta", None, end);
    if let Some(celiac) = celiac {
        name_celiac(graph, celiac, given);
    }
    if let Some(mesenteric) = mesenteric {
        given.name(graph, &mesenteric.course.ways, "superior mesenteric artery", None, f64::INFINITY);
    }
    for (renal, side) in renals.into_iter().zip(Side::ALL) {
        if let Some(renal) = renal {
            given.name(graph, graph.undivided(&renal.course), "renal artery", Some(side), f64::INFINITY);
        }
    }
    if let Some(inferior) = inferior_mesenteric(branches) {
        given.name(graph, &inferior.course.ways, "inferior mesenteric artery", None, f64::INFINITY);
    }
    for (leg, side) in found.legs.into_iter().zip([Side::Right, Side::Left]) {
        name_iliacs(graph, leg, side, given);
    }
    true
}

fn is_in([low, high]: [f64; 2], value: f64) -> bool {
    (low..=high).contains(&value)
}

/// The only branch that a rule accepts.
fn only(branches: &[Branch], rule: impl Fn(&Branch) -> bool) -> Option<&Branch> {
    let mut accepted = branches.iter().filter(|branch| rule(branch));
    let first = accepted.next()?;
    accepted.next().is_none().then_some(first)
}

fn superior_mesenteric(branches: &[Branch]) -> Option<&Branch> {
    only(branches, |branch| {
        is_in(OF_VISCERAL, branch.at)
            && branch.radius >= VISCERAL_RADIUS
            && branch.heading.y <= -FORWARDS
            && branch.course.reach(BRANCH).z <= -MESENTERIC_FALL
    })
}

fn celiac_trunk<'a>(branches: &'a [Branch], mesenteric: &Branch) -> Option<&'a Branch> {
    only(branches, |branch| {
        is_in(ABOVE_MESENTERIC, branch.at - mesenteric.at)
            && branch.radius >= VISCERAL_RADIUS
            && branch.heading.y <= -FORWARDS
    })
}

/// The renal artery of a side, if it is clearly the widest branch there.
fn renal<'a>(branches: &'a [Branch], side: Side, mesenteric: Option<&Branch>) -> Option<&'a Branch> {
    let aside = if side == Side::Left { 1.0 } else { -1.0 };
    let is_sideways = |branch: &&Branch| {
        is_in(OF_RENAL, branch.at)
            && mesenteric.is_none_or(|other| is_in(AROUND_MESENTERIC, branch.at - other.at))
            && branch.heading.x * aside >= SIDEWAYS
            && branch.course.reach(80.0).x * aside >= ASIDE
    };
    let sideways = || branches.iter().filter(is_sideways);
    let widest = sideways().max_by(|a, b| a.radius.total_cmp(&b.radius))?;
    let as_wide = sideways().filter(|other| other.radius > CLEARLY_WIDER * widest.radius).count();
    (as_wide == 1 && widest.radius >= RENAL_RADIUS).then_some(widest)
}

fn inferior_mesenteric(branches: &[Branch]) -> Option<&Branch> {
    only(branches, |branch| {
        is_in(OF_INFERIOR_MESENTERIC, branch.at)
            && is_in(MESENTERIC_RADIUS, branch.radius)
            && branch.heading.y < 0.0
            && branch.course.reach(BRANCH).z <= -MESENTERIC_FALL
    })
}

/// Names the celiac trunk up to its fork, and the splenic and the common hepatic artery behind it.
fn name_celiac(graph: &Graph, celiac: &Branch, given: &mut Given) {
    let ways = &celiac.course.ways;
    for (number, start) in celiac.course.starts(graph).into_iter().enumerate() {
        if start + graph.length(ways[number]) > CELIAC {
            break;
        }
        let after: Vec<Course> =
            graph.after(ways[number]).into_iter().map(|way| graph.course(way, BRANCH)).collect();
        let splenic: Vec<_> = after.iter().filter(|way| way.reach(50.0).x >= TO_ORGAN).collect();
        let hepatic: Vec<_> = after.iter().filter(|way| way.reach(50.0).x <= -TO_ORGAN).collect();
        let ([splenic], [hepatic]) = (&splenic[..], &hepatic[..]) else { continue };
        if hepatic.radius() >= HEPATIC_SHARE * splenic.radius() {
            given.name(graph, &ways[..=number], "celiac trunk", None, f64::INFINITY);
            given.name(graph, &splenic.ways, "splenic artery", None, f64::INFINITY);
            given.name(graph, &hepatic.ways, "common hepatic artery", None, f64::INFINITY);
            return;
        }
    }
    given.name(graph, ways, "celiac trunk", None, CELIAC);
}

/// Names the iliac arteries of a side; only the common one if its end is not seen.
fn name_iliacs(graph: &Graph, leg: Way, side: Side, given: &mut Given) {
    let course = graph.course(leg, COMMON_ILIAC[1]);
    for (number, start) in course.starts(graph).into_iter().enumerate() {
        let end = start + graph.length(course.ways[number]);
        if !is_in(COMMON_ILIAC, end) {
            continue;
        }
        let after = graph.after(course.ways[number]);
        if let Some([internal, external]) = iliacs(graph, &after) {
            given.name(graph, &course.ways[..=number], "common iliac artery", Some(side), f64::INFINITY);
            given.name(
                graph,
                graph.undivided(&internal),
                "internal iliac artery",
                Some(side),
                INTERNAL_ILIAC,
            );
            let end = name_leg(graph, external.ways[0], side, given).min(EXTERNAL_ILIAC);
            given.name(graph, &external.ways, "external iliac artery", Some(side), end);
            return;
        }
    }
    given.name(graph, &course.ways, "common iliac artery", Some(side), COMMON_ILIAC[0]);
}

/// The internal and the external one of two vessels.
fn iliacs(graph: &Graph, after: &[Way]) -> Option<[Course; 2]> {
    let wide = after.iter().map(|way| graph.course(*way, BRANCH));
    let mut wide: Vec<Course> = wide
        .filter(|course| course.length() >= 0.6 * ILIACS_AFTER && iliac_radius(course) >= ILIAC_RADIUS)
        .collect();
    let [Some(a), Some(b), None] = [wide.pop(), wide.pop(), wide.pop()] else { return None };
    let [narrow, broad] = [f64::min, f64::max].map(|end| end(iliac_radius(&a), iliac_radius(&b)));
    if narrow < ILIAC_SHARE * broad {
        return None;
    }
    let behind = a.point(ILIACS_AFTER).y - b.point(ILIACS_AFTER).y;
    let [internal, external] = if behind > 0.0 { [a, b] } else { [b, a] };
    let falls = external.reach(ILIACS_AFTER).z <= -ILIACS_FALL;
    (falls && behind.abs() >= ILIACS_APART).then_some([internal, external])
}

fn iliac_radius(course: &Course) -> f64 {
    course.radius_between(8.0, ILIACS_AFTER)
}

//! Suggests names for vessels by a short list of rules about their place, course, width and branches. A suggestion is for a reader
//! to confirm: no vessel is named by it. A vessel about which the rules are not sure gets none.

mod branches;
mod given;
mod graph;
mod legs;
mod neck;
mod trunk;
mod veins;

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::volume::Volume;

use crate::suggested_names::given::Given;
pub use crate::suggested_names::given::NamedStretch;
use crate::suggested_names::graph::{Graph, Tube};
use crate::suggested_names::trunk::Bifurcation;
use crate::suggested_names::veins::Aorta;

/// A line has a suggested name if at least this share of it has one: a vessel is often traced on into its branches.
const NAMED_SHARE: f64 = 0.35;
/// Stretches shorter than this do not count in the name of a line (mm).
const SHORTEST: f64 = 8.0;

/// Names of the stretches that show how bright arteries are.
const AORTA: [&str; 2] = ["Aorta", "Abdominal aorta"];

/// What the rules say of a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SuggestedName {
    /// Name of the line; None if the rules are not sure, or if the line is another vessel for the most part.
    pub name: Option<String>,
    /// The named parts of the line.
    pub stretches: Vec<NamedStretch>,
    /// Whether the line seems to be a vein or part of the heart.
    pub is_vein_or_heart: bool,
}

/// Whether a name is offered to a reader: the vessel has no name, or only one with a number, such as `Vessel 3`.
pub fn is_nameless(name: &str) -> bool {
    name.chars().next_back().is_none_or(|last| last.is_ascii_digit())
}

/// Suggests names for lines with their radii (mm, LPS). Lines meet where one ends at a point of another. A line of unknown radius gets
/// no name. Without a volume, no line is suggested to be a vein or the heart.
pub fn suggested_names(lines: &[(&[DVec3], Option<&[f64]>)], volume: Option<&Volume>) -> Vec<SuggestedName> {
    let known = |line: &usize| lines[*line].1.is_some_and(|radius| radius.iter().any(|radius| *radius > 0.0));
    let numbers: Vec<usize> = (0..lines.len()).filter(known).collect();
    let tubes: Vec<Tube> = numbers.iter().map(|n| (lines[*n].0, lines[*n].1.unwrap_or_default())).collect();
    let stretches = named(&tubes);
    let is_vein = veins_and_heart(&tubes, &stretches, volume);
    let mut suggested = vec![SuggestedName::default(); lines.len()];
    for (((line, tube), stretches), is_vein) in numbers.into_iter().zip(&tubes).zip(stretches).zip(is_vein) {
        let name = name_of(&stretches, tube.0);
        suggested[line] = SuggestedName { name, stretches, is_vein_or_heart: is_vein };
    }
    suggested
}

/// The named stretches of each tube.
fn named(tubes: &[Tube]) -> Vec<Vec<NamedStretch>> {
    let graph = Graph::of(tubes);
    let mut given = Given::default();
    // The pulmonary trunk and the inferior vena cava have similar shapes; the first with the branches of an aorta counts.
    trunk::arches(&graph).iter().any(|arch| neck::name_arch(&graph, arch, &mut given));
    let mut found = trunk::bifurcations(&graph);
    let width = |found: &Bifurcation| found.trunk.course.radius();
    while let Some(widest) = (0..found.len()).max_by(|a, b| width(&found[*a]).total_cmp(&width(&found[*b]))) {
        if branches::name_abdominal(&graph, &found.swap_remove(widest), &mut given) {
            break;
        }
    }
    (0..tubes.len()).map(|tube| given.of_line(&graph, tube)).collect()
}

fn veins_and_heart(tubes: &[Tube], stretches: &[Vec<NamedStretch>], volume: Option<&Volume>) -> Vec<bool> {
    let mut points = Vec::new();
    for ((line, radius), stretches) in tubes.iter().zip(stretches) {
        let lengths = arc_lengths(line);
        let is_aorta = |at: &f64| {
            let here = stretches.iter().find(|stretch| (stretch.range[0]..=stretch.range[1]).contains(at));
            here.is_some_and(|stretch| AORTA.contains(&&*stretch.name))
        };
        let all = lengths.iter().zip(line.iter().zip(*radius));
        points.extend(all.filter(|(at, _)| is_aorta(at)).map(|(_, (point, radius))| (*point, *radius)));
    }
    let named: Vec<bool> = stretches.iter().map(|stretches| !stretches.is_empty()).collect();
    let aorta = volume.and_then(|volume| Aorta::of(volume, points));
    aorta.map_or_else(|| vec![false; tubes.len()], |aorta| aorta.veins_and_heart(tubes, &named))
}

/// The name of a line, from the first and the last of its stretches.
fn name_of(stretches: &[NamedStretch], points: &[DVec3]) -> Option<String> {
    let length = |stretch: &NamedStretch| stretch.range[1] - stretch.range[0];
    let whole: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let named: f64 = stretches.iter().map(length).sum();
    let mut long = stretches.iter().filter(|stretch| length(stretch) >= SHORTEST.min(0.5 * whole));
    let first = long.next().filter(|_| named >= NAMED_SHARE * whole)?;
    let last = long.next_back().filter(|last| last.name != first.name);
    Some(last.map_or_else(
        || first.name.clone(),
        |last| format!("{} to {}", first.name, uncapitalised(&last.name)),
    ))
}

fn uncapitalised(name: &str) -> String {
    name[..1].to_lowercase() + &name[1..]
}

#[cfg(test)]
#[path = "tests/suggested_names.rs"]
mod tests;

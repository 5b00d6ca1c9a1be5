//! Detects doubtful centerlines: wrong point order, stray points, missing parts, and two lines in one vessel. An
//! ordered line raises no doubt, however tortuous, if its points are nearer to their neighbours than to other
//! stretches.

use glam::DVec3;

use crate::mends::{Mend, OfCenterlines};
use crate::text::{fixed, rounded};

mod nearby;
mod order;
mod shortest_tree;
mod side_by_side;

pub(crate) use order::found_order;
use order::{Disorder, LongStep, OrderDoubt, order_doubts};
use side_by_side::side_by_side;

/// A vessel to check.
#[derive(Clone, Copy, Debug)]
pub struct DoubtedLine<'a> {
    /// The points of the vessel (mm).
    pub points: &'a [DVec3],
    /// The radius at each point (mm), if known.
    pub radius: Option<&'a [f64]>,
    /// Name of the vessel; may be empty.
    pub name: &'a str,
}

/// A doubt about a vessel.
#[derive(Clone, Debug, PartialEq)]
pub struct LineDoubt {
    /// Index of the vessel.
    pub vessel: usize,
    /// Index of the other vessel, if two lie side by side.
    pub other: Option<usize>,
    /// The kind of doubt for programs: `order`, `gap`, `far` or `beside`.
    pub kind: &'static str,
    /// What was found and what it may mean.
    pub found: String,
    /// What the reader can do.
    pub advice: &'static str,
    /// A remedy that programs can offer to the user.
    pub mend: Option<Mend>,
}

impl LineDoubt {
    /// Finding and advice in one sentence that names no options.
    pub fn words(&self) -> String {
        format!("{}; {}", self.found, self.advice)
    }
}

/// Doubts that concern a single vessel, in the order of the vessels.
pub fn order_doubts_of(lines: &[DoubtedLine]) -> Vec<LineDoubt> {
    let mut found = Vec::new();
    for (vessel, line) in lines.iter().enumerate() {
        let doubts = order_doubts(line.points);
        let called = if lines.len() > 1 { called(vessel, line) } else { called_alone(line) };
        found.extend(doubts.iter().map(|doubt| order_doubt((vessel, &called), doubt, line)));
    }
    found
}

/// Doubts about pairs of vessels that run side by side, as if they were two lines of one vessel.
pub fn beside_doubts_of(lines: &[DoubtedLine]) -> Vec<LineDoubt> {
    let doubt_of_pair = |(first, second, length): (usize, usize, f64)| {
        let names = [first, second].map(|vessel| called(vessel, &lines[vessel]));
        let found = format!(
            "{} and {} lie side by side over {} mm: perhaps two lines of one vessel",
            names[0],
            names[1].strip_prefix("vessel ").unwrap_or(&names[1]),
            length.round()
        );
        LineDoubt {
            vessel: first,
            other: Some(second),
            kind: "beside",
            found: found.replacen("vessel ", "vessels ", 1),
            advice: "leave one of them out",
            mend: None,
        }
    };
    side_by_side(lines).into_iter().map(doubt_of_pair).collect()
}

fn called(vessel: usize, line: &DoubtedLine) -> String {
    if line.name.is_empty() { format!("vessel {vessel}") } else { format!("vessel {vessel} ({})", line.name) }
}

fn called_alone(line: &DoubtedLine) -> String {
    if line.name.is_empty() { "the vessel".to_owned() } else { line.name.to_owned() }
}

fn order_doubt((vessel, called): (usize, &str), doubt: &OrderDoubt, line: &DoubtedLine) -> LineDoubt {
    let (kind, found, advice, mend) = match doubt {
        OrderDoubt::Disorder(disorder) => {
            let mend = disorder.is_found.then(|| OfCenterlines::Reorder.into());
            ("order", disordered(called, disorder), "sort its points along the vessel", mend)
        }
        OrderDoubt::Gap(step) => {
            let found = format!("{called}: a gap of {}: perhaps a part is missing", long(step));
            ("gap", found, "check whether it is one vessel", None)
        }
        OrderDoubt::Stray(points, distance) => {
            let advice = "remove what does not belong to the vessel";
            ("far", strayed(called, points, *distance, line), advice, None)
        }
    };
    LineDoubt { vessel, other: None, kind, found, advice, mend }
}

fn disordered(called: &str, disorder: &Disorder) -> String {
    let [length, short] = disorder.lengths.map(mm);
    let is_too_long = disorder.lengths[0] > 2.0 * disorder.lengths[1];
    match &disorder.step {
        Some(step) if !is_too_long => {
            format!("{called}: a step of {}: perhaps its points are in the wrong order", long(step))
        }
        _ => format!(
            "{called} is {length} mm long, but a path through its points only {short} mm: perhaps they are in the wrong order"
        ),
    }
}

fn long(step: &LongStep) -> String {
    let times = (step.length / step.usual).round();
    format!("{} mm after point {}, {times} times the usual one", mm(step.length), step.after)
}

/// A length in mm: one decimal, or three digits below 10 mm.
fn mm(length: f64) -> String {
    if length < 10.0 { rounded(length, 3) } else { fixed(length, 1) }
}

fn strayed(called: &str, points: &[usize], distance: f64, line: &DoubtedLine) -> String {
    let distance = mm(distance);
    if let [one] = points {
        let place = line.points[*one].to_array().map(|x| rounded(x, 4)).join(", ");
        return format!("{called}: point {one} at ({place}) lies far from all others, {distance} mm");
    }
    let few: Vec<String> = points.iter().take(5).map(usize::to_string).collect();
    let more = if points.len() > few.len() { ", …" } else { "" };
    let numbers = few.join(", ");
    format!(
        "{called}: {} points ({numbers}{more}) lie far from all others, {distance} mm or more",
        points.len()
    )
}

#[cfg(test)]
#[path = "tests/line_doubts.rs"]
mod tests;

//! States measurements in words, which Python package and viewer share.

use lumencut_core::named::Named;
use lumencut_vessels::measure::flap::found::Flap;
use lumencut_vessels::measure::outer::found::OuterWall;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::Source;
use lumencut_vessels::measure::profile::outer_volume::OuterStretch;
use lumencut_vessels::measure::profile::stretch::CArm;
use lumencut_vessels::measure::section::flags::{LEFT_OUT, METAL};
use lumencut_vessels::measure::stenosis::{Doubts, Method, Stenosis};
use lumencut_vessels::measure::wall::{BRIGHT_WALL, CT_WALL, WallSource};

use crate::flag_table::set_in;
use crate::text::fixed;

/// The note if lengths assume 1 mm between voxels.
pub(crate) const MILLIMETRE_ASSUMED: &str = "The scan has no voxel spacing: 1 mm is assumed.";

/// The name of a method as readers see it: `NASCET`, `ECST` or `area`.
pub fn of_method(method: Method) -> String {
    match method {
        Method::Area => method.name().to_owned(),
        Method::Nascet | Method::Ecst => method.name().to_uppercase(),
    }
}

/// A stenosis in one line: percentage and method, diameter with uncertainty, and the reference.
pub fn of_stenosis(graded: &Stenosis) -> String {
    let what = if graded.method == Method::Area { "of the area" } else { "of the diameter" };
    let method = of_method(graded.method);
    let (against, places) = match graded.method {
        Method::Ecst => ("assumed original", String::new()),
        _ => ("reference", places(&graded.references)),
    };
    format!(
        "{} % {what} ({method}{}): {}, {against} {} mm{places}",
        of_percent(graded.percent, graded.percent_uncertainty),
        of_unreliable(graded.doubts.flags),
        of_diameter((graded.diameter, graded.uncertainty), graded.at),
        fixed(graded.reference, 2),
    )
}

/// A diameter with its uncertainty and its place (mm).
pub(crate) fn of_diameter((diameter, uncertainty): (f64, f64), at: f64) -> String {
    format!("{} ± {} mm at {} mm", fixed(diameter, 2), fixed(uncertainty, 2), fixed(at, 1))
}

/// States, in the first line, that the percentage rests on a section that does not count or that lies in metal.
fn of_unreliable(flags: u32) -> String {
    let left_out = of_flags(flags & LEFT_OUT).join(", ");
    let why = [
        (!left_out.is_empty()).then(|| format!("a section does not count: {left_out}")),
        (flags & METAL != 0).then(|| "a place lies in metal".to_owned()),
    ];
    let why: Vec<String> = why.into_iter().flatten().collect();
    if why.is_empty() { String::new() } else { format!("; doubtful, as {}", why.join(", and ")) }
}

/// A percentage with its standard deviation. The deviation is rounded up, since no percentage is accurate to less than 1 %.
fn of_percent(percent: f64, uncertainty: f64) -> String {
    if uncertainty.is_finite() {
        format!("{} ± {}", fixed(percent, 0), fixed(uncertainty.ceil().max(1.0), 0))
    } else {
        fixed(percent, 0)
    }
}

fn places(references: &[[f64; 2]]) -> String {
    let places: Vec<String> = references.iter().map(|[at, _]| format!("{} mm", fixed(*at, 1))).collect();
    if places.is_empty() { String::new() } else { format!(" at {}", places.join(", ")) }
}

/// The doubts about a percentage, one sentence each.
pub fn of_doubts(doubts: &Doubts) -> Vec<String> {
    let flags = of_flags(doubts.flags).join(", ");
    let at_places = (doubts.flags != 0).then(|| format!("At these places: {flags}."));
    let between =
        "A branch lies between the place and a reference: beyond it a vessel may be of another width.";
    at_places.into_iter().chain(doubts.is_branch_between.then(|| between.to_owned())).collect()
}

/// A stenosis as in [`of_stenosis`], then its doubts.
pub fn of_doubtful_stenosis(graded: &Stenosis) -> String {
    let doubts = of_doubts(&graded.doubts);
    let words = of_stenosis(graded);
    if doubts.is_empty() { words } else { format!("{words}. {}", doubts.join(" ")) }
}

/// The angles of a C-arm as it displays them, such as `RAO 20° CRAN 5°`. The side is that of the rounded angle.
pub fn of_c_arm(arm: &CArm) -> String {
    let [turn, tilt] = [arm.lao, arm.cranial].map(|angle| angle.to_degrees().round_ties_even());
    let side = if turn < 0.0 { "RAO" } else { "LAO" };
    let towards = if tilt < 0.0 { "CAUD" } else { "CRAN" };
    format!("{side} {}° {towards} {}°", fixed(turn.abs(), 0), fixed(tilt.abs(), 0))
}

/// The source of a point-spread width: `given`, `estimated on …` or `assumed: …`.
pub fn of_source(source: &Source) -> String {
    match source {
        Source::Given => "given".to_owned(),
        Source::Estimated { on } => format!("estimated on {on}"),
        Source::Assumed { from } => format!("assumed: {from}"),
    }
}

/// Whether walls were separated from the surroundings, and at which level.
pub fn of_wall(source: &WallSource) -> String {
    let level = |[level, deviation]: [f64; 2]| format!("{} ± {}", fixed(level, 0), fixed(deviation, 0));
    let in_ct = || format!("{} HU, as walls in CT", level(CT_WALL));
    let given = |as_given: &[f64; 2]| format!("{}, given", level(*as_given));
    match source {
        WallSource::Hounsfield => in_ct(),
        WallSource::Given(as_given) => given(as_given),
        WallSource::Pooled { given: before, by_others } => {
            let before = before.as_ref().map_or_else(in_ct, given);
            let (pooled, count) = (level(by_others.level), by_others.vessels);
            let others = if count == 1 { "vessel" } else { "vessels" };
            format!("{before}; {pooled} pooled with {count} other {others} of the tree")
        }
        WallSource::Bright => format!("{} HU, as plaque: the values show it", level(BRIGHT_WALL)),
        WallSource::PerhapsBright => format!("{}, or {} HU, as plaque", in_ct(), level(BRIGHT_WALL)),
        WallSource::NotAsked => "not separated, as requested".to_owned(),
        WallSource::DarkLumen => "not separated: the lumen is dark".to_owned(),
        WallSource::AsBright => "not separated: the surroundings are as bright".to_owned(),
        WallSource::OtherUnit => "not separated: nothing says that the values are HU".to_owned(),
    }
}

/// Whether the outside of a thick wall is visible, or why not.
pub fn of_outer_wall(outer: OuterWall) -> &'static str {
    match outer {
        OuterWall::Seen => "seen",
        OuterWall::Thin => "no thick layer around the lumen",
        OuterWall::NotCounted => "the lumen does not count",
        OuterWall::Metal => "metal hides it",
        OuterWall::Hidden => "tissue as bright touches it",
        OuterWall::Uneven => "not similar over 5 mm",
        OuterWall::NoLevel => "the level of thrombus is unknown",
    }
}

/// Whether both lumens of a dissected vessel are visible, or why not.
pub fn of_flap(flap: Flap) -> &'static str {
    match flap {
        Flap::Seen => "seen",
        Flap::Absent => "no thin flap next to the lumen",
        Flap::Metal => "metal hides it",
        Flap::Open => "a lumen is not enclosed",
        Flap::Dim => "a lumen is partly dim",
        Flap::Uneven => "not similar over 10 mm",
        Flap::NoLevel => "the level of the flap is unknown",
    }
}

/// The areas of both lumens of section `n` if a flap is visible, such as
/// `lumen of the line, up to the flap, 120 ± 3 mm²`, `other lumen next to it 300 ± 5 mm²` and `both 420 ± 8 mm²`.
pub fn of_lumens_at(profile: &Profile, n: usize) -> Option<[String; 3]> {
    let own = profile.area_own_lumen[n];
    let other = profile.area_other_lumen[n];
    let [own, other, both] = [own, other, profile.area_both_lumens()[n]]
        .map(|[area, unsure]| format!("{} ± {} mm²", fixed(area, 0), fixed(unsure, 0)));
    let is_seen = profile.flap[n] == Flap::Seen;
    is_seen.then(|| {
        [
            format!("lumen of the line, up to the flap, {own}"),
            format!("other lumen next to it {other}"),
            format!("both {both}"),
        ]
    })
}

/// The longest stretch that shows both lumens of a dissected vessel, in one sentence.
pub fn of_flap_stretch(profile: &Profile) -> Option<String> {
    let stretch = profile.flap_stretch()?;
    let [from, to] = stretch.ends.map(|mm| fixed(mm, 1));
    let widest = fixed(profile.arc_length[stretch.widest], 1);
    let lumens = of_lumens_at(profile, stretch.widest)?.join(", ");
    Some(format!(
        "Two lumens from {from} to {to} mm, parted by a flap or by the walls of two vessels; at {widest} mm, where they are widest: {lumens}."
    ))
}

/// The outer wall of the longest stretch that shows it around thrombus or plaque, in one sentence.
pub fn of_outer_stretch(stretch: &OuterStretch) -> String {
    let ([from, to], [at, diameter, unsure]) = (stretch.ends, stretch.widest);
    let [volume, doubt] = stretch.volume.map(|cubic_mm| fixed(cubic_mm / 1000.0, 1));
    format!(
        "Outer wall, around thrombus or plaque: up to {} ± {} mm wide at {} mm; {volume} ± {doubt} ml from {} to {} mm.",
        fixed(diameter, 1),
        fixed(unsure, 1),
        fixed(at, 1),
        fixed(from, 1),
        fixed(to, 1),
    )
}

/// The outer wall of section `n` if it is visible around thrombus or plaque, such as `outer wall 32.1 ± 0.4 mm`.
pub fn of_outer_at(profile: &Profile, n: usize) -> Option<String> {
    let [diameter, unsure] = profile.diameter_outer[n];
    let is_seen = profile.outer_wall[n] == OuterWall::Seen;
    is_seen.then(|| format!("outer wall {} ± {} mm", fixed(diameter, 1), fixed(unsure, 1)))
}

/// The diameter (mm) without and with adjacent calcium or metal; None if nothing there is brighter than the lumen.
pub(crate) fn of_bounds([excluded, included]: [f64; 2]) -> Option<String> {
    let [excluded, included] = [excluded, included].map(|mm| mm.is_finite().then(|| fixed(mm, 2)));
    Some(format!("{} mm if brighter material is excluded, {} mm if it is included", excluded?, included?))
}

/// The limit of a diameter (mm) at a throat without a clear wall.
pub(crate) fn of_limit(most: f64) -> String {
    format!("no clear wall, at most {} mm", fixed(most, 2))
}

/// The bounds or the limit of the diameter of section `n`, if it has any.
pub(crate) fn of_bounds_at(profile: &Profile, n: usize) -> Option<String> {
    let most = profile.at_most[n];
    of_bounds(profile.bounds[n])
        .or_else(|| most.is_finite().then(|| format!("at most {} mm", fixed(most, 2))))
}

/// The words for the flags that are set, such as `no clear wall`.
pub fn of_flags(flags: u32) -> Vec<String> {
    set_in(flags).map(|flag| flag.word.to_owned()).collect()
}

#[cfg(test)]
#[path = "tests/measure_words.rs"]
mod tests;

//! The patient sides that files state for a straightened volume: the axes nearest to its frame at the middle of the vessel.

use glam::DVec3;
use lumencut_core::math::frames::MovingFrame;
use lumencut_core::reformations::cpr::Straightened;

use crate::letters::{PREFERRED_AXES, nearest_axes, sides};

/// Readers are warned if a true axis deviates from its stated side by more than this (degrees).
const MAX_TURN_DEGREES: f64 = 45.0;

/// The middle frame is the mean over this length (mm) to each side, from this number of samples plus one.
const MIDDLE_HALF_LENGTH_MM: f64 = 5.0;
const MIDDLE_SAMPLES: u32 = 40;

const SIDES: [(char, &str); 6] =
    [('R', "right"), ('L', "left"), ('A', "front"), ('P', "back"), ('I', "feet"), ('S', "head")];

/// The text of [`StraightenedSides::mark`] before the letters and after the angle.
const MARK: [&str; 2] = ["Lumencut straightened vessel; sides ", " deg off"];

/// The length of text (bytes) that is searched after the start of a mark.
const MAX_MARK_LETTERS: usize = 64;

/// The text between letters and angle, for scans without and with a stated orientation.
const BETWEEN: [&str; 2] = [" if the scan is LPS; up to ", " at its middle; up to "];

/// The sides that files state for a straightened volume.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightenedSides {
    /// The sides towards which i (across), j (into the picture) and k (along) run.
    letters: String,
    /// The largest deviation of a true axis from its stated side, over the whole vessel (0.1 degrees).
    turn: u32,
    is_stated: bool,
}

impl StraightenedSides {
    /// The patient axes nearest to the frame at the vessel's middle, with its handedness. The deviation is sampled every `step` mm.
    pub fn of(space: &Straightened, step: f64, is_stated: bool) -> Self {
        let stated = nearest_axes(middle(space));
        let sections = (space.length() / step).floor() as usize;
        let places = (0..=sections).map(|n| n as f64 * step).chain([space.length()]);
        let least = places.flat_map(|at| cosines(axes(space.frame(at)), stated)).fold(1.0_f64, f64::min);
        let turn = (least.clamp(-1.0, 1.0).acos().to_degrees() * 10.0).round() as u32;
        Self { letters: stated.map(sides).concat(), turn, is_stated }
    }

    /// Parses a [`StraightenedSides::mark`] found in a text, such as a file header.
    pub fn read(text: &str) -> Option<Self> {
        let (_, rest) = text.split_once(MARK[0])?;
        let rest = rest.get(..MAX_MARK_LETTERS.min(rest.len())).unwrap_or(rest);
        let (is_stated, between) =
            [false, true].into_iter().zip(BETWEEN).find(|(_, words)| rest.contains(words))?;
        let (letters, rest) = rest.split_once(between)?;
        let turn: f64 = rest.split_once(MARK[1])?.0.parse().ok()?;
        let is_sound = letters.chars().count() == 3
            && letters.chars().all(|letter| word(letter).is_some())
            && (0.0..=180.0).contains(&turn);
        is_sound.then(|| Self { letters: letters.to_owned(), turn: (turn * 10.0).round() as u32, is_stated })
    }

    /// The sides as letters, such as `LPI`.
    pub fn letters(&self) -> &str {
        &self.letters
    }

    /// The directions (LPS) of the sides.
    pub fn axes(&self) -> [DVec3; 3] {
        let axis = |letter: char| PREFERRED_AXES.into_iter().find(|axis| sides(*axis).starts_with(letter));
        let mut letters = self.letters.chars();
        [(); 3].map(|()| letters.next().and_then(axis).unwrap_or_default())
    }

    /// A short ASCII text that marks files, at most 79 characters long.
    pub fn mark(&self) -> String {
        let ([before, after], between) = (MARK, BETWEEN[usize::from(self.is_stated)]);
        format!("{before}{}{between}{:.1}{after}", self.letters, self.degrees())
    }

    /// Warnings for readers of the volume; none if the sides are right along the whole vessel.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if !self.is_stated {
            let words = "the scan states no orientation: the sides of the straightened vessel assume LPS";
            notes.push(words.to_owned());
        }
        let along = self.letters.chars().nth(2).unwrap_or_default();
        if !matches!(along, 'I' | 'S') {
            let side = word(along).unwrap_or_default();
            notes.push(format!(
                "the vessel runs across the body at its middle: its sections progress to the patient's {side}"
            ));
        }
        if self.degrees() > MAX_TURN_DEGREES {
            let off = self.degrees();
            notes.push(format!(
                "the sides of the straightened vessel hold at its middle; along the vessel they are up to {off:.1}° off"
            ));
        }
        notes
    }

    fn degrees(&self) -> f64 {
        f64::from(self.turn) / 10.0
    }
}

fn middle(space: &Straightened) -> [DVec3; 3] {
    let half = space.length() / 2.0;
    let reach = MIDDLE_HALF_LENGTH_MM.min(half);
    let frames = (0..=MIDDLE_SAMPLES)
        .map(|n| space.frame(half + reach * (2.0 * f64::from(n) / f64::from(MIDDLE_SAMPLES) - 1.0)));
    let [tangent, ahead] = frames
        .map(|frame| [frame.tangent, frame.ahead])
        .fold([DVec3::ZERO; 2], |sum, frame| [sum[0] + frame[0], sum[1] + frame[1]]);
    axes(MovingFrame::looking(tangent.normalize_or(space.frame(half).tangent), ahead))
}

fn axes(frame: MovingFrame) -> [DVec3; 3] {
    [frame.across, frame.ahead, frame.tangent]
}

fn cosines(one: [DVec3; 3], other: [DVec3; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| one[axis].dot(other[axis]))
}

fn word(letter: char) -> Option<&'static str> {
    SIDES.iter().find(|(known, _)| *known == letter).map(|(_, word)| *word)
}

#[cfg(test)]
#[path = "tests/straightened_sides.rs"]
mod tests;

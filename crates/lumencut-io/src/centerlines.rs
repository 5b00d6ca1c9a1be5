//! What a centerline file holds, and what is tidied before it is handed on.

use glam::DVec3;

use crate::error::{Error, Result};

/// The patient space of a file's coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// x to the left, y to the back, z to the head.
    Lps,
    /// x to the right, y to the front, z to the head.
    Ras,
}

/// One polyline of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// The points (mm) in the file's own space; at least two, finite, no two neighbours equal.
    pub points: Vec<DVec3>,
    /// The radius at each point (mm), finite and ≥ 0, where the file has one.
    pub radius: Option<Vec<f64>>,
    /// The group that a branch splitter gave this line; lines of one group run along the same vessel.
    pub group: Option<i64>,
    /// The name that the file gives this line.
    pub name: Option<String>,
}

/// The lines of one file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Centerlines {
    /// The lines in the order of the file, at least one.
    pub lines: Vec<Line>,
    /// The space that the file states; `None` where it states none.
    pub space: Option<Space>,
    /// Whether the file says that its lines are vessels already, so that none is joined to another.
    pub joined: bool,
    /// What a user should know about how the file was read, one sentence each.
    pub notes: Vec<String>,
}

/// What a file of this crate carries, to say that its lines are vessels already.
pub(crate) const JOINED_MARK: &str = "LumencutVessels";

/// Beyond this no coordinate or radius (mm) belongs to a patient: a damaged file, or binary data read the
/// wrong way. The core draws the same line.
const LARGEST_COORDINATE: f64 = 1e6;

impl Centerlines {
    /// Checks every line, drops repeated points and lines that are no lines, and notes both.
    ///
    /// # Errors
    /// For points or radii that are no places and sizes, and where no line is left.
    pub(crate) fn tidy(mut self) -> Result<Self> {
        let found = self.lines.len();
        let mut repeated = 0;
        for (index, line) in self.lines.iter_mut().enumerate() {
            check(line, index)?;
            repeated += drop_repeated_points(line);
        }
        self.lines.retain(|line| line.points.len() >= 2);
        if self.lines.is_empty() {
            let found = match found {
                0 => "no line".into(),
                n => format!("{n} line(s) of a single place each"),
            };
            return Err(Error::new("lines", found, "at least one line of two or more points"));
        }
        let dropped = found - self.lines.len();
        if dropped > 0 {
            self.notes.push(format!("{dropped} line(s) of fewer than two different points were dropped"));
        }
        if repeated > 0 {
            self.notes.push(format!("{repeated} point(s) equal to the one before were dropped"));
        }
        Ok(self)
    }
}

/// Checks that the points and radii of a line are places and sizes.
///
/// # Errors
/// Naming the line by its `index`.
pub(crate) fn check(line: &Line, index: usize) -> Result<()> {
    if let Some(i) = line.points.iter().position(|p| p.is_nan() || p.abs().max_element() > LARGEST_COORDINATE)
    {
        let found = format!("{} at point {i}", line.points[i]);
        return Err(Error::new(format!("points of line {index}"), found, "coordinates of at most 1e6 mm"));
    }
    let Some(radius) = &line.radius else { return Ok(()) };
    match radius.iter().position(|r| !(0.0..=LARGEST_COORDINATE).contains(r)) {
        None => Ok(()),
        Some(i) => {
            let found = format!("{} at point {i}", radius[i]);
            Err(Error::new(format!("radius of line {index}"), found, "radii from 0 to 1e6 mm"))
        }
    }
}

/// Drops points that equal their predecessor; returns how many.
fn drop_repeated_points(line: &mut Line) -> usize {
    let count = line.points.len();
    if let Some(radius) = &mut line.radius {
        let mut at = 0..count;
        radius.retain(|_| at.next().is_some_and(|i| i == 0 || line.points[i] != line.points[i - 1]));
    }
    line.points.dedup();
    count - line.points.len()
}

//! What a centerline file holds, and what is tidied before it is handed on.

use glam::DVec3;

use crate::error::{Error, Result};
use crate::space::Space;
use crate::unit::Unit;

/// One polyline of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// The points in the file's own space and unit; at least two, finite, no two neighbours equal.
    pub points: Vec<DVec3>,
    /// The radius at each point in the unit of the points, finite and ≥ 0, where the file has one; 0 where it states none.
    pub radius: Option<Vec<f64>>,
    /// The group that a branch splitter gave this line; lines of one group run along the same vessel.
    pub group: Option<i64>,
    /// The name that the file gives this line.
    pub name: Option<String>,
    /// How sure each point is, 0 to 1, where the line was traced; it is written and not read.
    pub confidence: Option<Vec<f64>>,
    /// The number of the list of points that was parted into this line and others at its long steps.
    pub list: Option<usize>,
}

/// The lines of one file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Centerlines {
    /// The lines in the order of the file, at least one.
    pub lines: Vec<Line>,
    /// The space that the file states; `None` where it states none.
    pub space: Option<Space>,
    /// The unit in which the file gives its lengths, where it or the definition of its format states one. It
    /// stays what the file states when the lines are [`scaled`](Self::scaled).
    pub unit: Option<Unit>,
    /// The unit that files of this format usually have.
    pub conventional_unit: Option<Unit>,
    /// The name of the format, such as "VTK XML PolyData".
    pub format: &'static str,
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

/// The largest coordinate that is believed, in the unit of the lines.
pub(crate) struct Limit {
    largest: f64,
    unit: &'static str,
}

impl Limit {
    /// The limit where the lines are in `unit`; where none is known, that of the smallest unit.
    pub(crate) fn of(unit: Option<Unit>) -> Self {
        let assumed = unit.unwrap_or(Unit::Micrometre);
        Self { largest: LARGEST_COORDINATE / assumed.in_mm(), unit: unit.map_or("", Unit::name) }
    }

    fn text(&self) -> String {
        format!("{:e} {}", self.largest, self.unit).trim_end().to_owned()
    }
}

impl Centerlines {
    /// No lines yet, of a format whose files usually are in mm.
    pub(crate) fn of(format: &'static str) -> Self {
        Self { format, conventional_unit: Some(Unit::Millimetre), ..Self::default() }
    }

    /// Adds a note that several lines may give, once.
    pub(crate) fn note_once(&mut self, note: String) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Takes radii that are NaN as unknown, and notes how many: a line without any radius has none, and 0 stands for single ones.
    fn without_nan_radii(mut self) -> Self {
        let (mut unknown, mut all) = (0, 0);
        for line in &mut self.lines {
            let nan = line.radius.iter().flatten().filter(|radius| radius.is_nan()).count();
            line.radius = line.radius.take().filter(|radius| nan < radius.len());
            let Some(radius) = &mut line.radius else { continue };
            all += radius.len();
            unknown += nan;
            radius.iter_mut().filter(|radius| radius.is_nan()).for_each(|radius| *radius = 0.0);
        }
        if unknown > 0 {
            self.notes.push(format!("{unknown} of {all} radii are not stated: unknown there"));
        }
        self
    }

    /// Takes radii that are 0 everywhere as missing, as programs write them that know none, and notes it.
    pub(crate) fn without_zero_radii(self) -> Self {
        let mut zero = self.without_nan_radii();
        zero.drop_zero_radii();
        zero
    }

    fn drop_zero_radii(&mut self) {
        let mut radii = self.lines.iter().filter_map(|line| line.radius.as_ref()).flatten().peekable();
        if radii.peek().is_some() && radii.all(|radius| *radius == 0.0) {
            self.lines.iter_mut().for_each(|line| line.radius = None);
            self.notes.push("every radius is 0: taken as missing".into());
        }
    }

    /// Notes what numbers that nothing names may be instead: indices of voxels, or a fourth column that is no
    /// radius.
    pub(crate) fn doubt_unnamed_columns(&mut self) {
        let mut numbers = self.lines.iter().flat_map(|line| &line.points).flat_map(|p| p.to_array());
        if numbers.all(|number| number.fract() == 0.0) {
            self.note_once(
                "all coordinates are whole numbers: perhaps indices of voxels, which are not mm".into(),
            );
        }
        let mut radii = self.lines.iter().filter_map(|line| line.radius.as_ref()).flatten();
        if let Some(first) = radii.next() {
            let same =
                if radii.all(|r| r == first) { format!(" ({first} everywhere)") } else { String::new() };
            self.note_once(format!("radius from the fourth column, which nothing names{same}"));
        }
    }

    /// Checks every line, drops repeated points and lines that are no lines, and notes both.
    ///
    /// # Errors
    /// For points or radii that are no places and sizes, and where no line is left.
    pub(crate) fn tidy(self) -> Result<Self> {
        let limit = Limit::of(self.unit);
        let mut out = self.without_nan_radii().checked(&limit)?;
        match out.lines.iter().filter(|line| line.radius.is_none()).count() {
            0 => {}
            n if n == out.lines.len() => out.notes.push("no radius in the file".into()),
            n => out.notes.push(format!("{n} of {} lines have no radius", out.lines.len())),
        }
        Ok(out)
    }

    /// The same lines with points and radii multiplied by `factor`, which brings them to mm.
    ///
    /// [`junctions::vessels`](crate::junctions::vessels) wants them so, because its limits are in mm.
    ///
    /// # Errors
    /// Where the factor is not above 0 and finite, or a coordinate or radius is then beyond 1e6 mm.
    pub fn scaled(mut self, factor: f64) -> Result<Self> {
        if !(factor > 0.0 && factor.is_finite()) {
            return Err(Error::new("scale", format!("{factor}"), "a finite factor above 0"));
        }
        for line in &mut self.lines {
            line.points.iter_mut().for_each(|p| *p *= factor);
            line.radius.iter_mut().flatten().for_each(|r| *r *= factor);
        }
        self.checked(&Limit::of(Some(Unit::Millimetre)))
    }

    fn checked(mut self, limit: &Limit) -> Result<Self> {
        let found = self.lines.len();
        let mut repeated = 0;
        for (index, line) in self.lines.iter_mut().enumerate() {
            check(line, index, limit)?;
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
pub(crate) fn check(line: &Line, index: usize, limit: &Limit) -> Result<()> {
    let is_far = |p: &DVec3| p.is_nan() || p.abs().max_element() > limit.largest;
    if let Some(i) = line.points.iter().position(is_far) {
        let found = format!("{} at point {i}", line.points[i]);
        let expected = format!("coordinates of at most {}", limit.text());
        return Err(Error::new(format!("points of line {index}"), found, expected));
    }
    let Some(radius) = &line.radius else { return Ok(()) };
    match radius.iter().position(|r| !(0.0..=limit.largest).contains(r)) {
        None => Ok(()),
        Some(i) => {
            let found = format!("{} at point {i}", radius[i]);
            let expected = format!("radii from 0 to {}", limit.text());
            Err(Error::new(format!("radius of line {index}"), found, expected))
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

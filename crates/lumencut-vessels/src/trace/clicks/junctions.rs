//! Joins vessels: a later line that enters an earlier vessel starts or ends at a point of that vessel.

use glam::DVec3;

use crate::trace::clicks::Traced;
use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::nearest_point;
use crate::trace::lumen::refine::STEP;
use crate::trace::lumen::within::holds;
use lumencut_core::error::{Clicked, Error, ErrorKind, Result};
use lumencut_core::math::arc_length::arc_lengths;

/// A line continues an earlier vessel if it starts within this distance of that vessel's end: radii, or mm if larger.
const END_TO_END: f64 = 0.7;
const NEAREST_END: f64 = 1.0;

/// Length (mm) of the part that gives the direction of a line after it has left a vessel.
const LEAVING: f64 = 4.0;

/// A line leaves a vessel at once if it runs inside it for less than this many radii.
const AT_ONCE: f64 = 2.5;

/// Junction of a line with an earlier vessel: point and radius of that vessel, and first point of the line to keep.
struct Junction {
    place: DVec3,
    radius: f64,
    leaves: usize,
}

/// Cuts each vessel where it leaves or enters an earlier one, and joins it to a bit-identical point of the
/// earlier one. Vessels in `beside` count as earlier than all others.
pub(crate) fn joined(beside: &[Centerline], lines: Vec<Traced>) -> Result<Vec<Traced>> {
    let mut whole: Vec<Traced> = Vec::with_capacity(lines.len());
    for (n, line) in lines.into_iter().enumerate() {
        let earlier: Vec<&Centerline> =
            beside.iter().chain(whole.iter().map(|vessel| &vessel.line)).collect();
        let line = joined_at_start(&earlier, line, n)?;
        let line = joined_at_start(&earlier, line.reversed(), n)?.reversed();
        whole.push(line);
    }
    Ok(whole)
}

fn joined_at_start(earlier: &[&Centerline], line: Traced, n: usize) -> Result<Traced> {
    let points = &line.line.points;
    let inside =
        points.iter().take_while(|point| earlier.iter().any(|vessel| holds(vessel, **point))).count();
    if inside + 1 >= points.len() {
        let found = "points whose vessel lies entirely within earlier vessels";
        let error =
            Error::new(ErrorKind::Tracing, format!("points of vessel {n}"), found, "a separate vessel");
        let error = error.mend("remove these points, or click outside the other vessels");
        return Err(error.about(Clicked::Vessel(n)));
    }
    let junction = if inside > 0 {
        Some(left(earlier, &line, inside))
    } else {
        earlier.iter().find_map(|vessel| vessel.continued_at(points[0]))
    };
    Ok(match junction {
        Some(junction) if inside > 0 => line.leaving(&junction),
        Some(junction) => line.drawn_to(&junction),
        None => line,
    })
}

/// Junction of a line that leaves all earlier vessels at point `leaves`. A line that leaves at once joins the
/// vessel point nearest to the click; others join the point nearest to their straight backward extension.
fn left(earlier: &[&Centerline], line: &Traced, leaves: usize) -> Junction {
    let points = &line.line.points;
    let (click, from) = (line.ends[0], points[leaves]);
    let all = || earlier.iter().flat_map(|vessel| (0..vessel.points.len()).map(move |n| (*vessel, n)));
    let best = |miss: &dyn Fn(DVec3) -> f64| {
        let (vessel, n) = all().min_by(|a, b| miss(place_of(*a)).total_cmp(&miss(place_of(*b))))?;
        Some(Junction { place: vessel.points[n], radius: vessel.radius[n], leaves })
    };
    let nearest = |place: DVec3| best(&|point| point.distance(place));
    let radius = nearest(points[leaves - 1]).map_or(0.0, |junction| junction.radius);
    let ahead = points[leaves..].iter().find(|point| point.distance(from) >= LEAVING);
    let back = (from - *ahead.unwrap_or(&points[points.len() - 1])).normalize_or_zero();
    let backwards = |point: DVec3| {
        let along = (point - from).dot(back).clamp(0.0, 3.0 * radius);
        (point - from).distance(back * along)
    };
    let at_once = arc_lengths(&points[..=leaves])[leaves] < AT_ONCE * radius;
    let found = if at_once { nearest(click) } else { best(&backwards) };
    found.unwrap_or(Junction { place: points[0], radius, leaves })
}

fn place_of((vessel, n): (&Centerline, usize)) -> DVec3 {
    vessel.points[n]
}

impl Centerline {
    fn continued_at(&self, start: DVec3) -> Option<Junction> {
        let last = self.points.len() - 1;
        [0, last].into_iter().find_map(|end| {
            let (place, radius) = (self.points[end], self.radius[end]);
            let is_near = place.distance(start) < (END_TO_END * radius).max(NEAREST_END);
            is_near.then_some(Junction { place, radius, leaves: 0 })
        })
    }
}

impl Traced {
    fn reversed(mut self) -> Self {
        self.line = self.line.reversed();
        self.bridged.reverse();
        self.ends.reverse();
        self
    }

    fn leaving(self, junction: &Junction) -> Self {
        let from = junction.leaves;
        let tail = |values: &[f64]| [&values[from..=from], &values[from..]].concat();
        let line = Centerline {
            points: [&[junction.place], &self.line.points[from..]].concat(),
            radius: tail(&self.line.radius),
            confidence: tail(&self.line.confidence),
        };
        let bridged = [&self.bridged[from..=from], &self.bridged[from..]].concat();
        Self { line, bridged, ..self }.in_even_steps()
    }

    /// Moves the start of the line to the end of the earlier vessel; the shift fades out over one radius.
    fn drawn_to(mut self, junction: &Junction) -> Self {
        let points = &mut self.line.points;
        let lengths = arc_lengths(points);
        let across = junction.place - points[0];
        let reach = junction.radius.max(2.0 * across.length()).min(lengths[lengths.len() - 1] / 2.0);
        for (point, length) in points.iter_mut().zip(&lengths) {
            *point += across * (1.0 - length / reach).max(0.0);
        }
        points[0] = junction.place;
        self.in_even_steps()
    }

    fn in_even_steps(self) -> Self {
        let line = self.line.resampled(STEP);
        let bridged =
            line.points.iter().map(|point| self.bridged[nearest_point(&self.line.points, *point)]).collect();
        Self { line, bridged, ..self }
    }
}

//! Vessels between clicks and from a seed, in the study that is open, and the lines that are made of them.

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_io::{write_mrk_json, write_vtp};
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::preview::Sought;
use lumencut_vessels::trace::find::{FindRequest, SMALLEST_RADIUS};
use lumencut_vessels::trace::ways::region::Stopper;
use serde::{Deserialize, Serialize};

use crate::found_vessels::{self, FoundLine};
use crate::study::content::{Listed, NamedTree};
use crate::study::failure::{Failure, Result};
use crate::study::held_volume::no_volume;
use crate::study::line_edits::{cut, join};
use crate::study::lines::{Line, LineContent, ListedLine, NamedLine};
use crate::study::open_study::Study;

/// How long work is watched: asked whether to stop, and how far it is.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Asked again and again.
    pub stop: Stop<'a>,
    /// Told how far the work is.
    pub progress: &'a Progress,
}

/// A ball that no vessel may pass.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Stopper"))]
pub(crate) struct StopperMessage {
    /// Its center.
    pub center: [f64; 3],
    /// Its radius (mm).
    pub radius: f64,
}

/// Vessels that are clicked.
#[derive(Clone, Debug, Default)]
pub(crate) struct TraceRequest {
    /// At least two points for each.
    pub vessels: Vec<Vec<[f64; 3]>>,
    pub(crate) stoppers: Vec<StopperMessage>,
    /// Whether stretches without lumen are bridged, however long.
    pub(crate) bridge: bool,
    /// Lines that exist already and do not change: a traced vessel that meets one of them ends at a point of it.
    pub beside: Vec<usize>,
}

/// A way to where the pointer is.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "PathRequest"))]
pub(crate) struct PathMessage {
    /// The last click.
    from: [f64; 3],
    /// Where the pointer is.
    to: [f64; 3],
    /// What no vessel may pass.
    stoppers: Vec<StopperMessage>,
    /// Whether stretches without lumen are bridged, however long.
    bridge: bool,
}

/// A vessel that was found in the scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HeldLine {
    /// The number of its line.
    pub line: usize,
    /// Why it is doubtful; none where it is not.
    pub(crate) doubt: Option<&'static str>,
}

impl From<&StopperMessage> for Stopper {
    fn from(message: &StopperMessage) -> Self {
        Self { center: DVec3::from_array(message.center), radius: message.radius }
    }
}

impl Study {
    /// The numbers of the lines of vessels that are clicked, in their order. A line that is what it was keeps its number.
    ///
    /// # Errors
    /// `tracing` as [`lumencut_vessels::trace::clicks::tracer::Tracer::trace`], `volume` where none is open, `interrupted`.
    pub(crate) fn trace(&mut self, request: &TraceRequest, watch: Watch) -> Result<Vec<usize>> {
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let beside = request.beside.iter().map(|line| Ok(self.lines.get(*line)?.met()));
        let clicks = Clicks {
            vessels: request.vessels.iter().map(|points| places(points)).collect(),
            stoppers: request.stoppers.iter().map(Stopper::from).collect(),
            bridge: request.bridge,
            beside: beside.collect::<Result<_>>()?,
        };
        if clicks.vessels.is_empty() {
            return Ok(Vec::new());
        }
        let traced = self.tracer.trace(&volume, &clicks, watch.stop, Some(watch.progress))?;
        let before = std::mem::take(&mut self.traced);
        for line in traced.into_iter().map(Line::from) {
            let known = before.iter().find(|known| self.lines.get(**known).is_ok_and(|held| *held == line));
            self.traced.push(known.map_or_else(|| self.lines.add(line), |known| Ok(*known))?);
        }
        Ok(self.traced.clone())
    }

    /// Refuses a place that no vessel can begin at.
    ///
    /// # Errors
    /// `tracing` as [`lumencut_vessels::trace::clicks::tracer::Tracer::check_click`], `volume` where none is open.
    pub(crate) fn check_click(&self, click: [f64; 3]) -> Result<()> {
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        Ok(self.tracer.check_click(&volume, DVec3::from_array(click))?)
    }

    /// The way that a vessel would take to where the pointer is; none where it is not found before `stop` says so.
    ///
    /// # Errors
    /// `volume` where none is open.
    pub(crate) fn path(&mut self, message: &PathMessage, stop: Stop) -> Result<Option<Vec<[f64; 3]>>> {
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let stoppers: Vec<Stopper> = message.stoppers.iter().map(Stopper::from).collect();
        let between = [message.from, message.to].map(DVec3::from_array);
        let sought = Sought { between, stoppers: &stoppers, bridge: message.bridge };
        let way = self.tracer.preview(&volume, &sought, stop);
        Ok(way.map(|points| points.iter().map(|point| point.to_array()).collect()))
    }

    /// The vessels that hang together with the one that a seed lies in, down to the radius of Python; the doubtful ones last.
    ///
    /// # Errors
    /// `tracing` as [`found_vessels::trace_from`], `volume` where none is open, `interrupted`.
    pub(crate) fn trace_from(&mut self, seed: [f64; 3], watch: Watch) -> Result<Vec<HeldLine>> {
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let Watch { stop, progress } = watch;
        let request = FindRequest { smallest_radius: SMALLEST_RADIUS, stop, progress: Some(progress) };
        let tree = found_vessels::trace_from(&volume, DVec3::from_array(seed), &request)?;
        self.held_lines(tree.vessels)
    }

    /// All vessels of the scan, down to the radius of Python, the doubtful ones last; and what is to be told of the scan. Where none
    /// is sure `doubtful` says whether the others are wanted.
    ///
    /// # Errors
    /// `tracing` as [`found_vessels::told`] and [`found_vessels::told_with_doubtful`], `volume` where none is open, `interrupted`.
    pub(crate) fn find_vessels(
        &mut self,
        doubtful: bool,
        watch: Watch,
    ) -> Result<(Vec<HeldLine>, Vec<String>)> {
        let told = if doubtful { found_vessels::told_with_doubtful } else { found_vessels::told };
        let tree = told(self.trees(watch)?, SMALLEST_RADIUS)?;
        Ok((self.held_lines(tree.vessels)?, tree.notes))
    }

    /// The lines of vessels that were found, from now on among those that the study holds.
    fn held_lines(&mut self, found: Vec<FoundLine>) -> Result<Vec<HeldLine>> {
        let hold =
            |found: FoundLine| Ok(HeldLine { line: self.lines.add(found.line.into())?, doubt: found.doubt });
        found.into_iter().map(hold).collect()
    }

    /// The two parts of a line that is cut at an arc length (mm).
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not, and a place that is not between its ends.
    pub(crate) fn cut(&mut self, line: usize, at: f64) -> Result<[usize; 2]> {
        let [first, second] = cut(&*self.lines.get(line)?, at)?;
        Ok([self.lines.add(first)?, self.lines.add(second)?])
    }

    /// One line of two, joined at the ends that are nearest to each other.
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not, one that is joined to itself, and ends that are far apart.
    pub(crate) fn join(&mut self, first: usize, second: usize) -> Result<usize> {
        if first == second {
            let found = "the same line twice";
            let error = Error::new(ErrorKind::VesselTree, "lines to join", found, "two lines");
            return Err(error.into());
        }
        self.lines.add(join(&*self.lines.get(first)?, &*self.lines.get(second)?)?)
    }

    /// The content of a line.
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not.
    pub(crate) fn line(&self, line: usize) -> Result<LineContent> {
        Ok(self.lines.get(line)?.content())
    }

    /// Takes over a line.
    ///
    /// # Errors
    /// `vessel tree` for an invalid tree.
    pub(crate) fn add_line(&mut self, content: LineContent) -> Result<usize> {
        self.lines.add(content.into())
    }

    /// Shows the lines of a list that are not hidden as the tree, in this order; none shows the volume alone. They are measured among
    /// all of the list. Windows stay as they were, unless the lumen of what is shown is white in them.
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not; what was shown stays then.
    pub(crate) fn show(&mut self, listed: &[ListedLine]) -> Result<()> {
        let vessels = listed.iter().map(|one| self.lines.get(one.line)?.vessel());
        let vessels = vessels.collect::<Result<Vec<_>>>()?;
        let shown: Vec<_> = listed.iter().zip(&vessels).filter(|(one, _)| !one.hidden).collect();
        let named = if shown.is_empty() {
            None
        } else {
            let names = shown.iter().map(|(one, _)| one.name.clone()).collect();
            let lines = shown.iter().map(|(one, _)| one.line).collect();
            let tree = VesselTree::new(shown.iter().map(|(_, vessel)| (*vessel).clone()).collect())?;
            let all = Listed { lines: listed.iter().map(|one| one.line).collect(), vessels };
            Some(NamedTree::new(tree, names, lines).among(all))
        };
        self.laid = None;
        self.reformed = None;
        self.content.named = named;
        self.content.hold_lumen()
    }

    /// The bytes of a centerline file of these lines: `vtp` or `mrk.json`.
    ///
    /// # Errors
    /// `format` for another kind and for no lines, `vessel tree` for a line that there is not.
    pub(crate) fn write(&self, lines: &[NamedLine], kind: &str) -> Result<Vec<u8>> {
        let write = match kind {
            "vtp" => write_vtp,
            "mrk.json" => write_mrk_json,
            other => return Err(Failure::of_message("format", &other, "vtp or mrk.json")),
        };
        let in_file = lines.iter().map(|named| Ok(self.lines.get(named.line)?.in_file(&named.name)));
        Ok(write(&in_file.collect::<Result<Vec<_>>>()?)?)
    }

    /// Puts the vessels of a tree into the table of lines, and shows them.
    ///
    /// # Errors
    /// `vessel tree` for an invalid tree.
    pub(crate) fn show_tree(&mut self, tree: VesselTree, names: Vec<String>) -> Result<()> {
        let lines = tree.vessels().iter().map(|vessel| self.lines.add(vessel.into()));
        let lines = lines.collect::<Result<_>>()?;
        self.laid = None;
        self.reformed = None;
        self.content.named = Some(NamedTree::new(tree, names, lines));
        Ok(())
    }
}

fn places(points: &[[f64; 3]]) -> Vec<DVec3> {
    points.iter().copied().map(DVec3::from_array).collect()
}

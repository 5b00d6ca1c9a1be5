//! Traces vessels between clicks and from a seed in the open study, and keeps their lines.

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::polarity::Polarity;
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_io::{write_mrk_json, write_vtp};
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::doubts::Doubt;
use lumencut_vessels::trace::clicks::preview::Sought;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::find::FindRequest;
use lumencut_vessels::trace::ways::region::Stopper;
use serde::{Deserialize, Serialize};

use crate::found_vessels::{self, FoundLine};
use crate::study::content::{Listed, NamedTree};
use crate::study::failure::{Failure, Result};
use crate::study::line_edits::{cut, join};
use crate::study::lines::{Line, LineContent, ListedLine, NamedLine};
use crate::study::open_study::Study;
use crate::study::outlines::drawn_outlines;
use crate::study::profiles::ByHand;

/// Controls long work: stops it and receives its progress.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Called during the work to ask whether to stop.
    pub stop: Stop<'a>,
    /// Receives the progress.
    pub progress: &'a Progress,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Stopper"))]
pub(crate) struct StopperMessage {
    pub center: [f64; 3],
    /// Radius of the stopper (mm).
    pub radius: f64,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct TraceRequest {
    /// At least two points each.
    pub vessels: Vec<Vec<[f64; 3]>>,
    pub(crate) stoppers: Vec<StopperMessage>,
    /// Whether to bridge stretches without lumen, however long.
    pub(crate) bridge: bool,
    /// Lines of other vessels; a traced vessel that meets one of them ends at a point of it.
    pub beside: Vec<usize>,
}

#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "PathRequest"))]
pub(crate) struct PathMessage {
    from: [f64; 3],
    to: [f64; 3],
    stoppers: Vec<StopperMessage>,
    /// Whether to bridge stretches without lumen, however long.
    bridge: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HeldLine {
    pub line: usize,
    /// Places from which a confident line is doubtful.
    pub(crate) places: Vec<Doubt>,
    /// Why the line is doubtful; None if it is not.
    pub(crate) doubt: Option<&'static str>,
}

impl From<&StopperMessage> for Stopper {
    fn from(message: &StopperMessage) -> Self {
        Self { center: DVec3::from_array(message.center), radius: message.radius }
    }
}

impl Study {
    /// Chooses whether tracing looks for dark lumens; forgets what was found before.
    pub(crate) fn trace_dark(&mut self, dark: bool) {
        let polarity = if dark { Polarity::Dark } else { Polarity::Bright };
        if self.content.polarity != polarity {
            self.content.polarity = polarity;
            self.tracer = Tracer::default();
            self.trees = None;
            self.traced.clear();
        }
    }

    /// Traces the vessels with clicks and returns their line numbers, in order. An unchanged line keeps its number.
    pub(crate) fn trace(&mut self, request: &TraceRequest, watch: Watch) -> Result<Vec<usize>> {
        let volume = self.content.traced()?;
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

    pub(crate) fn check_click(&self, click: [f64; 3]) -> Result<()> {
        let volume = self.content.traced()?;
        Ok(self.tracer.check_click(&volume, DVec3::from_array(click))?)
    }

    /// The path of a vessel to the pointer; None if it was not found before `stop`.
    pub(crate) fn path(&mut self, message: &PathMessage, stop: Stop) -> Result<Option<Vec<[f64; 3]>>> {
        let volume = self.content.traced()?;
        let stoppers: Vec<Stopper> = message.stoppers.iter().map(Stopper::from).collect();
        let between = [message.from, message.to].map(DVec3::from_array);
        let sought = Sought { between, stoppers: &stoppers, bridge: message.bridge };
        let way = self.tracer.preview(&volume, &sought, stop);
        Ok(way.map(|points| points.iter().map(|point| point.to_array()).collect()))
    }

    /// The vessels connected to the vessel at a seed, down to Python's default radius; doubtful ones last.
    pub(crate) fn trace_from(&mut self, seed: [f64; 3], watch: Watch) -> Result<Vec<HeldLine>> {
        let volume = self.content.traced()?;
        let Watch { stop, progress } = watch;
        let request = FindRequest { smallest_radius: None, stop, progress: Some(progress) };
        let tree = found_vessels::trace_from(&volume, DVec3::from_array(seed), &request)?;
        self.held_lines(tree.vessels)
    }

    /// All vessels of the scan down to Python's default radius, doubtful ones last, and notes. With `doubtful`, a result without a
    /// confident vessel is no error.
    pub(crate) fn find_vessels(
        &mut self,
        doubtful: bool,
        watch: Watch,
    ) -> Result<(Vec<HeldLine>, Vec<String>)> {
        let as_tree =
            if doubtful { found_vessels::tree_with_doubtful } else { found_vessels::confident_tree };
        let trees = self.trees(watch)?.clone();
        let tree = as_tree(&self.content.traced()?, &trees)?;
        Ok((self.held_lines(tree.vessels)?, tree.notes))
    }

    fn held_lines(&mut self, found: Vec<FoundLine>) -> Result<Vec<HeldLine>> {
        let hold = |FoundLine { line, doubt, places, .. }: FoundLine| {
            Ok(HeldLine { line: self.lines.add(line.into())?, places, doubt })
        };
        found.into_iter().map(hold).collect()
    }

    /// The line numbers of the two parts of a line that is cut at an arc length (mm).
    pub(crate) fn cut(&mut self, line: usize, at: f64) -> Result<[usize; 2]> {
        let [first, second] = cut(&*self.lines.get(line)?, at)?;
        Ok([self.lines.add(first)?, self.lines.add(second)?])
    }

    pub(crate) fn join(&mut self, first: usize, second: usize) -> Result<usize> {
        if first == second {
            let found = "the same line twice";
            let error = Error::new(ErrorKind::VesselTree, "lines to join", found, "two lines");
            return Err(error.into());
        }
        self.lines.add(join(&*self.lines.get(first)?, &*self.lines.get(second)?)?)
    }

    pub(crate) fn line(&self, line: usize) -> Result<LineContent> {
        Ok(self.lines.get(line)?.content())
    }

    pub(crate) fn add_line(&mut self, content: LineContent) -> Result<usize> {
        self.lines.add(content.into())
    }

    /// Shows the lines of a list that are not hidden, in order; only the volume if the list is empty. All listed lines are measured
    /// together. Windows change only if the shown lumen would be white. After an error the view stays.
    pub(crate) fn show(&mut self, listed: &[ListedLine]) -> Result<()> {
        let vessels = listed.iter().map(|one| self.lines.get(one.line)?.vessel());
        let vessels = vessels.collect::<Result<Vec<_>>>()?;
        let mut outlines = Vec::new();
        for (one, vessel) in listed.iter().zip(&vessels) {
            let length = vessel.arc_length().last().copied().unwrap_or(0.0);
            outlines.push(drawn_outlines(&one.contours, length)?);
        }
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
        for (one, outlines) in listed.iter().zip(outlines) {
            let stretches = self.lines.get(one.line)?.stretches_by_hand();
            self.profiles.draw(one.line, ByHand { outlines, stretches });
        }
        self.laid = None;
        self.reformed = None;
        self.content.named = named;
        self.content.hold_lumen()
    }

    /// The bytes of a centerline file: `vtp` or `mrk.json`.
    pub(crate) fn write(&self, lines: &[NamedLine], kind: &str) -> Result<Vec<u8>> {
        let write = match kind {
            "vtp" => write_vtp,
            "mrk.json" => write_mrk_json,
            other => return Err(Failure::of_message("format", &other, "vtp or mrk.json")),
        };
        let in_file = lines.iter().map(|named| Ok(self.lines.get(named.line)?.in_file(&named.name)));
        Ok(write(&in_file.collect::<Result<Vec<_>>>()?)?)
    }

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

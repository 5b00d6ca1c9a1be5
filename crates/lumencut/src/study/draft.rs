//! A document while an edit changes it, with the added vessels, the lost marks and the new clicks.

use crate::defaults::STOPPER_RADIUS;
use crate::study::document::{Document, DocumentVessel, WorldPoint};
use crate::study::edits::Edit;
use crate::study::failure::Failure;
use crate::study::names::{fresh_name, part_name};
use crate::study::tracing::StopperMessage;
use lumencut_vessels::kind::Kind;

const MIN_CLICKS: usize = 2;

#[derive(Clone, Debug, Default)]
pub(crate) struct Draft {
    pub(crate) document: Document,
    /// What is traced, for new names.
    pub(crate) kind: Kind,
    pub(crate) last_id: u32,
    pub(crate) added: Vec<u32>,
    pub(crate) without_marks: Vec<u32>,
    /// The clicks that the edit sets: vessel id and number of the click.
    new_clicks: Vec<(u32, usize)>,
}

impl Draft {
    pub(crate) fn of(document: Document, last_id: u32) -> Self {
        let last_id = document.vessels.iter().map(|vessel| vessel.id).fold(last_id, u32::max);
        Self { document, last_id, ..Self::default() }
    }

    pub(crate) fn add(&mut self, line: usize, name: String) -> &mut DocumentVessel {
        self.last_id += 1;
        self.added.push(self.last_id);
        let color = self.document.next_color().to_owned();
        let vessels = &mut self.document.vessels;
        vessels.push(DocumentVessel { id: self.last_id, line, name, color, ..Default::default() });
        let last = vessels.len() - 1;
        &mut vessels[last]
    }

    /// Adds a vessel. Without a name, it is named after its kind, such as `Mask 2`.
    pub(crate) fn add_named(&mut self, line: usize, name: &str, kind: &str) -> &mut DocumentVessel {
        let name = if name.is_empty() { fresh_name(&self.document.names(), kind) } else { name.to_owned() };
        self.add(line, name)
    }

    pub(crate) fn remove(&mut self, ids: &[u32]) {
        self.without_marks.extend(ids.iter().filter(|id| self.document.position(**id).is_some()));
        self.document.vessels.retain(|vessel| !ids.contains(&vessel.id));
    }

    /// Gives a vessel a line that was not traced between clicks; its clicks and marks are lost.
    pub(crate) fn replace(&mut self, id: u32, line: usize) {
        if let Some(vessel) = self.vessel(id) {
            vessel.take_line(line);
            vessel.clicks = None;
            self.without_marks.push(id);
        }
    }

    pub(crate) fn part(&mut self, id: u32, [first, second]: [usize; 2]) {
        let Some((place, whole)) = self.document.position(id).zip(self.document.vessel(id)) else { return };
        let name = part_name(&self.document.names(), &whole.called());
        self.replace(id, first);
        self.add(second, name);
        self.document.vessels[place + 1..].rotate_right(1);
    }

    pub(crate) fn accept(&mut self, ids: &[u32]) {
        for vessel in self.document.vessels.iter_mut().filter(|vessel| ids.contains(&vessel.id)) {
            vessel.doubt = None;
        }
    }

    /// Vessels traced before keep their lines, but not the clicks, which no longer lie in such lumen.
    pub(crate) fn set_dark(&mut self, dark: bool) {
        if self.document.dark != dark {
            self.document.dark = dark;
            self.document.vessels.iter_mut().for_each(|vessel| vessel.clicks = None);
        }
    }

    pub(crate) fn leave_out(&mut self, ids: &[u32]) {
        let is_doubtful = |id: &&u32| self.document.vessel(**id).is_some_and(|vessel| vessel.doubt.is_some());
        let doubtful: Vec<u32> = ids.iter().filter(is_doubtful).copied().collect();
        self.remove(&doubtful);
    }

    /// Adds a vessel with clicks; it gets its line when it is traced.
    pub(crate) fn begin(&mut self, clicks: &[WorldPoint]) {
        let id = self.add_named(0, "", self.kind.words().name).id;
        self.give_clicks(id, clicks.to_vec());
    }

    pub(crate) fn give_clicks(&mut self, id: u32, clicks: Vec<WorldPoint>) {
        self.new_clicks = (0..clicks.len()).map(|number| (id, number)).collect();
        if let Some(vessel) = self.vessel(id) {
            vessel.clicks = Some(clicks);
        }
    }

    pub(crate) fn insert_click(&mut self, id: u32, before: Option<usize>, point: WorldPoint) {
        let Some(clicks) = self.clicks(id) else { return };
        let number = before.map_or(clicks.len(), |before| before.min(clicks.len()));
        clicks.insert(number, point);
        self.new_clicks.push((id, number));
    }

    pub(crate) fn move_click(&mut self, id: u32, number: usize, point: WorldPoint) {
        if let Some(click) = self.clicks(id).and_then(|clicks| clicks.get_mut(number)) {
            *click = point;
            self.new_clicks.push((id, number));
        }
    }

    /// Removes a click, or the whole vessel if too few clicks would remain. Returns whether a line must be traced.
    pub(crate) fn remove_click(&mut self, id: u32, number: usize) -> bool {
        let Some(clicks) = self.clicks(id).filter(|clicks| number < clicks.len()) else { return false };
        let is_kept = clicks.len() > MIN_CLICKS;
        if is_kept {
            clicks.remove(number);
        } else {
            self.remove(&[id]);
        }
        is_kept
    }

    /// Applies an edit of stoppers; edits of unknown stoppers are ignored.
    pub(crate) fn change_stoppers(&mut self, edit: &Edit) {
        let stoppers = &mut self.document.stoppers;
        match edit {
            Edit::AddStopper { center } => {
                stoppers.push(StopperMessage { center: *center, radius: STOPPER_RADIUS.default });
            }
            Edit::MoveStopper { number, center } => {
                if let Some(stopper) = stoppers.get_mut(*number) {
                    stopper.center = *center;
                }
            }
            Edit::RemoveStopper { number } if *number < stoppers.len() => {
                stoppers.remove(*number);
            }
            _ => {}
        }
    }

    pub(crate) fn clicked(&self) -> impl Iterator<Item = (&DocumentVessel, &Vec<WorldPoint>)> {
        self.document.vessels.iter().filter_map(|vessel| Some((vessel, vessel.clicks.as_ref()?)))
    }

    pub(crate) fn in_names(&self, mut failure: Failure) -> Failure {
        let Some(about) = &failure.more.about else { return failure };
        let vessel = about.vessel.and_then(|number| self.clicked().nth(number));
        failure.subject = match (vessel, about.point) {
            (Some((vessel, _)), None) => format!("points of {}", vessel.called()),
            (Some((vessel, _)), Some(number)) if !self.new_clicks.contains(&(vessel.id, number)) => {
                format!("point {} of {}", number + 1, vessel.called())
            }
            // The viewer shows the message at the new point.
            _ => "this point".to_owned(),
        };
        failure
    }

    fn vessel(&mut self, id: u32) -> Option<&mut DocumentVessel> {
        self.document.vessels.iter_mut().find(|vessel| vessel.id == id)
    }

    fn clicks(&mut self, id: u32) -> Option<&mut Vec<WorldPoint>> {
        self.vessel(id)?.clicks.as_mut()
    }
}

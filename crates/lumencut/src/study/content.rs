//! The one study that is open: a volume, a tree, or both.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use crate::window_presets::{DataWindow, PresetSource, WINDOW_PRESETS};
use glam::{DMat4, DVec3};
use lumencut_core::named::Named;
use lumencut_core::scene::{LeveledTree, Scene};
use lumencut_core::settings::{ContextName, Window};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use serde::Serialize;

use crate::doubted_scan::doubted_size;
use crate::scan_details::ScanDetails;
use crate::study::failure::Result;
use crate::study::held_volume::HeldVolume;
use crate::value_unit::ValueUnit;
use crate::windows;

/// A tree with the names and the lines of its vessels.
#[derive(Debug)]
pub(crate) struct NamedTree {
    /// The tree.
    pub(crate) leveled: Arc<LeveledTree>,
    /// One name for each vessel; empty where it has none.
    pub names: Vec<String>,
    /// The number of the line of each vessel.
    pub lines: Vec<usize>,
    /// Those of the tree and, in their places between them, those that are hidden; none where nothing is hidden.
    with_hidden: Option<Listed>,
}

/// Vessels that are measured among each other, with the numbers of their lines.
#[derive(Debug)]
pub(crate) struct Listed {
    /// One number for each vessel.
    pub lines: Vec<usize>,
    /// In the order of the list.
    pub vessels: Vec<Vessel>,
}

impl NamedTree {
    /// A tree of which nothing is known yet.
    pub(crate) fn new(tree: VesselTree, names: Vec<String>, lines: Vec<usize>) -> Self {
        Self { leveled: Arc::new(LeveledTree::new(tree)), names, lines, with_hidden: None }
    }

    /// The same tree, whose vessels are measured among all of a list.
    pub(crate) fn among(self, listed: Listed) -> Self {
        Self { with_hidden: Some(listed), ..self }
    }

    /// The vessels that tell each other's point spread and branches, and the numbers of their lines: also those that are hidden.
    pub(crate) fn measured_among(&self) -> (&[usize], &[Vessel]) {
        let shown = (&self.lines[..], self.leveled.tree().vessels());
        self.with_hidden.as_ref().map_or(shown, |all| (&all.lines, &all.vessels))
    }
}

/// What is open.
#[derive(Debug, Default)]
pub struct Content {
    /// The volume.
    pub held: Option<HeldVolume>,
    /// The tree.
    pub(crate) named: Option<NamedTree>,
    /// Whether the points of centerlines that were opened may be put in order.
    pub(crate) can_reorder: bool,
    /// The windows of what was opened, once they were asked for.
    windows: OnceLock<Option<Windows>>,
}

/// Level and width of a window, as the page has them.
type LevelWidth = [f64; 2];

/// What is open.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Report {
    /// The volume; none where vessels alone are open.
    pub volume: Option<VolumeReport>,
    /// The vessels that are shown; none where the volume alone is open.
    pub vessels: Option<Vec<VesselReport>>,
    /// The windows that the data suggest; none without a volume.
    pub(crate) windows: Option<Windows>,
    /// Whether points of the centerlines that were read last are in another order, and may be put in order; left out where not.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    #[cfg_attr(test, ts(optional, as = "Option<bool>"))]
    pub(crate) can_reorder: bool,
}

/// The volume that is open.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct VolumeReport {
    /// The number of voxels along (i, j, k).
    pub size: [usize; 3],
    /// World position of a continuous index, row by row.
    #[cfg_attr(test, ts(type = "Array<Array<number>>"))]
    pub world_from_index: [[f64; 4]; 4],
    /// The corners of its outermost voxels.
    #[cfg_attr(test, ts(type = "Array<Vector>"))]
    pub(crate) corners: [[f64; 3]; 8],
    /// The smallest side of a voxel (mm).
    pub(crate) smallest_side: f64,
    /// How the scan was made, in words.
    pub scan: String,
    /// What speaks against its lengths; none where nothing does.
    pub(crate) doubt: Option<String>,
}

/// A vessel that is shown.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct VesselReport {
    /// The number of its line.
    pub line: usize,
    /// Its name; empty where it has none.
    pub name: String,
    /// mm
    pub length: f64,
    /// Whether its radius is known.
    pub(crate) has_radius: bool,
}

/// The windows of what is open.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Windows {
    /// That of cut surface and flat views.
    main: LevelWidth,
    /// Those of the contexts, by their names.
    #[cfg_attr(test, ts(type = "Readonly<Record<string, Pair>>"))]
    contexts: BTreeMap<&'static str, LevelWidth>,
    /// Those that have a name, in the order to show them.
    presets: Vec<NamedWindow>,
    /// Whether the values are Hounsfield units by what they are: the windows for CT hold for them.
    is_hounsfield: bool,
    /// Whether the window for stents shows something: in Hounsfield units, and where values are as bright as metal.
    may_hold_stents: bool,
}

/// A window that has a name, with its numbers for what is open.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
struct NamedWindow {
    /// The name of the preset.
    name: &'static str,
    /// What menus call it.
    words: &'static str,
    /// Level and width.
    window: LevelWidth,
}

impl Content {
    /// What the renderers show.
    ///
    /// # Errors
    /// `volume` for an invalid grid.
    pub fn scene(&self) -> Result<Scene<'_>> {
        let volume = self.held.as_ref().map(HeldVolume::shared).transpose()?;
        Ok(Scene { volume, tree: self.tree().cloned() })
    }

    /// The tree, where one is open.
    pub fn tree(&self) -> Option<&Arc<LeveledTree>> {
        self.named.as_ref().map(|named| &named.leveled)
    }

    /// How the scan was made; nothing is stated where none is open.
    pub fn scan(&self) -> &ScanDetails {
        static NONE: ScanDetails = ScanDetails::NOTHING;
        self.held.as_ref().map_or(&NONE, |held| &held.scan)
    }

    /// Takes the windows from the data anew where the lumen of the vessels that are shown now is white in the main one.
    ///
    /// # Errors
    /// `volume` for an invalid grid.
    pub(crate) fn hold_lumen(&mut self) -> Result<()> {
        let (Some(Some(windows)), Some(held), Some(tree)) = (self.windows.get(), &self.held, self.tree())
        else {
            return Ok(());
        };
        let [level, width] = windows.main;
        if !windows::holds_lumen(Window { level, width }, &held.volume()?, tree.tree()) {
            self.forget_windows();
        }
        Ok(())
    }

    /// Takes the windows from the data anew when they are asked for.
    pub(crate) fn forget_windows(&mut self) {
        self.windows = OnceLock::new();
    }

    /// The windows that the data suggest, as they were when they were first asked for; none without a volume.
    ///
    /// # Errors
    /// `volume` for values beyond all windows.
    pub(crate) fn windows(&self) -> Result<Option<Windows>> {
        if let Some(known) = self.windows.get() {
            return Ok(known.clone());
        }
        let made = self.windows_of_data()?;
        Ok(self.windows.get_or_init(|| made).clone())
    }

    fn windows_of_data(&self) -> Result<Option<Windows>> {
        let Some(held) = &self.held else { return Ok(None) };
        let (volume, tree) = (&held.volume()?, self.tree().map(|tree| tree.tree()));
        let pair = |window: Window| [window.level, window.width];
        // Each is found once, whoever takes it.
        let found = DataWindow::NAMES
            .iter()
            .map(|(name, kind)| Ok((*name, pair(kind.find(volume, tree)?))))
            .collect::<Result<BTreeMap<_, _>>>()?;
        let contexts = ContextName::NAMES
            .iter()
            .map(|(name, context)| (*name, found[DataWindow::of_context(*context, tree.is_some()).name()]));
        let main = match tree {
            Some(tree) => pair(windows::holding_lumen(volume, tree)?),
            None => pair(windows::of_slices(volume)?),
        };
        let presets = WINDOW_PRESETS.map(|preset| {
            let window = match preset.source {
                PresetSource::Fixed(window) => pair(window),
                PresetSource::Data(DataWindow::Auto) => main,
                PresetSource::Data(kind) => found[kind.name()],
            };
            NamedWindow { name: preset.name, words: preset.words, window }
        });
        let [level, width] = found[DataWindow::Auto.name()];
        let unit = ValueUnit::of(volume, Window { level, width });
        Ok(Some(Windows {
            main,
            contexts: contexts.collect(),
            presets: presets.to_vec(),
            is_hounsfield: unit.is_hounsfield,
            may_hold_stents: unit.is_hounsfield || unit.has_metal,
        }))
    }

    /// What a view of all of it must show: the corners of the volume, or the points of the tree.
    pub(crate) fn outline(&self) -> Result<Vec<DVec3>> {
        let points = |named: &NamedTree| {
            named.leveled.tree().vessels().iter().flat_map(|vessel| vessel.points()).copied().collect()
        };
        match (&self.named, &self.held) {
            (Some(named), _) => Ok(points(named)),
            (None, Some(held)) => Ok(held.volume()?.corners().to_vec()),
            (None, None) => Ok(Vec::new()),
        }
    }

    /// What the page must know of it: the volume's size, grid and windows, and the vessels with names and lengths.
    ///
    /// # Errors
    /// As [`Content::windows`].
    pub(crate) fn report(&self) -> Result<Report> {
        let volume = self.held.as_ref().map(VolumeReport::of).transpose()?;
        let vessels = self.named.as_ref().map(VesselReport::of_all);
        Ok(Report { volume, vessels, windows: self.windows()?, can_reorder: self.can_reorder })
    }
}

impl VolumeReport {
    fn of(held: &HeldVolume) -> Result<Self> {
        let volume = held.volume()?;
        Ok(Self {
            size: held.size,
            world_from_index: DMat4::from(held.world_from_index).transpose().to_cols_array_2d(),
            corners: volume.corners().map(|corner| corner.to_array()),
            smallest_side: volume.smallest_side(),
            scan: held.scan.words(),
            doubt: doubted_size(held.size, held.world_from_index),
        })
    }
}

impl VesselReport {
    fn of_all(named: &NamedTree) -> Vec<Self> {
        let vessels = named.leveled.tree().vessels().iter().zip(&named.names).zip(&named.lines);
        let about = |((vessel, name), line): ((&Vessel, &String), &usize)| Self {
            line: *line,
            name: name.clone(),
            length: vessel.arc_length().last().copied().unwrap_or_default(),
            has_radius: vessel.radius().is_some(),
        };
        vessels.map(about).collect()
    }
}

//! What the open study contains: a volume, a tree, or both.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, OnceLock};

use crate::window_presets::{DataWindow, PresetSource, WINDOW_PRESETS};
use glam::{DMat4, DVec3};
use lumencut_core::named::Named;
use lumencut_core::polarity::Polarity;
use lumencut_core::scene::{LeveledTree, Scene};
use lumencut_core::settings::{ContextName, Window};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::Volume;
use lumencut_vessels::kind::Kind;
use serde::Serialize;

use crate::cut_off_values::note_of;
use crate::defaults::pixel_side;
use crate::doubted_scan::doubted_grid;
use crate::populations::VoxelSample;
use crate::scan_details::ScanDetails;
use crate::study::failure::Result;
use crate::study::held_volume::{HeldVolume, no_volume};
use crate::study::known_names::KnownNames;
use crate::study::without_bone::WithoutBone;
use crate::suggested_names::{SuggestedName, suggested_names};
use crate::value_unit::ValueUnit;
use crate::windows;

#[derive(Debug)]
pub(crate) struct NamedTree {
    pub(crate) leveled: Arc<LeveledTree>,
    /// A name for each vessel; may be empty.
    pub names: Vec<String>,
    /// The line number of each vessel.
    pub lines: Vec<usize>,
    /// All vessels in list order, hidden ones included; None if no vessel is hidden.
    with_hidden: Option<Listed>,
}

#[derive(Debug)]
pub(crate) struct Listed {
    pub lines: Vec<usize>,
    pub vessels: Vec<Vessel>,
}

impl NamedTree {
    /// A tree without hidden vessels.
    pub(crate) fn new(tree: VesselTree, names: Vec<String>, lines: Vec<usize>) -> Self {
        Self { leveled: Arc::new(LeveledTree::new(tree)), names, lines, with_hidden: None }
    }

    pub(crate) fn among(self, listed: Listed) -> Self {
        Self { with_hidden: Some(listed), ..self }
    }

    /// The vessels, hidden ones included, from which point spread and branches are determined, with their line numbers.
    pub(crate) fn measured_among(&self) -> (&[usize], &[Vessel]) {
        let shown = (&self.lines[..], self.leveled.tree().vessels());
        self.with_hidden.as_ref().map_or(shown, |all| (&all.lines, &all.vessels))
    }
}

/// The open volume and the open vessel tree.
#[derive(Debug, Default)]
pub struct Content {
    pub held: Option<HeldVolume>,
    /// Whether tracing looks for bright or dark lumens.
    pub(crate) polarity: Polarity,
    pub(crate) named: Option<NamedTree>,
    pub(crate) can_reorder: bool,
    pub(crate) without_bone: WithoutBone,
    pub(crate) known_names: KnownNames,
    windows: OnceLock<Option<Windows>>,
}

type LevelWidth = [f64; 2];

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Report {
    /// None if only vessels are open.
    pub volume: Option<VolumeReport>,
    /// The shown vessels; None if only the volume is open.
    pub vessels: Option<Vec<VesselReport>>,
    /// Suggested windows; none if no volume is open.
    pub(crate) windows: Option<Windows>,
    /// Whether the centerlines opened last seem to be in the wrong order and can be sorted; omitted if not.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    #[cfg_attr(test, ts(optional, as = "Option<bool>"))]
    pub(crate) can_reorder: bool,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct VolumeReport {
    /// Voxels along (i, j, k).
    pub size: [usize; 3],
    /// Affine from voxel indices to world positions (LPS, mm), row by row.
    #[cfg_attr(test, ts(type = "Array<Array<number>>"))]
    pub world_from_index: [[f64; 4]; 4],
    #[cfg_attr(test, ts(type = "Array<Vector>"))]
    pub(crate) corners: [[f64; 3]; 8],
    /// Smallest voxel side (mm).
    pub(crate) smallest_side: f64,
    /// Pixel side of reformations if none is chosen (mm).
    pub(crate) pixel_side: f64,
    /// How the scan was made, in words.
    pub scan: String,
    /// Doubt about its size or axes, which concerns every picture.
    pub(crate) doubt: Option<String>,
    /// Notes for the user, this doubt included.
    pub(crate) notes: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct VesselReport {
    pub line: usize,
    /// Name; may be empty.
    pub name: String,
    pub length: f64,
    pub(crate) has_radius: bool,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Windows {
    main: LevelWidth,
    #[cfg_attr(test, ts(type = "Readonly<Record<string, Pair>>"))]
    contexts: BTreeMap<&'static str, LevelWidth>,
    presets: Vec<NamedWindow>,
    /// Whether the values seem to be Hounsfield units, so that CT windows apply.
    is_hounsfield: bool,
    /// Whether the stent window is useful: the values seem to be Hounsfield units, and some are as bright as metal.
    may_hold_stents: bool,
    /// The note that dark values were cut off, for the report.
    #[serde(skip)]
    cut_off: Option<String>,
}

#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
struct NamedWindow {
    name: &'static str,
    words: &'static str,
    window: LevelWidth,
}

impl Content {
    /// The open volume and vessels as the scene that renderers need. Fails with an error of kind `volume` for an
    /// invalid grid.
    pub fn scene(&self) -> Result<Scene<'_>> {
        let volume = self.held.as_ref().map(HeldVolume::shared).transpose()?;
        let context = self.without_bone.shown().map(HeldVolume::shared).transpose()?;
        Ok(Scene { volume, tree: self.tree().cloned(), context })
    }

    /// The volume around the vessels, as the context shows it.
    pub(crate) fn around(&self) -> Option<&HeldVolume> {
        self.without_bone.shown().or(self.held.as_ref())
    }

    /// The tree, if there is one.
    pub fn tree(&self) -> Option<&Arc<LeveledTree>> {
        self.named.as_ref().map(|named| &named.leveled)
    }

    /// How the scan was made.
    pub fn scan(&self) -> &ScanDetails {
        static NONE: ScanDetails = ScanDetails::NOTHING;
        self.held.as_ref().map_or(&NONE, |held| &held.scan)
    }

    /// Suggested names by the numbers of the lines, hidden ones included.
    pub(crate) fn suggested_names(&self) -> HashMap<usize, SuggestedName> {
        let Some(named) = &self.named else { return HashMap::new() };
        let (lines, vessels) = named.measured_among();
        let tubes: Vec<_> = vessels.iter().map(|vessel| (vessel.points(), vessel.radius())).collect();
        let suggested = self.names_for(&tubes);
        lines.iter().copied().zip(self.known_names.with(lines, suggested)).collect()
    }

    /// The suggested names of tubes; none while dark lumens are traced, because the names are those of vessels.
    pub(crate) fn names_for(&self, tubes: &[(&[DVec3], Option<&[f64]>)]) -> Vec<SuggestedName> {
        if self.polarity == Polarity::Dark {
            return tubes.iter().map(|_| SuggestedName::default()).collect();
        }
        suggested_names(tubes, self.volume().as_ref())
    }

    /// The open volume as it is traced.
    pub(crate) fn traced(&self) -> Result<Volume<'_>> {
        Ok(self.held.as_ref().ok_or_else(no_volume)?.volume()?.with_polarity(self.polarity))
    }

    /// What is traced.
    pub(crate) fn kind(&self) -> Kind {
        let is_ct = self.windows().ok().flatten().is_some_and(|windows| windows.is_hounsfield);
        Kind::of_scan(self.polarity, is_ct)
    }

    /// The open volume, if it is valid.
    pub(crate) fn volume(&self) -> Option<Volume<'_>> {
        self.held.as_ref().and_then(|held| held.volume().ok())
    }

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

    pub(crate) fn forget_windows(&mut self) {
        self.windows = OnceLock::new();
    }

    /// The suggested windows, computed on first use; None if no volume is open.
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
        let sampled = &VoxelSample::at(volume);
        // Different presets use the same windows, so each window is computed once.
        let found = DataWindow::NAMES
            .iter()
            .map(|(name, kind)| Ok((*name, pair(kind.find_in(sampled, volume, tree)?))))
            .collect::<Result<BTreeMap<_, _>>>()?;
        let contexts = ContextName::NAMES
            .iter()
            .map(|(name, context)| (*name, found[DataWindow::of_context(*context, tree.is_some()).name()]));
        let main = match tree {
            Some(tree) => pair(windows::holding_lumen(sampled, volume, tree)?),
            None => pair(windows::of_slices(sampled)?),
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
        let unit = ValueUnit::of(sampled, volume, Window { level, width });
        Ok(Some(Windows {
            main,
            contexts: contexts.collect(),
            presets: presets.to_vec(),
            is_hounsfield: unit.is_hounsfield,
            may_hold_stents: unit.is_hounsfield || unit.has_metal,
            cut_off: note_of(sampled),
        }))
    }

    /// The points that a fitted view must contain: the volume's corners, or the tree's points.
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

    pub(crate) fn report(&self) -> Result<Report> {
        let mut volume = self.held.as_ref().map(VolumeReport::of).transpose()?;
        let vessels = self.named.as_ref().map(VesselReport::of_all);
        let windows = self.windows()?;
        if let (Some(volume), Some(windows)) = (&mut volume, &windows) {
            volume.notes.extend(windows.cut_off.clone());
        }
        Ok(Report { volume, vessels, windows, can_reorder: self.can_reorder })
    }
}

impl VolumeReport {
    fn of(held: &HeldVolume) -> Result<Self> {
        let volume = held.volume()?;
        let doubt = doubted_grid(held.size, held.world_from_index);
        Ok(Self {
            size: held.size,
            world_from_index: DMat4::from(held.world_from_index).transpose().to_cols_array_2d(),
            corners: volume.corners().map(|corner| corner.to_array()),
            smallest_side: volume.smallest_side(),
            pixel_side: pixel_side(volume.smallest_side()),
            scan: held.scan.words(),
            notes: doubt.iter().cloned().collect(),
            doubt,
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

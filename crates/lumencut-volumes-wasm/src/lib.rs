//! Reads volume files in a browser through `lumencut_volumes`. Only pages that open such files load this module.
#![cfg(target_arch = "wasm32")]

mod json;

use crate::json::{list, map, object, text};
use lumencut_volumes::{
    Codec, Error, ErrorKind, Fill, Format, Found, Grid, Known, Need, Place, Plan, Step, Stop, Window, open,
};
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

/// Size of the buffer for voxels (bytes).
const PIECE: usize = 1 << 20;

type Thrown<T> = Result<T, JsValue>;

/// A volume file that is opened and read. File names are relative to its folder.
#[wasm_bindgen]
pub struct VolumeFile {
    name: String,
    known: Known,
    plan: Option<Plan>,
    fill: Option<Fill>,
    start: u64,
    input: Vec<u8>,
    output: Vec<u8>,
}

#[wasm_bindgen]
impl VolumeFile {
    /// Begins to open the file with this name.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new(name: &str) -> Self {
        let (name, known) = (name.to_owned(), Known::new());
        Self { name, known, plan: None, fill: None, start: 0, input: Vec::new(), output: Vec::new() }
    }

    /// Adds the size of a file (bytes); undefined if the file is missing.
    pub fn add_size(&mut self, name: &str, size: Option<f64>) {
        self.known.add_size(name, size.map_or(Found::Missing, |size| Found::Size(size as u64)));
    }

    /// Adds bytes of a file, which begin at `start`.
    pub fn add_bytes(&mut self, name: &str, start: f64, bytes: &[u8]) {
        self.known.add_bytes(name, start as u64, bytes);
    }

    /// Reads the header; returns the plan, or what is still needed, as JSON. Fails for a file that cannot be read.
    pub fn open(&mut self) -> Thrown<String> {
        match open(&self.name, &self.known, None) {
            Ok(plan) => {
                let text = plan_text(&plan);
                self.plan = Some(plan);
                Ok(text)
            }
            Err(Stop::Need(need)) => Ok(need_text(&need)),
            Err(Stop::Refused(error)) => Err(thrown(&error)),
            Err(Stop::Unknown) => Err(JsValue::from_str(&format!("no volume file: {}", self.name))),
        }
    }

    /// World (LPS, mm) from index: the upper three rows of the plan's matrix.
    #[must_use]
    pub fn world_from_index(&self) -> Vec<f64> {
        self.plan.iter().flat_map(|plan| plan.grid.world_from_index).flatten().collect()
    }

    /// Begins to read voxels from the file that the plan names; `size` in bytes. With `is_unpacked` from the unpacked
    /// bytes of the gzip stream in it. Fails if `size` is undefined: the file is missing.
    pub fn begin(&mut self, size: Option<f64>, is_unpacked: bool) -> Thrown<()> {
        let mut plan = self.plan.take().ok_or("no plan")?;
        if is_unpacked {
            plan.place = Place { codec: Codec::Raw, start: Some(0), lines: 0, ..plan.place };
        }
        let size = size.ok_or_else(|| thrown(&plan.missing()))?;
        self.fill = Some(Fill::new(plan, size as u64, true));
        Ok(())
    }

    /// Replaces the bytes from which voxels are read; they begin at `start` in the file.
    pub fn read(&mut self, start: f64, bytes: &[u8]) {
        self.start = start as u64;
        self.input.clear();
        self.input.extend_from_slice(bytes);
    }

    /// Continues until `output` holds voxels, bytes are needed, or there is news; returns this as JSON. Fails for a
    /// file that is too short or damaged, and for overlapping segments.
    pub fn step(&mut self) -> Thrown<String> {
        let fill = self.fill.as_mut().ok_or("no plan")?;
        let window = Window { start: self.start, bytes: &self.input };
        let mut filled = 0;
        loop {
            let step = fill.step(window, &mut self.output[filled..]).map_err(|error| thrown(&error))?;
            if let Step::Filled(count) = step {
                filled += count;
                if count > 0 && filled < self.output.len() {
                    continue;
                }
            }
            if let Step::Room { .. } = step {
                self.output.resize(PIECE, 0);
            }
            return Ok(object(&[("filled", filled.to_string()), turn(step)]));
        }
    }

    /// The address, in the memory of this module, of the voxels of the last step.
    #[must_use]
    pub fn output(&self) -> f64 {
        self.output.as_ptr().addr() as f64
    }
}

fn turn(step: Step) -> (&'static str, String) {
    match step {
        Step::Read { start, end } => ("read", list([start, end])),
        Step::Sound { least, .. } => ("least", least.to_string()),
        Step::Checked(count) => ("checked", count.to_string()),
        Step::Room { kind, bytes } => {
            let kind = ("dtype", text(kind.name()));
            ("room", object(&[kind, ("bytes", bytes.to_string())]))
        }
        Step::Filled(_) => ("isDone", "false".into()),
        Step::Done => ("isDone", "true".into()),
    }
}

fn need_text(need: &Need) -> String {
    match need {
        Need::Sizes(names) => object(&[("sizes", list(names.iter().map(|name| text(name))))]),
        Need::Bytes { name, start, end } => object(&[("bytes", text(name)), ("range", list([start, end]))]),
    }
}

fn plan_text(plan: &Plan) -> String {
    let names = plan.label_names.iter().map(|(value, name)| (value.to_string(), text(name)));
    let Grid { size, states_spacing, states_orientation, .. } = &plan.grid;
    let is_packed = matches!(plan.place.codec, Codec::Zlib | Codec::Bzip2);
    // Lines to skip are in the file, so that where the stream begins is not known yet.
    let start = plan.place.start.filter(|_| plan.place.codec == Codec::Zlib && plan.place.lines == 0);
    object(&[
        ("nifti", matches!(plan.format, Format::Nifti1 | Format::Nifti2).to_string()),
        ("packed", is_packed.to_string()),
        ("stream", start.map_or("null".into(), |start| start.to_string())),
        ("size", list(size)),
        ("spacing", states_spacing.to_string()),
        ("orientation", states_orientation.to_string()),
        ("voxels", text(&plan.place.name)),
        ("notes", list(plan.notes.iter().map(|note| text(note)))),
        ("label_names", map(names)),
        ("description", text(&plan.description)),
    ])
}

fn thrown(error: &Error) -> JsValue {
    let kind = if error.kind == ErrorKind::File { "file" } else { "format" };
    JsValue::from_str(&object(&[
        ("kind", text(kind)),
        ("subject", text(&error.subject)),
        ("found", text(&error.found)),
        ("expected", text(&error.expected)),
        ("mend", text(&error.mend)),
    ]))
}

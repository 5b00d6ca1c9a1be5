//! Reads volume files in a browser: passes JSON and bytes to `lumencut_volumes`. It is a separate module, so that
//! pages without such files do not load it.
#![cfg(target_arch = "wasm32")]

mod json;

use lumencut_volumes::{Error, ErrorKind, Fill, Found, Grid, Known, Need, Plan, Step, Stop, Window, open};
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

/// Bytes of voxels that are given at once.
const PIECE: usize = 1 << 20;

type Thrown<T> = Result<T, JsValue>;

/// A volume file that is being opened and read. Names are relative to its folder.
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
    /// Begins to open the file of this name.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new(name: &str) -> Self {
        let (name, known) = (name.to_owned(), Known::new());
        Self { name, known, plan: None, fill: None, start: 0, input: Vec::new(), output: Vec::new() }
    }

    /// Adds the size of a file (bytes), or undefined if there is none.
    pub fn add_size(&mut self, name: &str, size: Option<f64>) {
        self.known.add_size(name, size.map_or(Found::Missing, |size| Found::Size(size as u64)));
    }

    /// Adds bytes of a file, from `start` on.
    pub fn add_bytes(&mut self, name: &str, start: f64, bytes: &[u8]) {
        self.known.add_bytes(name, start as u64, bytes);
    }

    /// Reads the header: the plan as JSON, or what is still needed for it. Fails for a file that cannot be read.
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

    /// World (LPS, mm) from index: the upper three rows of the matrix, of the plan.
    #[must_use]
    pub fn world_from_index(&self) -> Vec<f64> {
        self.plan.iter().flat_map(|plan| plan.grid.world_from_index).flatten().collect()
    }

    /// Begins to fill the volume from the file that the plan names, of this size (bytes); undefined if there is none.
    /// Fails for a missing file.
    pub fn begin(&mut self, size: Option<f64>) -> Thrown<()> {
        let plan = self.plan.take().ok_or("no plan")?;
        let size = size.ok_or_else(|| thrown(&plan.missing()))?;
        self.fill = Some(Fill::new(plan, size as u64, true));
        Ok(())
    }

    /// Replaces the bytes of the file of voxels that are at hand; they begin at `start`.
    pub fn read(&mut self, start: f64, bytes: &[u8]) {
        self.start = start as u64;
        self.input.clear();
        self.input.extend_from_slice(bytes);
    }

    /// Continues until there are voxels to take from `output`, or bytes to read, or something to tell, as JSON. Fails
    /// for a file that is too short or damaged, and for overlapping segments.
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
            return Ok(json::object(&[("filled", filled.to_string()), turn(step)]));
        }
    }

    /// The address of the voxels of the last step, in the memory of this module.
    #[must_use]
    pub fn output(&self) -> f64 {
        self.output.as_ptr().addr() as f64
    }
}

fn turn(step: Step) -> (&'static str, String) {
    match step {
        Step::Read { start, end } => ("read", json::list([start, end])),
        Step::Sound { least, .. } => ("least", least.to_string()),
        Step::Checked(count) => ("checked", count.to_string()),
        Step::Room { kind, bytes } => {
            let kind = ("dtype", json::text(kind.name()));
            ("room", json::object(&[kind, ("bytes", bytes.to_string())]))
        }
        Step::Filled(_) => ("isDone", "false".into()),
        Step::Done => ("isDone", "true".into()),
    }
}

fn need_text(need: &Need) -> String {
    match need {
        Need::Sizes(names) => {
            json::object(&[("sizes", json::list(names.iter().map(|name| json::text(name))))])
        }
        Need::Bytes { name, start, end } => {
            json::object(&[("bytes", json::text(name)), ("range", json::list([start, end]))])
        }
    }
}

fn plan_text(plan: &Plan) -> String {
    let names = plan.label_names.iter().map(|(value, name)| (value.to_string(), json::text(name)));
    let Grid { size, states_spacing, states_orientation, .. } = &plan.grid;
    json::object(&[
        ("size", json::list(size)),
        ("spacing", states_spacing.to_string()),
        ("orientation", states_orientation.to_string()),
        ("voxels", json::text(&plan.place.name)),
        ("notes", json::list(plan.notes.iter().map(|note| json::text(note)))),
        ("label_names", json::map(names)),
        ("description", json::text(&plan.description)),
    ])
}

fn thrown(error: &Error) -> JsValue {
    let kind = if error.kind == ErrorKind::File { "file" } else { "format" };
    JsValue::from_str(&json::object(&[
        ("kind", json::text(kind)),
        ("subject", json::text(&error.subject)),
        ("found", json::text(&error.found)),
        ("expected", json::text(&error.expected)),
        ("mend", json::text(&error.mend)),
    ]))
}

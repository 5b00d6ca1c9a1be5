//! What the page's worker calls to trace and edit centerlines.

use js_sys::{Function, Uint8Array};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::engine::{Answer, Engine, answer, read, told};
use crate::stopping::{LONG, after, heard, watched};
use lumencut::study::view::ViewMessage;

/// How long a way is looked for while the pointer moves (ms).
const PATIENCE: f64 = 40.0;

#[wasm_bindgen]
impl Engine {
    /// The numbers of the lines of vessels that are clicked, as JSON; `listener` gets the share that is done.
    ///
    /// # Errors
    /// `tracing` for clicks in no lumen and where there is none between them, `interrupted` once the page says stop.
    pub fn trace(&mut self, request: &str, listener: Function) -> Answer<String> {
        let request = read("request to trace", request);
        told(request.and_then(|request| watched(listener, |watch| self.study.trace(&request, watch))))
    }

    /// Refuses a place, given as JSON, that no vessel can begin at.
    ///
    /// # Errors
    /// `tracing` for a place outside of the volume, and one whose value alone shows that it is no lumen.
    pub fn check_click(&self, click: &str) -> Answer<()> {
        answer(read("click", click).and_then(|click| self.study.check_click(click)))
    }

    /// Long work can begin again: the page's cancellation has been heard.
    pub fn cancellation_was_heard() {
        heard(LONG);
    }

    /// The way that a vessel would take to the pointer, as JSON; `null` where none is found at once.
    ///
    /// # Errors
    /// `volume` where none is open.
    pub fn path(&mut self, request: &str) -> Answer<String> {
        let stop = after(PATIENCE);
        told(read("request for a path", request).and_then(|request| self.study.path(&request, &stop)))
    }

    /// The brightest place on the ray of a pixel of a view, as JSON.
    ///
    /// # Errors
    /// `tracing` for a ray beside the volume, and those of the view.
    pub fn brightest(&mut self, view: &str, column: f64, row: f64) -> Answer<String> {
        let view = ViewMessage::read(view).and_then(|message| message.view());
        told(view.and_then(|view| self.study.brightest(&view, [column, row])))
    }

    /// The branches that a seed reaches, as JSON; `listener` gets the share that is done.
    ///
    /// # Errors
    /// `tracing` for a seed in no vessel, `interrupted` once the page says stop.
    pub fn trace_from(
        &mut self,
        seed: &str,
        smallest_radius: Option<f64>,
        listener: Function,
    ) -> Answer<String> {
        let traced = read("seed", seed)
            .and_then(|seed| watched(listener, |watch| self.study.trace_from(seed, smallest_radius, watch)));
        told(traced)
    }

    /// Makes room for a mask; `header` is the JSON before its voxels.
    ///
    /// # Errors
    /// `volume` where no scan is open, or there is no memory for the mask.
    pub fn begin_mask(&mut self, header: &str) -> Answer<()> {
        answer(self.study.begin_mask(header))
    }

    /// Takes over bytes of voxels of the mask from `offset` on.
    ///
    /// # Errors
    /// `volume` for more bytes than the header tells of.
    pub fn take_mask_voxels(&mut self, offset: f64, bytes: &Uint8Array) -> Answer<()> {
        let room = self.study.mask_bytes(offset as usize, bytes.length() as usize);
        bytes.copy_to(answer(room)?);
        Ok(())
    }

    /// Forgets the mask that was read.
    pub fn end_mask(&mut self) {
        self.study.end_mask();
    }

    /// The lines of the mask that was read, and notes, as JSON; `listener` gets the share that is done. The mask is forgotten.
    ///
    /// # Errors
    /// `volume` for an invalid mask, or one that lies elsewhere than the volume, `interrupted` once the page says stop.
    pub fn trace_mask(&mut self, listener: Function) -> Answer<String> {
        told(watched(listener, |watch| self.study.trace_mask(watch)))
    }

    /// The numbers of both parts of a line that is cut at an arc length (mm), as JSON.
    ///
    /// # Errors
    /// `vessel tree` for a place that is not between its ends.
    pub fn cut(&mut self, line: usize, at: f64) -> Answer<String> {
        told(self.study.cut(line, at))
    }

    /// The number of the line that two are joined to.
    ///
    /// # Errors
    /// `vessel tree` for ends that are far apart.
    pub fn join(&mut self, first: usize, second: usize) -> Answer<usize> {
        answer(self.study.join(first, second))
    }

    /// The content of a line, as JSON.
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not.
    pub fn line(&self, line: usize) -> Answer<String> {
        told(self.study.line(line))
    }

    /// Takes over a line, given as JSON; gives its number.
    ///
    /// # Errors
    /// `vessel tree` for what is no line.
    pub fn add_line(&mut self, content: &str) -> Answer<usize> {
        answer(read("line", content).and_then(|content| self.study.add_line(content)))
    }

    /// Shows these lines, given as JSON, as the tree.
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not.
    pub fn show(&mut self, lines: &str) -> Answer<()> {
        answer(read::<Vec<_>>("lines to show", lines).and_then(|lines| self.study.show(&lines)))
    }

    /// The bytes of a centerline file of these lines, given as JSON.
    ///
    /// # Errors
    /// `format` for another kind than `vtp` and `mrk.json`, and for no lines.
    pub fn write_lines(&self, lines: &str, kind: &str) -> Answer<Uint8Array> {
        let bytes = read::<Vec<_>>("lines to write", lines).and_then(|lines| self.study.write(&lines, kind));
        Ok(Uint8Array::new_from_slice(&answer(bytes)?))
    }
}

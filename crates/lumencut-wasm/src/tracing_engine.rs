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
    /// The document that the study begins with, as JSON.
    ///
    /// # Errors
    /// None beside those of JSON.
    pub fn begin_document(&mut self) -> Answer<String> {
        told(Ok(self.study.begin_document()))
    }

    /// What comes of an edit of a document, as JSON; `listener` gets the share that is done.
    ///
    /// # Errors
    /// Those of the edit, `interrupted` once the page says stop.
    pub fn edit(&mut self, message: &str, listener: Function) -> Answer<String> {
        let message = read("edit", message);
        told(message.and_then(|message| watched(listener, |watch| self.study.edit(&message, watch))))
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

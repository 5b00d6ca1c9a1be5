//! What the page's worker calls to save a session and to go on with it.

use js_sys::Uint8Array;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::engine::{Answer, Engine, answer, read, told};

#[wasm_bindgen]
impl Engine {
    /// The bytes of a session file of this content, given as JSON.
    ///
    /// # Errors
    /// `format` for parts that do not go together, `vessel tree` for a line that there is not.
    pub fn write_session(&self, content: &str) -> Answer<Uint8Array> {
        let content = read("session", content);
        let bytes = content.and_then(|content| self.study.write_session(content));
        Ok(Uint8Array::new_from_slice(&answer(bytes)?))
    }

    /// The content of a session file of the scan that is open, as JSON; its lines are held, and nothing is shown yet.
    ///
    /// # Errors
    /// `session` for a session of another scan, `format` for an invalid file.
    pub fn read_session(&mut self, bytes: &[u8], name: &str) -> Answer<String> {
        told(self.study.read_session(bytes, name))
    }
}

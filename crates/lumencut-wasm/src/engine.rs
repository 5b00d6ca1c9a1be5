//! The interface for the page's worker: questions by name, devices, voxels, and the 3D view. A GPU draws the view on the canvas;
//! the CPU returns it as bytes.

use js_sys::{Array, Date, Function, Promise, Uint8Array, Uint8ClampedArray};
use lumencut::backend::{Backend, Drawn};
use lumencut::camera::Camera;
use lumencut::devices::Wanted;
use lumencut::pipeline::Request;
use lumencut::screen::Screen;
use lumencut::stages::steady::Before;
use lumencut::stages::{Image, ImageSet};
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};
use wasm_bindgen_futures::future_to_promise;
use web_sys::OffscreenCanvas;

use crate::{phantoms, stopping};
use lumencut::study::asking::{Answer, Asking};
use lumencut::study::failure::{Failure, Result};
use lumencut::study::open_study::Study;
use lumencut::study::questions::ask_at_once;
use lumencut::study::view::{View, ViewMessage};

/// The device and the open study. The methods throw errors as JSON.
#[wasm_bindgen]
pub struct Engine {
    backend: Backend,
    screen: Option<Screen>,
    study: Study,
    /// The last view and its depth (mm), if it is to be held while the view turns.
    before: Option<(Camera, Vec<f32>)>,
}

type Thrown<T> = std::result::Result<T, JsValue>;

fn thrown(failure: &Failure) -> JsValue {
    JsValue::from_str(&serde_json::to_string(failure).unwrap_or_else(|error| error.to_string()))
}

fn answer<T>(result: Result<T>) -> Thrown<T> {
    result.map_err(|failure| thrown(&failure))
}

/// Converts an answer to an array: JSON, and bytes or `undefined`.
fn sent(answered: Result<Answer>) -> Thrown<Array> {
    let Answer { json, bytes } = answer(answered)?;
    let bytes = bytes.map_or(JsValue::UNDEFINED, |bytes| clamped(&bytes).into());
    Ok(Array::of(&[json.into(), bytes]))
}

async fn backend(device: &str) -> Thrown<Backend> {
    let wanted = match device {
        "any" => Wanted::with_auto("auto", Some("any")),
        name => Wanted::with_auto(name, None),
    };
    let wanted = answer(wanted.map_err(Failure::from))?;
    let (backend, _) = answer(Backend::new(wanted).await.map_err(Failure::from))?;
    Ok(backend)
}

#[wasm_bindgen]
impl Engine {
    /// An engine without a study on `device`: `gpu`, `cpu`, `auto` (a hardware GPU if available) or `any` (also a
    /// software GPU). Fails with an error of kind `device` if a required GPU cannot be used.
    pub async fn open(device: &str) -> Thrown<Engine> {
        Ok(Self { backend: backend(device).await?, screen: None, study: Study::default(), before: None })
    }

    /// "cpu", or the name of the GPU.
    pub fn device(&self) -> String {
        self.backend.name().to_owned()
    }

    /// Switches the device, or opens a lost one again; the study stays open. A GPU needs a new canvas, since the old one stays
    /// black after the browser's GPU process has failed.
    pub async fn change_device(&mut self, device: &str) -> Thrown<()> {
        self.screen = None;
        self.backend = backend(device).await?;
        Ok(())
    }

    /// A promise that resolves once the GPU in use is lost.
    pub fn loss(&self) -> Promise {
        let loss = self.backend.loss();
        future_to_promise(async move {
            loss.await;
            Ok(JsValue::UNDEFINED)
        })
    }

    /// Lets a GPU draw the 3D view on this canvas.
    pub fn draw_on(&mut self, canvas: OffscreenCanvas) -> Thrown<()> {
        self.screen = Some(answer(Screen::new(canvas).map_err(Failure::from))?);
        Ok(())
    }

    /// Address of the stop byte in the module's memory: the flag 1 stops views, 2 stops tracing and measuring.
    pub fn stop_address() -> usize {
        stopping::address()
    }

    /// Clears the stop bit of tracing and measuring, so that long work can start again.
    pub fn cancellation_was_heard() {
        stopping::heard(stopping::LONG);
    }

    /// Answers a question of `lumencut::study::questions` with JSON, and bytes or `undefined`. `bytes` is an input file, if any.
    /// `listener` receives the fraction of the work that is done. Throws `interrupted` after a stop.
    pub fn ask(
        &mut self,
        name: &str,
        message: &str,
        bytes: &[u8],
        listener: Option<Function>,
    ) -> Thrown<Array> {
        sent(stopping::with_progress(listener, |watch| {
            self.study.ask(name, &Asking { message, bytes, watch, clock: &Date::now })
        }))
    }

    /// As [`Engine::ask`], for questions that need no study. They are answered even while a view is in progress.
    pub fn ask_at_once(name: &str, message: &str) -> Thrown<Array> {
        sent(ask_at_once(name, message))
    }

    /// Allocates memory for a volume with this JSON header. Fails with an error of kind `volume` if there is not
    /// enough memory.
    pub fn begin_volume(&mut self, header: &str) -> Thrown<()> {
        answer(self.study.begin_volume(header))
    }

    /// Writes bytes of voxels from `offset` on. Fails with an error of kind `volume` if the bytes extend beyond the
    /// end of the volume.
    pub fn take_voxels(&mut self, offset: f64, bytes: &Uint8Array) -> Thrown<()> {
        let room = self.study.voxel_bytes(offset as usize, bytes.length() as usize);
        bytes.copy_to(answer(room)?);
        Ok(())
    }

    /// Discards cached results after the voxels have changed.
    pub fn voxels_changed(&mut self) {
        self.study.voxels_changed();
    }

    /// Allocates memory for a mask with this JSON header. Fails with an error of kind `volume` if no scan is open, or
    /// if there is not enough memory.
    pub fn begin_mask(&mut self, header: &str) -> Thrown<()> {
        answer(self.study.begin_mask(header))
    }

    /// Fails if a volume with this header is no mask of the open scan.
    pub fn check_mask(&self, header: &str) -> Thrown<()> {
        answer(self.study.check_mask(header))
    }

    /// Writes bytes of the mask's voxels from `offset` on.
    pub fn take_mask_voxels(&mut self, offset: f64, bytes: &Uint8Array) -> Thrown<()> {
        let room = self.study.mask_bytes(offset as usize, bytes.length() as usize);
        bytes.copy_to(answer(room)?);
        Ok(())
    }

    /// Frees the memory of the mask.
    pub fn end_mask(&mut self) {
        self.study.end_mask();
    }

    /// Opens a phantom. Benchmark phantoms have `scale` times as many voxels along each axis.
    pub fn open_phantom(&mut self, name: &str, scale: f64) -> Thrown<()> {
        answer(phantoms::open(&mut self.study, name, scale))
    }

    /// Renders a view given as JSON. With a GPU it appears on the canvas of [`Engine::draw_on`]; otherwise returns RGBA pixels.
    pub async fn render(&mut self, view: &str) -> Thrown<Option<Uint8ClampedArray>> {
        let view = answer(ViewMessage::read(view).and_then(|message| self.study.view_of(&message)))?;
        answer(self.rendered(&view).await)
    }

    async fn rendered(&mut self, view: &View) -> Result<Option<Uint8ClampedArray>> {
        let View { camera, settings, method, rim } = view;
        let scene = self.study.scene()?;
        let is_held = settings.turning_limit.is_some();
        let images = if is_held { &[Image::Picture, Image::Depth][..] } else { &[Image::Picture] };
        let images = ImageSet::of(images);
        let last = self.before.take().filter(|_| is_held);
        let before = last.as_ref().map(|(camera, depth)| Before { camera, depth });
        stopping::heard(stopping::VIEW);
        let stop = || stopping::is_asked(stopping::VIEW);
        let rim = rim.as_ref();
        let request = Request { images, stop: &stop, rim, before, ..Request::new(camera, settings) };
        let (shown, depth) = match self.backend.draw(*method, &scene, &request, self.screen.as_mut()).await? {
            Drawn::OnScreen(depth) => (None, depth),
            Drawn::Frame(frame) => {
                let depth = frame.depth().to_vec();
                (Some(clamped(&frame.image.into_flattened())), depth)
            }
        };
        self.before = is_held.then_some((*camera, depth));
        Ok(shown)
    }
}

/// Copies bytes, since browsers cannot make pictures from shared memory.
fn clamped(bytes: &[u8]) -> Uint8ClampedArray {
    let copy = Uint8ClampedArray::new_with_length(bytes.len() as u32);
    copy.copy_from(bytes);
    copy
}

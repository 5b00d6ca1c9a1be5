//! What the page's worker calls: questions by their names, and what they do not do: devices, the turning view (on the canvas where
//! a GPU computes, else as bytes), and voxels as they come.

use js_sys::{Array, Date, Function, Promise, Uint8Array, Uint8ClampedArray};
use lumencut::backend::{Backend, Drawn};
use lumencut::devices::Wanted;
use lumencut::pipeline::Request;
use lumencut::screen::Screen;
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

/// What computes, and the study that is open. All methods throw the JSON of an error.
#[wasm_bindgen]
pub struct Engine {
    backend: Backend,
    screen: Option<Screen>,
    study: Study,
}

/// What the page gets, or catches.
type Thrown<T> = std::result::Result<T, JsValue>;

fn thrown(failure: &Failure) -> JsValue {
    JsValue::from_str(&serde_json::to_string(failure).unwrap_or_else(|error| error.to_string()))
}

/// What succeeded, or what is thrown.
fn answer<T>(result: Result<T>) -> Thrown<T> {
    result.map_err(|failure| thrown(&failure))
}

/// An answer as its JSON, and the bytes beside it; `undefined` where there are none.
fn sent(answered: Result<Answer>) -> Thrown<Array> {
    let Answer { json, bytes } = answer(answered)?;
    let bytes = bytes.map_or(JsValue::UNDEFINED, |bytes| clamped(&bytes).into());
    Ok(Array::of(&[json.into(), bytes]))
}

/// What computes on a device of this name.
async fn backend(device: &str) -> Thrown<Backend> {
    let wanted = match device {
        "any" => Wanted::told("auto", Some("any")),
        name => Wanted::told(name, None),
    };
    let wanted = answer(wanted.map_err(Failure::from))?;
    let (backend, _) = answer(Backend::new(wanted).await.map_err(Failure::from))?;
    Ok(backend)
}

#[wasm_bindgen]
impl Engine {
    /// An engine on `device`: `gpu`, `cpu`, or `auto`, a GPU of hardware where there is one; `any` takes a GPU that is software
    /// too. It holds nothing yet.
    ///
    /// # Errors
    /// `device` where a GPU is asked for and none can be used.
    pub async fn open(device: &str) -> Thrown<Engine> {
        Ok(Self { backend: backend(device).await?, screen: None, study: Study::default() })
    }

    /// "cpu", or the name of the GPU.
    pub fn device(&self) -> String {
        self.backend.name().to_owned()
    }

    /// Computes on another device from now on, or on the same one after it was lost; the study stays open, and a GPU needs
    /// a canvas anew: the one before stays black once the process of the browser that drew on it has failed.
    ///
    /// # Errors
    /// As [`Engine::open`].
    pub async fn change_device(&mut self, device: &str) -> Thrown<()> {
        self.screen = None;
        self.backend = backend(device).await?;
        Ok(())
    }

    /// A promise that is kept once the GPU that computes now is lost.
    pub fn loss(&self) -> Promise {
        let loss = self.backend.loss();
        future_to_promise(async move {
            loss.await;
            Ok(JsValue::UNDEFINED)
        })
    }

    /// From now on a GPU draws the turning view on this canvas.
    ///
    /// # Errors
    /// `device` where the GPU cannot draw on it.
    pub fn draw_on(&mut self, canvas: OffscreenCanvas) -> Thrown<()> {
        self.screen = Some(answer(Screen::new(canvas).map_err(Failure::from))?);
        Ok(())
    }

    /// Where in the memory of the module the byte lies that makes work stop: a view by its bit 1, tracing and measuring by its
    /// bit 2.
    pub fn stop_address() -> usize {
        stopping::address()
    }

    /// Long work can begin again: the page's cancellation has been heard.
    pub fn cancellation_was_heard() {
        stopping::heard(stopping::LONG);
    }

    /// Answers a question of the table `lumencut::study::questions`: JSON, and bytes beside it or `undefined`. `bytes` are those of
    /// a file for questions that take one; `listener` gets the share that is done now and then.
    ///
    /// # Errors
    /// Those of the question, `interrupted` once the page says stop.
    pub fn ask(
        &mut self,
        name: &str,
        message: &str,
        bytes: &[u8],
        listener: Option<Function>,
    ) -> Thrown<Array> {
        sent(stopping::watched(listener, |watch| {
            self.study.ask(name, &Asking { message, bytes, watch, clock: &Date::now })
        }))
    }

    /// Answers a question that asks nothing of the study, so that it need not wait for a view that is drawn; as [`Engine::ask`].
    ///
    /// # Errors
    /// Those of the question.
    pub fn ask_at_once(name: &str, message: &str) -> Thrown<Array> {
        sent(ask_at_once(name, message))
    }

    /// Makes room for a volume; `header` is the JSON before its voxels.
    ///
    /// # Errors
    /// `volume` where there is no memory for it.
    pub fn begin_volume(&mut self, header: &str) -> Thrown<()> {
        answer(self.study.begin_volume(header))
    }

    /// Takes over bytes of voxels from `offset` on.
    ///
    /// # Errors
    /// `volume` for more bytes than the header tells of.
    pub fn take_voxels(&mut self, offset: f64, bytes: &Uint8Array) -> Thrown<()> {
        let room = self.study.voxel_bytes(offset as usize, bytes.length() as usize);
        bytes.copy_to(answer(room)?);
        Ok(())
    }

    /// Tells that voxels came since the picture before.
    pub fn voxels_changed(&mut self) {
        self.study.voxels_changed();
    }

    /// Makes room for a mask; `header` is the JSON before its voxels.
    ///
    /// # Errors
    /// `volume` where no scan is open, or there is no memory for the mask.
    pub fn begin_mask(&mut self, header: &str) -> Thrown<()> {
        answer(self.study.begin_mask(header))
    }

    /// Takes over bytes of voxels of the mask from `offset` on.
    ///
    /// # Errors
    /// `volume` for more bytes than the header tells of.
    pub fn take_mask_voxels(&mut self, offset: f64, bytes: &Uint8Array) -> Thrown<()> {
        let room = self.study.mask_bytes(offset as usize, bytes.length() as usize);
        bytes.copy_to(answer(room)?);
        Ok(())
    }

    /// Forgets the mask that was read.
    pub fn end_mask(&mut self) {
        self.study.end_mask();
    }

    /// Opens a phantom by its name, in `scale` times as many voxels along each axis where it has scales.
    ///
    /// # Errors
    /// `settings` for another name, `volume` where there is no memory for it.
    pub fn open_phantom(&mut self, name: &str, scale: f64) -> Thrown<()> {
        answer(phantoms::open(&mut self.study, name, scale))
    }

    /// Renders a view, given as JSON. On the canvas of [`Engine::draw_on`] where the GPU computes, and then it gives nothing;
    /// else its pixels, RGBA.
    ///
    /// # Errors
    /// Those of view and scene, `interrupted` once the page says stop.
    pub async fn render(&mut self, view: &str) -> Thrown<Option<Uint8ClampedArray>> {
        let view = answer(ViewMessage::read(view).and_then(|message| self.study.view_of(&message)))?;
        answer(self.rendered(&view).await)
    }

    async fn rendered(&mut self, view: &View) -> Result<Option<Uint8ClampedArray>> {
        let View { camera, settings, method } = view;
        let scene = self.study.scene()?;
        let images = ImageSet::of(&[Image::Picture]);
        stopping::heard(stopping::VIEW);
        let stop = || stopping::is_asked(stopping::VIEW);
        let request = Request { images, stop: &stop, ..Request::new(camera, settings) };
        match self.backend.draw(*method, &scene, &request, self.screen.as_mut()).await? {
            Drawn::OnScreen => Ok(None),
            Drawn::Frame(frame) => Ok(Some(clamped(&frame.image.into_flattened()))),
        }
    }
}

/// Bytes as a browser takes them for a picture, which cannot be in shared memory.
fn clamped(bytes: &[u8]) -> Uint8ClampedArray {
    let copy = Uint8ClampedArray::new_with_length(bytes.len() as u32);
    copy.copy_from(bytes);
    copy
}

//! What the page's worker calls, and the turning view: on the canvas where a GPU computes, else as bytes.

use js_sys::{Promise, Uint8Array, Uint8ClampedArray};
use lumencut::backend::{Backend, Drawn};
use lumencut::devices::Wanted;
use lumencut::pipeline::Request;
use lumencut::screen::Screen;
use lumencut::stages::{Image, ImageSet};
use serde::Serialize;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};
use wasm_bindgen_futures::future_to_promise;
use web_sys::OffscreenCanvas;

use crate::{phantoms, stopping};
use lumencut::study::centerline_files::AskedMessage;
use lumencut::study::failure::{Failure, Result};
use lumencut::study::labels::{LaidPicture, PictureLabels};
use lumencut::study::open_study::{Picture, Study};
use lumencut::study::planes::Plane;
use lumencut::study::settings::table_as_json;
use lumencut::study::straightened::CprMessage;
use lumencut::study::view::{View, ViewMessage};

/// What computes, and the study that is open. All methods throw the JSON of an error.
#[wasm_bindgen]
pub struct Engine {
    backend: Backend,
    screen: Option<Screen>,
    pub(crate) study: Study,
}

/// What the page gets, or catches.
pub(crate) type Answer<T> = std::result::Result<T, JsValue>;

fn thrown(failure: &Failure) -> JsValue {
    JsValue::from_str(&serde_json::to_string(failure).unwrap_or_else(|error| error.to_string()))
}

/// What succeeded, or what is thrown.
pub(crate) fn answer<T>(result: Result<T>) -> Answer<T> {
    result.map_err(|failure| thrown(&failure))
}

/// What succeeded, as JSON.
pub(crate) fn told<T: Serialize>(result: Result<T>) -> Answer<String> {
    let text = result.and_then(|value| {
        serde_json::to_string(&value).map_err(|error| Failure::of_message("answer", &error, "JSON"))
    });
    answer(text)
}

/// A message of the page.
pub(crate) fn read<'a, T: serde::Deserialize<'a>>(what: &str, text: &'a str) -> Result<T> {
    serde_json::from_str(text).map_err(|error| Failure::of_message(what, &error, "JSON"))
}

/// What computes on a device of this name.
async fn backend(device: &str) -> Answer<Backend> {
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
    pub async fn open(device: &str) -> Answer<Engine> {
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
    pub async fn change_device(&mut self, device: &str) -> Answer<()> {
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
    pub fn draw_on(&mut self, canvas: OffscreenCanvas) -> Answer<()> {
        self.screen = Some(answer(Screen::new(canvas).map_err(Failure::from))?);
        Ok(())
    }

    /// Where in the memory of the module the byte lies that makes work stop: a view by its bit 1, tracing and measuring by its
    /// bit 2.
    pub fn stop_address() -> usize {
        stopping::address()
    }

    /// The table of settings as JSON.
    pub fn settings_table() -> String {
        table_as_json().to_string()
    }

    /// The letters at the edges of a picture and its scale bar, as JSON. It asks nothing of the study, so that it need not wait for a
    /// view that is drawn.
    ///
    /// # Errors
    /// `settings` for a text that does not say how the picture lies.
    pub fn picture_labels(picture: &str) -> Answer<String> {
        told(read::<LaidPicture>("picture", picture).map(PictureLabels::from))
    }

    /// Makes room for a volume; `header` is the JSON before its voxels.
    ///
    /// # Errors
    /// `volume` where there is no memory for it.
    pub fn begin_volume(&mut self, header: &str) -> Answer<()> {
        answer(self.study.begin_volume(header))
    }

    /// Takes over bytes of voxels from `offset` on.
    ///
    /// # Errors
    /// `volume` for more bytes than the header tells of.
    pub fn take_voxels(&mut self, offset: f64, bytes: &Uint8Array) -> Answer<()> {
        let room = self.study.voxel_bytes(offset as usize, bytes.length() as usize);
        bytes.copy_to(answer(room)?);
        Ok(())
    }

    /// Tells that voxels came since the picture before.
    pub fn voxels_changed(&mut self) {
        self.study.voxels_changed();
    }

    /// Opens a phantom by its name, in `scale` times as many voxels along each axis where it has scales.
    ///
    /// # Errors
    /// `settings` for another name, `volume` where there is no memory for it.
    pub fn open_phantom(&mut self, name: &str, scale: f64) -> Answer<()> {
        answer(phantoms::open(&mut self.study, name, scale))
    }

    /// Opens centerlines, in the space and unit that are asked for (as JSON); tells what was odd about them, as a list in JSON.
    ///
    /// # Errors
    /// `format` for a file that is damaged or holds none.
    pub fn open_centerlines(&mut self, bytes: &[u8], name: &str, asked: &str) -> Answer<String> {
        let asked = read("space and unit of the centerlines", asked).map(AskedMessage::statement);
        told(asked.and_then(|asked| self.study.open_centerlines(bytes, name, asked)))
    }

    /// Closes the study.
    pub fn close(&mut self) {
        self.study.close();
    }

    /// What is open, as JSON.
    ///
    /// # Errors
    /// `volume` for values beyond all windows.
    pub fn report(&self) -> Answer<String> {
        told(self.study.report())
    }

    /// The camera of a named view that shows all of the study, as JSON.
    ///
    /// # Errors
    /// `camera` where nothing is open.
    pub fn fitted(&self, view: &str, width: usize, height: usize) -> Answer<String> {
        told(self.study.fitted(view, [width, height]))
    }

    /// Renders a view, given as JSON. On the canvas of [`Engine::draw_on`] where the GPU computes, and then it gives nothing;
    /// else its pixels, RGBA.
    ///
    /// # Errors
    /// Those of view and scene, `interrupted` once the page says stop.
    pub async fn render(&mut self, view: &str) -> Answer<Option<Uint8ClampedArray>> {
        let view = answer(ViewMessage::read(view).and_then(|message| message.view()))?;
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

    /// What a pixel of a view shows, as JSON.
    ///
    /// # Errors
    /// Those of the view.
    pub fn pick(&mut self, view: &str, column: f64, row: f64) -> Answer<String> {
        let view = ViewMessage::read(view).and_then(|message| message.view());
        told(view.and_then(|view| self.study.pick(&view, [column, row])))
    }

    /// What lies at a world point, as JSON.
    ///
    /// # Errors
    /// `settings` for a text that is no point.
    pub fn at(&self, point: &str) -> Answer<String> {
        told(read("point", point).map(|point| self.study.at(point)))
    }

    /// How the values of the volume are distributed, as JSON.
    ///
    /// # Errors
    /// `volume` where none is open.
    pub fn histogram(&self, bins: usize) -> Answer<String> {
        told(self.study.histogram(bins))
    }

    /// The pixels of a plane, RGBA, in a window of this level and width.
    ///
    /// # Errors
    /// `volume` where none is open.
    pub fn slice(&self, plane: &str, level: f64, width: f64) -> Answer<Uint8ClampedArray> {
        let plane = answer(read::<Plane>("plane", plane))?;
        Ok(clamped(&answer(self.study.slice(&plane, [level, width]))?.bytes))
    }

    /// The middle and the axes of the section across a vessel, the measured one once there is one, as JSON.
    ///
    /// # Errors
    /// `vessel tree` for a vessel that there is not.
    pub fn across(&self, vessel: usize, at: f64) -> Answer<String> {
        told(self.study.across(vessel, at))
    }

    /// The straightened CPR of a vessel: its size in pixels, and these, RGBA.
    ///
    /// # Errors
    /// `vessel tree` for a vessel that there is not.
    pub fn straightened(&mut self, message: &str, level: f64, width: f64) -> Answer<js_sys::Array> {
        let message = answer(read::<CprMessage>("cpr", message))?;
        let Picture { size, bytes } = answer(self.study.straightened(message, [level, width]))?;
        let size = size.map(|count| JsValue::from_f64(count as f64));
        Ok(js_sys::Array::of(&[size[0].clone(), size[1].clone(), clamped(&bytes).into()]))
    }

    /// What a place in the straightened CPR shows, as JSON.
    ///
    /// # Errors
    /// `settings` where none was shown.
    pub fn pick_straightened(&self, column: f64, row: f64) -> Answer<String> {
        told(self.study.pick_straightened([column, row]))
    }

    /// Column and row of a world point in the straightened CPR, as JSON; null where none is shown.
    ///
    /// # Errors
    /// `settings` for a text that is no point.
    pub fn on_straightened(&self, point: &str) -> Answer<String> {
        told(read("point", point).map(|point| self.study.on_straightened(point)))
    }
}

/// The bytes of a picture as a browser takes them, which cannot be in shared memory.
fn clamped(bytes: &[u8]) -> Uint8ClampedArray {
    let copy = Uint8ClampedArray::new_with_length(bytes.len() as u32);
    copy.copy_from(bytes);
    copy
}

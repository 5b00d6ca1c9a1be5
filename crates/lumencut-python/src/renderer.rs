//! The renderer. While it works, other Python threads can run, and Ctrl-C stops it.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use glam::DVec3;
use lumencut::backend::Backend;
use lumencut::camera::Camera;
use lumencut::devices::Wanted;
use lumencut::error::Error;
use lumencut::feature_aggregation::{Feature, angle_count, feature_aggregation};
use lumencut::frame::{Frame, Timing};
use lumencut::geometry::Geometry;
use lumencut::math::lanes::FAR;
use lumencut::method::Method;
use lumencut::pipeline::{CpuRenderer, Request};
use lumencut::progress::Progress;
use lumencut::reformations::Layout as _;
use lumencut::reformations::cr::CrParameters;
use lumencut::scene::{LeveledTree, Scene, SharedVolume, VolumeKey};
use lumencut::stages::steady::Before;
use lumencut::stages::{Image, ImageSet};
use lumencut::stop::Stop;
use lumencut::volume::Volume;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::along_vessels::ValuesAlong;
use crate::cpr::Cpr;
use crate::errors::{exception, to_python, warn};
use crate::layout::Layout;
use crate::pool;
use crate::settings::Checked;
use crate::tree::{VesselArrays, tree};
use crate::views::CameraArgument;
use crate::volume::VolumeArgument;
use crate::watching::{Reporter, SHARES, interruptible};

/// Renders views of a tree or a volume. Renderers of one volume share the device and the data computed from the volume.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct Renderer {
    backend: Arc<Mutex<Backend>>,
    volume: VolumeKey,
    tree: Option<Arc<LeveledTree>>,
}

#[pymethods]
impl Renderer {
    #[new]
    #[allow(clippy::needless_pass_by_value)]
    fn new(py: Python<'_>, vessels: Option<Vec<VesselArrays<'_>>>, device: &str) -> PyResult<Self> {
        let tree = leveled(vessels)?;
        let wanted = Wanted::named(device).map_err(to_python)?;
        let (backend, given_up) =
            py.detach(|| pollster::block_on(Backend::new(wanted))).map_err(to_python)?;
        say_that_the_cpu_goes_on(py, given_up)?;
        Ok(Self { backend: Arc::new(Mutex::new(backend)), volume: VolumeKey::default(), tree })
    }

    #[allow(clippy::needless_pass_by_value)]
    fn with_tree(&self, vessels: Option<Vec<VesselArrays<'_>>>) -> PyResult<Self> {
        let tree = leveled(vessels)?;
        Ok(Self { backend: Arc::clone(&self.backend), volume: self.volume.clone(), tree })
    }

    /// The same tree on the same device, for another volume.
    fn with_other_volume(&self) -> Self {
        let Self { backend, tree, .. } = self;
        Self { backend: Arc::clone(backend), volume: VolumeKey::default(), tree: tree.clone() }
    }

    #[getter]
    fn device(&self, py: Python<'_>) -> String {
        py.detach(|| self.backend.lock().unwrap_or_else(PoisonError::into_inner).name().to_owned())
    }

    /// Details of a cut surface, computed on the CPU: the strengths of silhouettes and far rim, and the arc length (mm) between the two positions
    /// that each pixel blends; infinite between two vessels.
    #[pyo3(signature = (camera, settings, before=None))]
    #[allow(clippy::needless_pass_by_value)]
    fn details<'py>(
        &self,
        py: Python<'py>,
        camera: CameraArgument,
        settings: &Bound<'py, Checked>,
        before: Option<BeforeArgument<'py>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (camera, Checked(settings)) = (camera.camera()?, settings.get());
        let seen = before.as_ref().map(BeforeArgument::view).transpose()?;
        let before = seen.as_ref().map(|(camera, depth)| Before { camera, depth });
        let all = PyDict::new(py);
        let Some(tree) = &self.tree else { return Ok(all) };
        let details = interruptible(py, None, |stop| {
            let request = Request { stop, before, ..Request::new(&camera, settings) };
            pool::install(|| CpuRenderer::default().details(tree, &request))?.map_err(to_python)
        })?;
        let [width, height] = camera.size();
        let gap =
            details.sheet.iter().map(|sheet| if sheet[3] < FAR { sheet[3].max(0.0) } else { f32::INFINITY });
        let lines = [("strength", details.strength), ("rim", details.rim)];
        let lines = lines.into_iter().filter(|(_, numbers)| settings.silhouettes && !numbers.is_empty());
        for (name, numbers) in [("sheet_gap", gap.collect())].into_iter().chain(lines) {
            all.set_item(name, PyArray1::from_vec(py, numbers).reshape([height, width])?)?;
        }
        Ok(all)
    }

    /// The silhouette strength of a reformation, computed on the CPU.
    #[allow(clippy::needless_pass_by_value)]
    fn strength<'py>(
        &self,
        py: Python<'py>,
        camera: CameraArgument,
        settings: &Bound<'py, Checked>,
        method: MethodArgument,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let (camera, Checked(settings), method) = (camera.camera()?, settings.get(), method.method()?);
        let scene = Scene { tree: self.tree.clone(), ..Scene::default() };
        let strength = interruptible(py, None, |stop| {
            let images = ImageSet::ALL.and(ImageSet::of(&[Image::Leap]));
            let request = Request { images, stop, ..Request::new(&camera, settings) };
            let mut cpu = CpuRenderer::default();
            let found = || {
                let frame = method.on_cpu(&mut cpu, &scene, &request)?;
                cpu.strength(&frame, &request)
            };
            pool::install(found)?.map_err(to_python)
        })?;
        let [width, height] = camera.size();
        PyArray1::from_vec(py, strength).reshape([height, width])
    }

    /// The requested images of a view: the cut surface if there are vessels, the picture if there is a volume. `method` defaults to
    /// the cut surface. `along` are the values of a rim. `before` is the view before in a turn. `callback` receives the number of finished parts, of `SHARES` in all, and `SHARES`.
    #[pyo3(signature = (volume, camera, settings, images=None, callback=None, method=None, along=None, before=None))]
    #[allow(clippy::needless_pass_by_value, clippy::too_many_arguments)]
    fn render<'py>(
        &self,
        py: Python<'py>,
        volume: Option<VolumeArgument<'py>>,
        camera: CameraArgument,
        settings: &Bound<'py, Checked>,
        images: Option<Vec<String>>,
        callback: Option<Py<PyAny>>,
        method: Option<MethodArgument>,
        along: Option<&Bound<'py, ValuesAlong>>,
        before: Option<BeforeArgument<'py>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (camera, Checked(settings)) = (camera.camera()?, settings.get());
        let colors = along.map(|along| along.get().0.rim().map_err(to_python)).transpose()?;
        let images = images.map_or(Ok(ImageSet::ALL), |names| image_set(&names))?;
        let method = method.map_or(Ok(Method::CutSurface), |method| method.method())?;
        let borrowed = volume.as_ref().map(VolumeArgument::borrow).transpose()?;
        let seen = before.as_ref().map(BeforeArgument::view).transpose()?;
        let before = seen.as_ref().map(|(camera, depth)| Before { camera, depth });
        let volume = match (&volume, &borrowed) {
            (Some(volume), Some(borrowed)) => {
                Some(SharedVolume::new(volume.volume(borrowed)?, self.volume.clone()))
            }
            _ => None,
        };
        let scene = Scene { volume, tree: self.tree.clone(), context: None };
        let progress = Progress::default();
        let reporter = callback.as_ref().map(|callback| Reporter { progress: &progress, callback });
        let (frame, given_up) = interruptible(py, reporter.as_ref(), |stop| {
            let progress = reporter.as_ref().map(|reporter| reporter.progress);
            let rim = colors.as_ref();
            let request = Request { camera: &camera, settings, images, stop, progress, rim, before };
            // The lock is taken outside the pool. A pool thread that waits for part of this view could start another view, and wait
            // for the lock that it holds itself. After an interrupted rendering, the next one overwrites all that it left.
            let mut locked = self.backend.lock().unwrap_or_else(PoisonError::into_inner);
            let backend = &mut *locked;
            pool::install(|| pollster::block_on(backend.render_by(method, &scene, &request)))?
                .map_err(to_python)
        })?;
        if let Some(reporter) = reporter {
            reporter.report(py, SHARES)?;
        }
        say_that_the_cpu_goes_on(py, given_up)?;
        buffers(py, frame)
    }

    /// The requested images of a volume at the positions of a reformation. Outside the volume the picture is transparent.
    #[allow(clippy::needless_pass_by_value)]
    fn look<'py>(
        &self,
        py: Python<'py>,
        volume: VolumeArgument<'py>,
        layout: &Bound<'py, Layout>,
        settings: &Bound<'py, Checked>,
        images: Vec<String>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (Layout(layout), Checked(settings)) = (layout.get(), settings.get());
        let images = image_set(&images)?;
        let borrowed = volume.borrow()?;
        let volume = SharedVolume::new(volume.volume(&borrowed)?, self.volume.clone());
        // The renderer needs a camera; these images do not depend on it.
        let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [1, 1], 1.0).map_err(to_python)?;
        let (frame, given_up) = interruptible(py, None, |stop| {
            let request = Request { images, stop, ..Request::new(&camera, settings) };
            let mut locked = self.backend.lock().unwrap_or_else(PoisonError::into_inner);
            let backend = &mut *locked;
            let look = || pollster::block_on(backend.look(&volume, || places(&**layout, stop), &request));
            pool::install(look)?.map_err(to_python)
        })?;
        say_that_the_cpu_goes_on(py, given_up)?;
        buffers(py, py.detach(|| frame.transparent_outside()))
    }

    /// The curvicircular feature aggregation (CFA) of a straightened CPR, shape (H, W), and the number of directions in a half
    /// circle. Only the feature `share` uses a level. Pixel side in mm.
    #[allow(clippy::needless_pass_by_value)]
    fn aggregate<'py>(
        &self,
        py: Python<'py>,
        volume: VolumeArgument<'py>,
        cpr: &Bound<'py, Cpr>,
        settings: &Bound<'py, Checked>,
        feature: (String, Option<f64>),
        pixel_spacing: f64,
    ) -> PyResult<(Bound<'py, PyArray2<f32>>, usize)> {
        let feature = Feature::named(&feature.0, feature.1).map_err(to_python)?;
        let (Cpr(cpr), Checked(settings)) = (cpr.get(), settings.get());
        let borrowed = volume.borrow()?;
        let volume = SharedVolume::new(volume.volume(&borrowed)?, self.volume.clone());
        // The renderer needs a camera; these images do not depend on it.
        let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [1, 1], 1.0).map_err(to_python)?;
        let (value, given_up) = interruptible(py, None, |stop| {
            let images = ImageSet::of(&[Image::Value]);
            let request = Request { images, stop, ..Request::new(&camera, settings) };
            let mut locked = self.backend.lock().unwrap_or_else(PoisonError::into_inner);
            let backend = &mut *locked;
            let mut given_up = None;
            let look = |turned: &lumencut::reformations::cpr::Cpr| {
                let (frame, error) =
                    pollster::block_on(backend.look(&volume, || places(turned, stop), &request))?;
                given_up = given_up.take().or(error);
                Ok(frame.value)
            };
            let value = pool::install(|| feature_aggregation(cpr, pixel_spacing, feature, look))?;
            Ok((value.map_err(to_python)?, given_up))
        })?;
        say_that_the_cpu_goes_on(py, given_up)?;
        let [width, height] = cpr.size();
        let value = PyArray1::from_vec(py, value).reshape([height, width])?;
        Ok((value, angle_count(cpr, pixel_spacing)))
    }
}

/// A view before another in a turn: its camera, and the depth of its cut surface (mm).
#[derive(FromPyObject)]
struct BeforeArgument<'py>(CameraArgument, PyReadonlyArray2<'py, f32>);

impl BeforeArgument<'_> {
    fn view(&self) -> PyResult<(Camera, Vec<f32>)> {
        Ok((self.0.camera()?, self.1.as_array().iter().copied().collect()))
    }
}

/// A frame with the positions of a reformation; its timings state how long it took to find them.
fn places(layout: &dyn lumencut::reformations::Layout, stop: Stop<'_>) -> lumencut::error::Result<Frame> {
    let start = Instant::now();
    let mut frame = Frame::of(Geometry::Curved(layout.curved(stop)?));
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    frame.timings.push(Timing { stage: "places", milliseconds });
    Ok(frame)
}

/// A method: ("mpcpr",), or ("cr", radius offset, arc-length threshold) with both numbers in pixels.
#[derive(FromPyObject)]
pub(crate) enum MethodArgument {
    Cr(String, f64, f64),
    Plain((String,)),
}

impl MethodArgument {
    fn method(self) -> PyResult<Method> {
        match self {
            Self::Cr(name, radius_offset, arc_threshold) if name == "cr" => {
                let parameters = CrParameters { radius_offset, arc_threshold };
                parameters.check().map_err(to_python)?;
                Ok(Method::Cr(parameters))
            }
            Self::Plain((name,)) if name == "mpcpr" => Ok(Method::MpCpr),
            Self::Cr(name, ..) | Self::Plain((name,)) => {
                let expected = "('mpcpr',) or ('cr', radius offset, arc-length threshold)";
                Err(exception("SettingsError", "method", &name, expected, ""))
            }
        }
    }
}

impl Renderer {
    pub fn scene<'a>(&self, volume: Volume<'a>) -> Scene<'a> {
        let volume = Some(SharedVolume::new(volume, self.volume.clone()));
        Scene { volume, tree: self.tree.clone(), context: None }
    }
}

fn leveled(vessels: Option<Vec<VesselArrays<'_>>>) -> PyResult<Option<Arc<LeveledTree>>> {
    let tree = vessels.map(|vessels| tree(&vessels)).transpose()?;
    Ok(tree.map(|tree| Arc::new(LeveledTree::new(tree))))
}

fn image_set(names: &[String]) -> PyResult<ImageSet> {
    let images = names.iter().map(|name| Image::of_frame(name));
    images.collect::<lumencut::error::Result<Vec<_>>>().map(|images| ImageSet::of(&images)).map_err(to_python)
}

fn say_that_the_cpu_goes_on(py: Python<'_>, given_up: Option<Error>) -> PyResult<()> {
    given_up.map_or(Ok(()), |error| warn(py, "DeviceWarning", &format!("{error}; the CPU continues")))
}

fn buffers(py: Python<'_>, frame: Frame) -> PyResult<Bound<'_, PyDict>> {
    let [width, height] = frame.size();
    let shape = [height, width];
    let all = PyDict::new(py);
    let depth = match frame.geometry {
        Geometry::Orthographic { depth, .. } => depth,
        Geometry::Curved(_) => Vec::new(),
    };
    // The depth of empty pixels lies beyond every scene.
    let shown = |depth: f32| if depth < FAR { depth } else { f32::NAN };
    let depth = if frame.folded.is_empty() { depth } else { depth.into_iter().map(shown).collect() };
    for (name, numbers) in [("depth", depth), ("distance", frame.distance), ("value", frame.value)] {
        if !numbers.is_empty() {
            all.set_item(name, PyArray1::from_vec(py, numbers).reshape(shape)?)?;
        }
    }
    if !frame.blend.is_empty() {
        let number = |n: usize| frame.blend.iter().map(|blend| blend[n]).collect();
        all.set_item("cost", PyArray1::from_vec(py, number(0)).reshape(shape)?)?;
        all.set_item("level", PyArray1::from_vec(py, number(1)).reshape(shape)?)?;
        let kinds = frame.blend.iter().map(|blend| blend[2] as i32).collect();
        all.set_item("piece", PyArray1::from_vec(py, kinds).reshape(shape)?)?;
    }
    if !frame.vessel.is_empty() {
        all.set_item("vessel", PyArray1::from_vec(py, frame.vessel).reshape(shape)?)?;
    }
    if !frame.folded.is_empty() {
        all.set_item("folded", PyArray1::from_vec(py, frame.folded).reshape(shape)?)?;
    }
    for (name, colors) in [("image", frame.image), ("context", frame.context)] {
        if !colors.is_empty() {
            let bytes = colors.into_flattened();
            all.set_item(name, PyArray1::from_vec(py, bytes).reshape([height, width, 4])?)?;
        }
    }
    let timings = PyDict::new(py);
    for timing in frame.timings {
        timings.set_item(timing.stage, timing.milliseconds)?;
    }
    all.set_item("timings", timings)?;
    Ok(all)
}

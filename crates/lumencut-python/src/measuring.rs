//! Measures vessels while other Python threads can run; Ctrl-C stops it.

use std::slice;
use std::sync::Arc;

use glam::DVec3;
use lumencut::flag_table::{FLAGS, FlagLook};
use lumencut::measure::profile::cross_section::{CrossSection, section_place};
use lumencut::measure::profile::measuring;
use lumencut::measure::profile::radii;
use lumencut::measure::profile::request::MeasureRequest;
use lumencut::measure::profile::request::with_progress as counted;
use lumencut::measure::profile::{self, CONTOUR_POINTS};
use lumencut::measure::stenosis::groups::Territory;
use lumencut::measure::stenosis::suggestions::Spot;
use lumencut::measure::stenosis::{Compared, Method};
use lumencut::measure::uncertainty::Part;
use lumencut::measure_words;
use lumencut::named::Named;
use lumencut::scan_details::ScanDetails;
use lumencut::stop::Stop;
use lumencut::study::view;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::pool;
use crate::stenosis::Stenosis;
use crate::tree::{VesselArrays, vessel as vessel_of};
use crate::tree_findings::TreeFindings;
use crate::tree_findings::wall_request;
use crate::volume::VolumeArgument;
use crate::watching::reporting;

/// Adds to the module: flags (name, bit, word, meaning, colours on paper and screen) and methods with labels.
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let row = |flag: &FlagLook| (flag.name, flag.bit, flag.word, flag.meaning, flag.paper, flag.screen);
    module.add("MEASURING_FLAGS", FLAGS.iter().map(row).collect::<Vec<_>>())?;
    let word = |(name, method): &(&'static str, Method)| (*name, measure_words::of_method(*method));
    module.add("STENOSIS_METHODS", Method::NAMES.iter().map(word).collect::<Vec<_>>())?;
    module.add("STENOSIS_TERRITORIES", Territory::names())?;
    module.add("VIEW_METHODS", view::METHODS.map(|[name, word]| (name, word)).to_vec())
}

/// The lumen of a vessel by arc length, and how the scan was made.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct Profile(pub Arc<profile::Profile>, pub ScanDetails);

/// The profile of a vessel with points (n, 3) and radii (n,), in its tree. `estimates` are earlier tree-wide estimates. Without a
/// tree the point spread is `fwhm` (mm) or estimated from the vessel. `progress` receives the fraction of the work that is done.
#[pyfunction]
#[pyo3(signature = (volume, measured, step, fwhm=None, tree=None, wall=None, estimates=None, progress=None))]
#[allow(clippy::needless_pass_by_value, clippy::too_many_arguments)]
pub(crate) fn measure<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    measured: VesselArrays<'py>,
    step: f64,
    fwhm: Option<f64>,
    tree: Option<Vec<VesselArrays<'py>>>,
    wall: Option<[f64; 2]>,
    estimates: Option<Py<TreeFindings>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Profile> {
    let borrowed = volume.borrow()?;
    let scan = volume.scan();
    let volume = volume.volume(&borrowed)?;
    let others = tree.iter().flatten().map(vessel_of).collect::<PyResult<Vec<_>>>()?;
    let vessel = vessel_of(&measured)?;
    let wall = wall_request(wall);
    let profile = reporting(py, progress.as_ref(), |stop, progress| {
        let measured = |stop: Stop<'_>| {
            let request = MeasureRequest { step, fwhm, wall, tree: &others, stop };
            match &estimates {
                Some(estimates) => {
                    measuring::measure_with(estimates.get().0.clone(), &volume, &vessel, &request)
                }
                None => measuring::measure(&volume, &vessel, &request),
            }
        };
        if let Some(progress) = progress {
            progress.expect_views(1);
        }
        pool::install(|| counted(progress, (slice::from_ref(&vessel), step), stop, measured))?
            .map_err(to_python)
    })?;
    Ok(Profile(Arc::new(profile), scan))
}

#[pymethods]
impl Profile {
    fn numbers<'py>(&self, py: Python<'py>) -> Vec<(&'static str, Bound<'py, PyArray1<f64>>)> {
        let profile = &self.0;
        let array = |values: &[f64]| PyArray1::from_slice(py, values);
        let first = |values: &[[f64; 2]]| PyArray1::from_iter(py, values.iter().map(|both| both[0]));
        let second = |values: &[[f64; 2]]| PyArray1::from_iter(py, values.iter().map(|both| both[1]));
        vec![
            ("arc_length", array(&profile.arc_length)),
            ("diameter_min", array(&profile.diameter_min)),
            ("diameter_max", array(&profile.diameter_max)),
            ("diameter_mean", array(&profile.diameter_mean())),
            ("diameter_equivalent", array(&profile.diameter_equivalent())),
            ("area", array(&profile.area)),
            ("uncertainty", array(&profile.uncertainty)),
            ("inscribed_radius", array(&profile.inscribed_radius)),
            ("wall", first(&profile.wall)),
            ("wall_uncertainty", second(&profile.wall)),
            ("diameter_calcium_excluded", first(&profile.bounds)),
            ("diameter_calcium_included", second(&profile.bounds)),
            ("diameter_at_most", array(&profile.at_most)),
            ("area_own_lumen", first(&profile.area_own_lumen)),
            ("area_own_lumen_uncertainty", second(&profile.area_own_lumen)),
            ("area_other_lumen", first(&profile.area_other_lumen)),
            ("area_other_lumen_uncertainty", second(&profile.area_other_lumen)),
            ("area_both_lumens", first(&profile.area_both_lumens())),
            ("area_both_lumens_uncertainty", second(&profile.area_both_lumens())),
            ("diameter_outer", first(&profile.diameter_outer)),
            ("diameter_outer_uncertainty", second(&profile.diameter_outer)),
        ]
    }

    fn uncertainty_parts<'py>(&self, py: Python<'py>) -> Vec<(&'static str, Bound<'py, PyArray1<f64>>)> {
        let parts = &self.0.uncertainty_parts;
        Part::ALL
            .iter()
            .map(|part| (part.name(), PyArray1::from_iter(py, parts.iter().map(|all| part.of(all).abs()))))
            .collect()
    }

    #[getter]
    fn wall_source(&self) -> String {
        measure_words::of_wall(&self.0.wall_source)
    }

    #[getter]
    fn flags<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        PyArray1::from_slice(py, &self.0.flags)
    }

    /// Whether each section is considered for the largest, narrowest and suggested places, shape (n,).
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_iter(py, (0..self.0.len()).map(|n| self.0.counts(n)))
    }

    /// Index of the section nearest to an arc length (mm); the first of two equally near sections.
    fn nearest(&self, at: f64) -> usize {
        self.0.nearest_section(at)
    }

    /// Lumen centre (mm, LPS), shape (n, 3).
    #[getter]
    fn center<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        points(py, &self.0.center)
    }

    /// Unit vectors along the vessel, shape (n, 3).
    #[getter]
    fn normal<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        points(py, &self.0.normal)
    }

    /// Unit vectors right and down in each section, shape (n, 2, 3).
    #[getter]
    fn axes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let flat = self.0.axes.iter().flatten().flat_map(DVec3::to_array).collect();
        PyArray1::from_vec(py, flat).reshape([self.0.axes.len(), 2, 3])
    }

    /// Wall points (mm, LPS), shape (n, rays, 3); NaN if missing.
    #[getter]
    fn contour<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        contours(py, &self.0.contour)
    }

    /// Points of the outer wall (mm, LPS), shape (n, rays, 3); NaN if not seen.
    #[getter]
    fn outer_contour<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        contours(py, &self.0.outer_contour)
    }

    /// Points of the lumen of the line (mm, LPS), shape (n, rays, 3); NaN if no flap is seen.
    #[getter]
    fn own_lumen<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        contours(py, &self.0.own_lumen)
    }

    /// Points of the lumen behind a flap (mm, LPS), shape (n, rays, 3); NaN if not seen.
    #[getter]
    fn other_lumen<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        contours(py, &self.0.other_lumen)
    }

    /// Whether both lumens of a dissected vessel are seen, or why not, in words.
    #[getter]
    fn flap(&self) -> Vec<&'static str> {
        self.0.flap.iter().map(|one| measure_words::of_flap(*one)).collect()
    }

    /// The longest stretch with a flap, in words.
    fn flap_stretch(&self) -> Option<String> {
        measure_words::of_flap_stretch(&self.0)
    }

    fn lumens_at(&self, n: usize) -> Option<String> {
        Some(measure_words::of_lumens_at(&self.0, n)?.join(", "))
    }

    /// Whether the outside of a thick wall is seen, or why not, in words.
    #[getter]
    fn outer_wall(&self) -> Vec<&'static str> {
        self.0.outer_wall.iter().map(|one| measure_words::of_outer_wall(*one)).collect()
    }

    /// Volume within the outer wall between two arc lengths, and its standard deviation (mm³).
    fn outer_volume(&self, ends: [f64; 2]) -> PyResult<(f64, f64)> {
        self.0.outer_volume(ends).map(|[volume, unsure]| (volume, unsure)).map_err(to_python)
    }

    /// The outer wall of the longest stretch that shows it, in words.
    fn outer_stretch(&self) -> Option<String> {
        self.0.outer_stretch().map(|stretch| measure_words::of_outer_stretch(&stretch))
    }

    fn outer_at(&self, n: usize) -> Option<String> {
        measure_words::of_outer_at(&self.0, n)
    }

    /// Levels of lumen and background, shape (n, 2).
    #[getter]
    fn levels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let flat = self.0.levels.iter().flatten().copied().collect();
        PyArray1::from_vec(py, flat).reshape([self.0.levels.len(), 2])
    }

    /// Whether the lumen is "bright" or "dark" beside its surroundings.
    #[getter]
    fn polarity(&self) -> &'static str {
        self.0.polarity().name()
    }

    /// Noise of a voxel in the volume's unit.
    #[getter]
    fn noise(&self) -> f64 {
        self.0.noise
    }

    /// Grades the stenosis at an arc length (mm). References are arc lengths, original and comparison are diameters (mm).
    #[pyo3(signature = (at, method, reference, original=None, comparison=None))]
    fn stenosis(
        &self,
        at: f64,
        method: &str,
        reference: Vec<f64>,
        original: Option<f64>,
        comparison: Option<f64>,
    ) -> PyResult<Stenosis> {
        let compared = Compared { reference, original, comparison };
        let graded = Method::named("method of the stenosis", method)
            .and_then(|method| self.0.stenosis(at, method, &compared));
        graded.map(Stenosis).map_err(to_python)
    }

    /// The narrowest place: arc length and diameter (mm).
    fn narrowest(&self) -> Option<(f64, f64)> {
        self.0.narrowest().map(pair)
    }

    /// A throat that must be narrower than all measured places: arc length and the limit of its diameter (mm).
    fn throat(&self) -> Option<(f64, f64)> {
        self.0.throat().map(pair)
    }

    /// The largest diameter: arc length and diameter (mm).
    fn widest(&self) -> Option<(f64, f64)> {
        self.0.widest().map(pair)
    }

    /// The largest diameter that is suggested to readers: arc length and diameter (mm).
    fn offered_widest(&self) -> Option<(f64, f64)> {
        self.0.offered_widest().map(pair)
    }

    /// The references suggested before and after an arc length (mm): arc length and diameter of each (mm).
    fn suggested_references(&self, at: f64) -> PyResult<[Option<(f64, f64)>; 2]> {
        let spots = self.0.suggested_references(at).map_err(to_python)?;
        Ok(spots.map(|spot| spot.map(pair)))
    }

    /// Diameter at an arc length, and its standard deviation (mm).
    fn diameter_at(&self, at: f64) -> PyResult<(f64, f64)> {
        self.0.diameter_at(at).map_err(to_python)
    }

    /// The length of a stretch along the vessel, and the straight distance of its ends (mm).
    fn stretch(&self, ends: [f64; 2]) -> PyResult<(f64, f64)> {
        self.0.stretch(ends).map(|stretch| (stretch.length, stretch.straight)).map_err(to_python)
    }

    fn direction(&self, ends: [f64; 2]) -> PyResult<[f64; 3]> {
        self.0.direction(ends).map(|direction| direction.to_array()).map_err(to_python)
    }

    /// Angle between two stretches (radians).
    fn angle_between(&self, first: [f64; 2], second: [f64; 2]) -> PyResult<f64> {
        self.0.angle_between(first, second).map_err(to_python)
    }

    /// LAO and cranial angle (radians) of a C-arm position that shows a stretch without foreshortening.
    #[pyo3(signature = (ends, lao=None))]
    fn c_arm(&self, ends: [f64; 2], lao: Option<f64>) -> PyResult<(f64, f64)> {
        self.0.c_arm(ends, lao).map(|arm| (arm.lao, arm.cranial)).map_err(to_python)
    }

    /// FWHM of the point-spread function (mm), and its source.
    #[getter]
    fn fwhm(&self) -> (f64, String) {
        (self.0.fwhm, measure_words::of_source(&self.0.fwhm_source))
    }
}

/// Values (H, W), positions (H, W, 3), normal and arc length (mm) of a section.
type SectionParts<'py> = (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray3<f64>>, [f64; 3], f64);

/// The section of a vessel with points (n, 3) and radii (n,) at an arc length; with a profile, the measured section nearest to it.
#[pyfunction]
#[pyo3(signature = (volume, measured, at, image, profile=None))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn cross_section<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    measured: VesselArrays<'py>,
    at: f64,
    image: [f64; 2],
    profile: Option<PyRef<'py, Profile>>,
) -> PyResult<SectionParts<'py>> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let vessel = vessel_of(&measured)?;
    let place = section_place(&vessel, at, profile.as_ref().map(|profile| &*profile.0)).map_err(to_python)?;
    let [size, pixel_spacing] = image;
    let section = py.detach(|| CrossSection::new(&volume, place, size, pixel_spacing)).map_err(to_python)?;
    let side = section.pixels;
    let positions: Vec<f64> = section.positions().iter().flat_map(DVec3::to_array).collect();
    let value = PyArray1::from_vec(py, section.value).reshape([side, side])?;
    let positions = PyArray1::from_vec(py, positions).reshape([side, side, 3])?;
    Ok((value, positions, place.normal.to_array(), place.at))
}

type RadiusParts<'py> = (Option<Bound<'py, PyArray1<f64>>>, usize, usize);

/// The measured radii of a tree's vessels with points (n, 3) and radii (n,); `callback` acts as `progress` in [`measure`].
#[pyfunction]
#[pyo3(signature = (volume, vessels, step, fwhm=None, wall=None, callback=None))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn measured_radii<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    vessels: Vec<VesselArrays<'py>>,
    step: f64,
    fwhm: Option<f64>,
    wall: Option<[f64; 2]>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Vec<RadiusParts<'py>>> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let tree = vessels.iter().map(vessel_of).collect::<PyResult<Vec<_>>>()?;
    let found = reporting(py, callback.as_ref(), |stop, progress| {
        let request = MeasureRequest { step, fwhm, wall: wall_request(wall), tree: &tree, stop };
        let radii = || radii::measured_radii(&volume, &request, progress);
        pool::install(radii)?.map_err(to_python)
    })?;
    let parts = found.into_iter().map(|radii| {
        let radius = radii.radius.map(|radius| PyArray1::from_vec(py, radius));
        (radius, radii.measured, radii.kept)
    });
    Ok(parts.collect())
}

fn pair(spot: Spot) -> (f64, f64) {
    (spot.at, spot.diameter)
}

fn points<'py>(py: Python<'py>, points: &[DVec3]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let flat = points.iter().flat_map(DVec3::to_array).collect();
    PyArray1::from_vec(py, flat).reshape([points.len(), 3])
}

/// Contours (mm, LPS), shape (n, rays, 3); NaN if missing.
fn contours<'py>(py: Python<'py>, all: &[Vec<DVec3>]) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let none = [DVec3::NAN].repeat(CONTOUR_POINTS);
    let of = |contour: &Vec<DVec3>| -> Vec<f64> {
        let points = if contour.is_empty() { &none } else { contour };
        points.iter().flat_map(DVec3::to_array).collect()
    };
    PyArray1::from_vec(py, all.iter().flat_map(of).collect()).reshape([all.len(), CONTOUR_POINTS, 3])
}

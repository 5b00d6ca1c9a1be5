//! The table of settings for Python; converts `lumencut.Settings` for the core.

use lumencut::method::refuse_focus;
use lumencut::named::Named;
use lumencut::settings::{Choices, LOOKS, Setting, Settings, Value, table};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::errors::to_python;
use crate::values::value;

#[pyclass(frozen, get_all, name = "Setting", module = "lumencut._lumencut")]
struct Row {
    kind: &'static str,
    optional: bool,
    default: Py<PyAny>,
    range: Option<(f64, f64)>,
    unit: Option<&'static str>,
    choices: Py<PyTuple>,
    open: Option<&'static str>,
    sentence: String,
    details: String,
}

impl Row {
    fn new(py: Python<'_>, setting: &Setting) -> PyResult<Self> {
        Ok(Self {
            kind: setting.kind.name(),
            optional: setting.optional,
            default: plain(py, setting.default())?,
            range: setting.limits.map(|limits| (limits.low, limits.high)),
            unit: setting.limits.map(|limits| limits.unit),
            choices: PyTuple::new(py, setting.choices())?.unbind(),
            open: setting.open,
            sentence: setting.sentence(),
            details: setting.details(),
        })
    }
}

/// A setting's value as a Python object: a focus is two lengths, a slab is thickness and mode; None if unset.
fn plain(py: Python<'_>, default: Value) -> PyResult<Py<PyAny>> {
    match default {
        Value::Flag(flag) => flag.into_py_any(py),
        Value::Number(number) => number.into_py_any(py),
        Value::Count(count) => count.into_py_any(py),
        Value::Color(channels) => PyTuple::new(py, channels)?.into_py_any(py),
        Value::Name(name) => name.into_py_any(py),
        Value::Focus(focus) => (focus.margin, focus.fade).into_py_any(py),
        Value::Vessels(ids) => PyTuple::new(py, ids)?.into_py_any(py),
        Value::Slab(slab) => (slab.thickness, slab.mode.name()).into_py_any(py),
        Value::None | Value::Window(_) | Value::Opacity(_) | Value::Transfer(_) => Ok(py.None()),
    }
}

/// Adds to the module: the table of settings, the values that follow the paper's rules, and the looks (named groups of settings).
pub(crate) fn add_table(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let rows = PyDict::new(module.py());
    for setting in table() {
        rows.set_item(setting.name, Row::new(module.py(), setting)?)?;
    }
    module.add_class::<Row>()?;
    module.add("SETTINGS", rows)?;
    module.add("PAPER", values(module.py(), Settings::paper_values())?)?;
    let looks = PyDict::new(module.py());
    let sentences = PyDict::new(module.py());
    for look in &LOOKS {
        looks.set_item(look.name, values(module.py(), (look.values)())?)?;
        sentences.set_item(look.name, look.sentence)?;
    }
    module.add("LOOKS", looks)?;
    module.add("LOOK_SENTENCES", sentences)
}

fn values<'py>(py: Python<'py>, chosen: Vec<(&'static str, Value)>) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for (name, value) in chosen {
        all.set_item(name, plain(py, value)?)?;
    }
    Ok(all)
}

/// The settings of `lumencut.Settings`. They are checked once; every view reads them.
#[pyclass(frozen, name = "Settings", module = "lumencut._lumencut")]
pub struct Checked(pub Settings);

#[pymethods]
impl Checked {
    #[new]
    fn new(attributes: &Bound<'_, PyAny>) -> PyResult<Self> {
        let mut choices = Choices::default();
        for setting in table() {
            let value = value(setting.kind, &attributes.getattr(setting.name)?)?;
            choices.set(setting.name, value).map_err(to_python)?;
        }
        choices.settings().map(Self).map_err(to_python)
    }

    fn refuse_focus(&self) -> PyResult<()> {
        refuse_focus(&self.0).map_err(to_python)
    }
}

//! Converts Python objects to setting values: numbers, names, windows, opacities, slabs, focuses and transfer functions.

use lumencut::error::Result;
use lumencut::named::Named;
use lumencut::settings::{
    ControlPoint, Focus, Kind, Opacity, Slab, SlabMode, TransferFunction, Value, Window,
};
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::errors::to_python;

pub(crate) fn value(kind: Kind, object: &Bound<'_, PyAny>) -> PyResult<Value> {
    if object.is_none() {
        return Ok(Value::None);
    }
    Ok(match kind {
        Kind::Flag => Value::Flag(object.extract()?),
        Kind::Number => Value::Number(object.extract()?),
        Kind::Count => Value::Count(object.extract()?),
        Kind::Color(_) => Value::Color(object.extract()?),
        Kind::Choice => Value::Name(object.extract()?),
        // A named window that depends on the data is computed as soon as there is a volume.
        Kind::Window if object.is_instance_of::<PyString>() => Value::None,
        Kind::Window => Value::Window(object.extract::<WindowArgument>()?.window()),
        Kind::Opacity => Value::Opacity(object.extract::<OpacityArgument>()?.opacity()),
        Kind::Slab => Value::Slab(object.extract::<SlabArgument>()?.slab().map_err(to_python)?),
        Kind::Focus => Value::Focus(object.extract::<FocusArgument>()?.focus()),
        // Names are replaced by ids as soon as there is a tree; until then they select no vessel.
        Kind::Vessels => Value::Vessels(ids(object)?),
        Kind::Transfer => match object.extract() {
            Ok(name) => Value::Name(name),
            Err(_) => Value::Transfer(object.extract::<TransferArgument>()?.transfer_function()),
        },
    })
}

/// Vessel ids; a name or a negative id becomes [`usize::MAX`].
fn ids(vessels: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
    vessels.try_iter()?.map(|one| Ok(one?.extract().unwrap_or(usize::MAX))).collect()
}

#[derive(FromPyObject)]
struct WindowArgument {
    level: f64,
    width: f64,
}

impl WindowArgument {
    fn window(&self) -> Window {
        Window { level: self.level, width: self.width }
    }
}

#[derive(FromPyObject)]
struct OpacityArgument {
    transparent: f64,
    opaque: f64,
}

impl OpacityArgument {
    fn opacity(&self) -> Opacity {
        Opacity { transparent: self.transparent, opaque: self.opaque }
    }
}

#[derive(FromPyObject)]
struct SlabArgument {
    thickness: f64,
    mode: String,
}

impl SlabArgument {
    fn slab(&self) -> Result<Slab> {
        Ok(Slab { thickness: self.thickness, mode: SlabMode::named("slab mode", &self.mode)? })
    }
}

#[derive(FromPyObject)]
struct FocusArgument {
    margin: f64,
    fade: f64,
}

impl FocusArgument {
    fn focus(&self) -> Focus {
        Focus { margin: self.margin, fade: self.fade }
    }
}

#[derive(FromPyObject)]
struct TransferArgument {
    points: Vec<(f64, [u8; 3], f64)>,
}

impl TransferArgument {
    fn transfer_function(&self) -> TransferFunction {
        let point = |&(intensity, color, opacity)| ControlPoint { intensity, color, opacity };
        TransferFunction { points: self.points.iter().map(point).collect() }
    }
}

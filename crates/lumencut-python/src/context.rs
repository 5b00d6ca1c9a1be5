//! The context and the slab, read from the attributes of `lumencut.Settings`; the names that stand for their modes.

use lumencut::error::{Error, ErrorKind, Result};
use lumencut::math::transfer::{ControlPoint, Preset, TransferFunction};
use lumencut::math::window::Window;
use lumencut::settings::{Context, ContextMode, Slab, SlabMode};
use pyo3::prelude::*;

use crate::arguments::WindowArgument;

/// Contexts by name. That of MIDA is the one whose γ can be chosen.
const CONTEXTS: [(&str, ContextMode); 5] = [
    (MIDA, ContextMode::Blend { gamma: 0.0 }),
    ("dvr", ContextMode::Blend { gamma: -1.0 }),
    (MIP, ContextMode::Blend { gamma: 1.0 }),
    ("minip", ContextMode::Minimum),
    ("average", ContextMode::Average),
];
const MIDA: &str = "mida";
const MIP: &str = "mip";

/// What a slab shows, by name.
const SLAB_MODES: [(&str, SlabMode); 3] =
    [("max", SlabMode::Max), ("mean", SlabMode::Mean), ("min", SlabMode::Min)];

/// Adds the names that settings know to the module.
pub fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("CONTEXTS", CONTEXTS.map(|(name, _)| name))?;
    module.add("PRESETS", Preset::ALL.map(Preset::name))?;
    module.add("SLAB_MODES", SLAB_MODES.map(|(name, _)| name))
}

/// The attributes of `lumencut.Slab`.
#[derive(FromPyObject)]
pub struct SlabArgument {
    thickness: f64,
    mode: String,
}

impl SlabArgument {
    /// The slab of the core.
    pub fn slab(&self) -> Result<Slab> {
        Ok(Slab { thickness: self.thickness, mode: named("slab mode", &self.mode, &SLAB_MODES)? })
    }
}

/// A name, or the attributes of `lumencut.TransferFunction`.
#[derive(FromPyObject)]
enum TransferArgument {
    #[pyo3(transparent)]
    Name(String),
    Points {
        points: Vec<(f64, [u8; 3], f64)>,
    },
}

impl TransferArgument {
    fn transfer_function(&self, window: Window) -> Result<TransferFunction> {
        match self {
            Self::Name(name) => {
                let presets = Preset::ALL.map(|preset| (preset.name(), preset));
                Ok(named("context_transfer", name, &presets)?.transfer_function(window))
            }
            Self::Points { points } => {
                let point = |&(intensity, color, opacity)| ControlPoint { intensity, color, opacity };
                Ok(TransferFunction { points: points.iter().map(point).collect() })
            }
        }
    }
}

/// The attributes of `lumencut.Settings` that make the context.
#[derive(FromPyObject)]
pub struct ContextArgument {
    context: Option<String>,
    context_gamma: f64,
    context_window: Option<WindowArgument>,
    context_transfer: Option<TransferArgument>,
    context_step: Option<f64>,
    context_shading: bool,
    context_preview: bool,
}

impl ContextArgument {
    /// Whether a context is wanted.
    pub fn is_wanted(&self) -> bool {
        self.context.is_some()
    }

    /// The context of the core; a default mode where none is wanted, so that the rest can be checked.
    pub fn context(&self) -> Result<Context> {
        let default = Context::default();
        let window = self.context_window.as_ref().map_or(default.window, WindowArgument::window);
        Ok(Context {
            mode: self.mode(default.mode)?,
            window,
            transfer: self.transfer(window)?,
            step: self.context_step,
            shading: self.context_shading,
            preview: self.context_preview,
        })
    }

    fn mode(&self, default: ContextMode) -> Result<ContextMode> {
        let (name, gamma) = (self.context.as_deref(), self.context_gamma);
        if name == Some(MIDA) {
            return Ok(ContextMode::Blend { gamma });
        }
        if gamma != 0.0 {
            let context = name.map_or("None".to_owned(), |name| format!("'{name}'"));
            let found = format!("{gamma} with the context {context}");
            let expected = format!("0, or the context '{MIDA}', the only one that has a gamma");
            return Err(Error::new(ErrorKind::Settings, "context_gamma", found, expected));
        }
        name.map_or(Ok(default), |name| named("context", name, &CONTEXTS))
    }

    fn transfer(&self, window: Window) -> Result<TransferFunction> {
        match &self.context_transfer {
            Some(transfer) => transfer.transfer_function(window),
            None if self.context.as_deref() == Some(MIP) => Ok(Preset::Grey.transfer_function(window)),
            None => Ok(Preset::Angio.transfer_function(window)),
        }
    }
}

/// The value of this name.
fn named<T: Copy>(subject: &str, name: &str, choices: &[(&str, T)]) -> Result<T> {
    if let Some((_, value)) = choices.iter().find(|(known, _)| *known == name) {
        return Ok(*value);
    }
    let known: Vec<_> = choices.iter().map(|(known, _)| format!("'{known}'")).collect();
    let expected = format!("one of {}", known.join(", "));
    Err(Error::new(ErrorKind::Settings, subject, format!("'{name}'"), expected))
}

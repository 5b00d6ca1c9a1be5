//! Every setting of the method: what it is called, its range, unit and default, and what it does.

mod choices;
mod chosen;
mod context;
mod field;
mod focus;
mod looks;
mod paper;
mod rules;
mod setting;
mod slab;
mod table;
mod transfer;
mod value;
mod window;

pub use choices::Choices;
pub use context::{Context, ContextFrom, ContextMode, ContextName};
pub use focus::Focus;
pub use looks::{LOOKS, Look};
pub use rules::{LevelChoice, SilhouetteRule};
pub use setting::Setting;
pub use slab::{Slab, SlabMode};
pub use table::{ContextChoices, MAX_LEVELS, Settings, table};
pub use transfer::{ControlPoint, MAX_POINTS, Preset, TransferFunction};
pub use value::{Kind, Transfer, Value};
pub use window::{Opacity, Window};

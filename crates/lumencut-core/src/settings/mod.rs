//! Every setting of the method: name, range, unit, default and description.

mod choices;
mod chosen;
mod context;
mod field;
mod focus;
mod looks;
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
pub use rules::{DistanceRule, LevelChoice, RimValue, SilhouetteRule, TreeShown};
pub use setting::Setting;
pub use slab::{Slab, SlabMode};
pub use table::{ContextChoices, MAX_LEVELS, Settings, table};
pub(crate) use transfer::MAX_POINTS;
pub use transfer::{ControlPoint, Preset, TransferFunction};
pub use value::{Kind, Transfer, Value};
pub use window::{Opacity, Window};

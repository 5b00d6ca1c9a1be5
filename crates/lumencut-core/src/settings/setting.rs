//! The description of one setting for interfaces and documents, and the macro that declares settings.

use super::value::{Kind, Value};
use crate::limits::Limits;

/// A row of the table of settings.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// The name in Python; the command line has hyphens instead of underscores.
    pub name: &'static str,
    /// The kind of its value.
    pub kind: Kind,
    /// Whether the setting may have no value.
    pub optional: bool,
    /// The range of a number.
    pub limits: Option<Limits>,
    /// What it means to have no value, for settings that have none by default.
    pub open: Option<&'static str>,
    pub(super) about: &'static str,
    pub(super) choices: fn() -> Vec<&'static str>,
    pub(super) default: fn() -> Value,
}

impl Setting {
    /// What the setting does, in one sentence.
    pub fn sentence(&self) -> String {
        self.paragraphs().next().unwrap_or_default()
    }

    /// Further details, for documents that have room for them.
    pub fn details(&self) -> String {
        self.paragraphs().skip(1).collect::<Vec<_>>().join(" ")
    }

    /// The valid names: those of the setting, or of the slab's mode.
    pub fn choices(&self) -> Vec<&'static str> {
        (self.choices)()
    }

    /// The default value.
    pub fn default(&self) -> Value {
        if self.open.is_some() { Value::None } else { (self.default)() }
    }

    fn paragraphs(&self) -> impl Iterator<Item = String> {
        self.about.split("\n\n").map(|lines| lines.lines().map(str::trim).collect::<Vec<_>>().join(" "))
    }
}

/// Declares settings, one row each: `name: type = default`, range and unit, and meaning of no value. The
/// comment before a row is text for users: the command line shows its first paragraph, documents all of it.
macro_rules! settings {
    (
        $(#[$attribute:meta])*
        pub struct $structure:ident {
            $(
                $(#[doc = $about:literal])+
                $name:ident: $type:ty = $default:expr
                $(, range($low:expr, $high:expr, $unit:literal))?
                $(, open($open:literal))?;
            )+
        }
        $(
            beside them {
                $(#[doc = $beside_about:literal])+
                $beside:ident: $beside_type:ty = $beside_default:expr;
            }
        )?
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $structure {
            $($(#[doc = $about])+ pub $name: $type,)+
            $($(#[doc = $beside_about])+ pub $beside: $beside_type,)?
        }

        impl Default for $structure {
            fn default() -> Self {
                Self { $($name: $default,)+ $($beside: $beside_default,)? }
            }
        }

        impl $structure {
            /// The settings of this structure, in display order.
            pub const ROWS: &'static [Setting] = &[$(
                Setting {
                    name: stringify!($name),
                    kind: <$type as Field>::KIND,
                    optional: <$type as Field>::OPTIONAL,
                    limits: settings!(@limits $($low, $high, $unit)?),
                    open: settings!(@open $($open)?),
                    about: concat!($($about, "\n"),+),
                    choices: <$type as Field>::choices,
                    default: || Field::to_value(&Self::default().$name),
                },
            )+];

            /// The value of each setting of this structure, by its name.
            pub fn values(&self) -> Vec<(&'static str, Value)> {
                vec![$((stringify!($name), Field::to_value(&self.$name)),)+]
            }

            pub(super) fn set(&mut self, name: &str, value: Value) -> Result<()> {
                match name {
                    $(stringify!($name) => self.$name = Field::from_value(name, value)?,)+
                    _ => return Err(unknown(name)),
                }
                Ok(())
            }

            pub(super) fn check_rows(&self) -> Result<()> {
                $(Field::check(&self.$name, stringify!($name), settings!(@limits $($low, $high, $unit)?).as_ref())?;)+
                Ok(())
            }
        }
    };
    (@limits) => { None };
    (@limits $low:expr, $high:expr, $unit:literal) => { Some(Limits::new($low, $high, $unit)) };
    (@open) => { None };
    (@open $open:literal) => { Some($open) };
}

pub(super) use settings;

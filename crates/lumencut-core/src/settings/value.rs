//! The kinds of settings' values, and values as hosts give them.

use super::focus::Focus;
use super::slab::Slab;
use super::transfer::{Preset, TransferFunction};
use super::window::{Opacity, Window};

/// The kind of a setting's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Yes or no.
    Flag,
    /// A number.
    Number,
    /// An integer.
    Count,
    /// A colour with this number of channels, 0 to 255: red, green, blue and, fourth, opacity.
    Color(usize),
    /// One of some names.
    Choice,
    /// A [`Window`].
    Window,
    /// An [`Opacity`].
    Opacity,
    /// A [`Slab`].
    Slab,
    /// A [`Focus`].
    Focus,
    /// Vessels of the tree, by their ids.
    Vessels,
    /// A [`TransferFunction`], or the name of a [`Preset`].
    Transfer,
}

impl Kind {
    /// The word for the kind.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flag => "flag",
            Self::Number => "number",
            Self::Count => "count",
            Self::Color(_) => "color",
            Self::Choice => "choice",
            Self::Window => "window",
            Self::Opacity => "opacity",
            Self::Slab => "slab",
            Self::Focus => "focus",
            Self::Vessels => "vessels",
            Self::Transfer => "transfer",
        }
    }
}

/// The value of a setting.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// No value was chosen.
    None,
    /// Of [`Kind::Flag`].
    Flag(bool),
    /// Of [`Kind::Number`].
    Number(f64),
    /// Of [`Kind::Count`].
    Count(usize),
    /// Of [`Kind::Color`].
    Color(Vec<u8>),
    /// Of [`Kind::Choice`] and [`Kind::Transfer`].
    Name(String),
    /// Of [`Kind::Window`].
    Window(Window),
    /// Of [`Kind::Opacity`].
    Opacity(Opacity),
    /// Of [`Kind::Slab`].
    Slab(Slab),
    /// Of [`Kind::Focus`].
    Focus(Focus),
    /// Of [`Kind::Vessels`].
    Vessels(Vec<usize>),
    /// Of [`Kind::Transfer`].
    Transfer(TransferFunction),
}

/// A transfer function as a host chooses it.
#[derive(Clone, Debug, PartialEq)]
pub enum Transfer {
    /// By name; the function lies within the window of the context.
    Preset(Preset),
    /// By its points.
    Function(TransferFunction),
}

impl Transfer {
    pub(super) fn within(&self, window: Window) -> TransferFunction {
        match self {
            Self::Preset(preset) => preset.transfer_function(window),
            Self::Function(function) => function.clone(),
        }
    }
}

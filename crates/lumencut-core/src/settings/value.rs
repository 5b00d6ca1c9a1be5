//! The kinds of settings' values, and the values as Python, the command line or the page give them.

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
    /// A value of [`Kind::Flag`].
    Flag(bool),
    /// A value of [`Kind::Number`].
    Number(f64),
    /// A value of [`Kind::Count`].
    Count(usize),
    /// A value of [`Kind::Color`].
    Color(Vec<u8>),
    /// A value of [`Kind::Choice`] or [`Kind::Transfer`].
    Name(String),
    /// A value of [`Kind::Window`].
    Window(Window),
    /// A value of [`Kind::Opacity`].
    Opacity(Opacity),
    /// A value of [`Kind::Slab`].
    Slab(Slab),
    /// A value of [`Kind::Focus`].
    Focus(Focus),
    /// A value of [`Kind::Vessels`].
    Vessels(Vec<usize>),
    /// A value of [`Kind::Transfer`].
    Transfer(TransferFunction),
}

/// The choice of a transfer function.
#[derive(Clone, Debug, PartialEq)]
pub enum Transfer {
    /// A named function, placed within the window of the context.
    Preset(Preset),
    /// A function given by its points.
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

//! The types of settings' fields: conversion from and to the values that callers give, and checks.

use super::focus::Focus;
use super::slab::{Slab, SlabMode};
use super::transfer::{Preset, TransferFunction};
use super::value::{Kind, Transfer, Value};
use super::window::{Opacity, Window};
use crate::error::{Error, ErrorKind, Result};
use crate::limits::Limits;
use crate::named::Named;

pub(super) trait Field: Sized {
    const KIND: Kind;
    /// Whether the field may have no value ([`Value::None`]).
    const OPTIONAL: bool = false;

    fn choices() -> Vec<&'static str> {
        Vec::new()
    }

    fn from_value(name: &str, value: Value) -> Result<Self>;

    fn to_value(&self) -> Value;

    fn check(&self, _name: &str, _limits: Option<&Limits>) -> Result<()> {
        Ok(())
    }
}

fn of_another_kind<T: Field>(name: &str, value: &Value) -> Error {
    let expected = format!("a value of the kind {}", T::KIND.name());
    Error::new(ErrorKind::Settings, name, format!("{value:?}"), expected)
}

impl<T: Field> Field for Option<T> {
    const KIND: Kind = T::KIND;
    const OPTIONAL: bool = true;

    fn choices() -> Vec<&'static str> {
        T::choices()
    }

    fn from_value(name: &str, value: Value) -> Result<Self> {
        if value == Value::None { Ok(None) } else { T::from_value(name, value).map(Some) }
    }

    fn to_value(&self) -> Value {
        self.as_ref().map_or(Value::None, T::to_value)
    }

    fn check(&self, name: &str, limits: Option<&Limits>) -> Result<()> {
        self.as_ref().map_or(Ok(()), |field| field.check(name, limits))
    }
}

impl Field for bool {
    const KIND: Kind = Kind::Flag;

    fn from_value(name: &str, value: Value) -> Result<Self> {
        if let Value::Flag(flag) = value { Ok(flag) } else { Err(of_another_kind::<Self>(name, &value)) }
    }

    fn to_value(&self) -> Value {
        Value::Flag(*self)
    }
}

impl Field for f64 {
    const KIND: Kind = Kind::Number;

    fn from_value(name: &str, value: Value) -> Result<Self> {
        if let Value::Number(number) = value {
            Ok(number)
        } else {
            Err(of_another_kind::<Self>(name, &value))
        }
    }

    fn to_value(&self) -> Value {
        Value::Number(*self)
    }

    fn check(&self, name: &str, limits: Option<&Limits>) -> Result<()> {
        limits.map_or(Ok(()), |limits| limits.check(name, *self))
    }
}

impl Field for usize {
    const KIND: Kind = Kind::Count;

    fn from_value(name: &str, value: Value) -> Result<Self> {
        if let Value::Count(count) = value { Ok(count) } else { Err(of_another_kind::<Self>(name, &value)) }
    }

    fn to_value(&self) -> Value {
        Value::Count(*self)
    }

    fn check(&self, name: &str, limits: Option<&Limits>) -> Result<()> {
        limits.map_or(Ok(()), |limits| limits.check(name, *self as f64))
    }
}

impl<const CHANNELS: usize> Field for [u8; CHANNELS] {
    const KIND: Kind = Kind::Color(CHANNELS);

    fn from_value(name: &str, value: Value) -> Result<Self> {
        let other = of_another_kind::<Self>(name, &value);
        let Value::Color(channels) = value else { return Err(other) };
        channels.try_into().map_err(|_| other)
    }

    fn to_value(&self) -> Value {
        Value::Color(self.to_vec())
    }
}

impl<T: Named> Field for T {
    const KIND: Kind = Kind::Choice;

    fn choices() -> Vec<&'static str> {
        T::names()
    }

    fn from_value(name: &str, value: Value) -> Result<Self> {
        if let Value::Name(chosen) = &value {
            T::named(name, chosen)
        } else {
            Err(of_another_kind::<Self>(name, &value))
        }
    }

    fn to_value(&self) -> Value {
        Value::Name(self.name().to_owned())
    }
}

/// Without a value the window is [`Window::default`]; callers that know the data replace it.
impl Field for Window {
    const KIND: Kind = Kind::Window;
    const OPTIONAL: bool = true;

    fn from_value(name: &str, value: Value) -> Result<Self> {
        match value {
            Value::None => Ok(Self::default()),
            Value::Window(window) => Ok(window),
            other => Err(of_another_kind::<Self>(name, &other)),
        }
    }

    fn to_value(&self) -> Value {
        Value::Window(*self)
    }

    fn check(&self, name: &str, _: Option<&Limits>) -> Result<()> {
        Window::check(self, name)
    }
}

impl Field for Opacity {
    const KIND: Kind = Kind::Opacity;

    fn from_value(name: &str, value: Value) -> Result<Self> {
        if let Value::Opacity(opacity) = value {
            Ok(opacity)
        } else {
            Err(of_another_kind::<Self>(name, &value))
        }
    }

    fn to_value(&self) -> Value {
        Value::Opacity(*self)
    }

    fn check(&self, _: &str, _: Option<&Limits>) -> Result<()> {
        Opacity::check(self)
    }
}

impl Field for Slab {
    const KIND: Kind = Kind::Slab;

    fn choices() -> Vec<&'static str> {
        SlabMode::names()
    }

    fn from_value(name: &str, value: Value) -> Result<Self> {
        if let Value::Slab(slab) = value { Ok(slab) } else { Err(of_another_kind::<Self>(name, &value)) }
    }

    fn to_value(&self) -> Value {
        Value::Slab(*self)
    }

    fn check(&self, _: &str, _: Option<&Limits>) -> Result<()> {
        Slab::check(self)
    }
}

impl Field for Focus {
    const KIND: Kind = Kind::Focus;

    fn from_value(name: &str, value: Value) -> Result<Self> {
        if let Value::Focus(focus) = value { Ok(focus) } else { Err(of_another_kind::<Self>(name, &value)) }
    }

    fn to_value(&self) -> Value {
        Value::Focus(*self)
    }

    fn check(&self, _: &str, _: Option<&Limits>) -> Result<()> {
        Focus::check(self)
    }
}

/// Vessel names are known only once there is a tree; until then callers choose no ids.
impl Field for Vec<usize> {
    const KIND: Kind = Kind::Vessels;

    fn from_value(name: &str, value: Value) -> Result<Self> {
        match value {
            Value::None => Ok(Self::new()),
            Value::Vessels(ids) => Ok(ids),
            other => Err(of_another_kind::<Self>(name, &other)),
        }
    }

    fn to_value(&self) -> Value {
        Value::Vessels(self.clone())
    }
}

impl Field for Transfer {
    const KIND: Kind = Kind::Transfer;

    fn choices() -> Vec<&'static str> {
        Preset::names()
    }

    fn from_value(name: &str, value: Value) -> Result<Self> {
        match value {
            Value::Name(preset) => Ok(Self::Preset(Preset::named(name, &preset)?)),
            Value::Transfer(function) => Ok(Self::Function(function)),
            other => Err(of_another_kind::<Self>(name, &other)),
        }
    }

    fn to_value(&self) -> Value {
        match self {
            Self::Preset(preset) => Value::Name(preset.name().to_owned()),
            Self::Function(function) => Value::Transfer(function.clone()),
        }
    }

    fn check(&self, _: &str, _: Option<&Limits>) -> Result<()> {
        match self {
            Self::Preset(_) => Ok(()),
            Self::Function(function) => TransferFunction::check(function),
        }
    }
}

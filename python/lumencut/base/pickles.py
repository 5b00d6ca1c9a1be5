"""Pickles that refer to a class by its public name, so that they stay readable if its module moves."""

from __future__ import annotations

import importlib
import sys
from typing import Any, TypeVar

#: Modules of the private classes that are stored inside public values.
_PARTS = {
    "Angle": "measuring.profile",
    "Box": "scene.extents",
    "CArm": "measuring.profile",
    "FrameSource": "pictures.frame_source",
    "Legend": "pictures.value_colours",
    "Origin": "scene.study",
    "Spot": "measuring.profile",
    "Stretch": "measuring.profile",
    "Study": "scene.study",
    "Throat": "measuring.profile",
}

_Kind = TypeVar("_Kind", bound=type)


def by_name(kind: _Kind) -> _Kind:
    """Decorate a class so that its objects are pickled by the name of the class.

    The name is public or listed in this file. An object of a subclass is pickled by its module and name.
    """

    def reduced(self: Any, protocol: Any) -> Any:
        whole: Any = object.__reduce_ex__(self, max(protocol, 2))
        make, arguments, *state = whole
        if type(self) is not kind:
            return (make, arguments, *state)
        return (restored(), (kind.__name__, *arguments[1:]), *state)

    setattr(kind, "__reduce_ex__", reduced)  # noqa: B010 - to a class of any kind
    return kind


def restored() -> Any:
    """Return the function of the package that pickles refer to."""
    return vars(sys.modules["lumencut"])["_restored"]


def part(name: str) -> type:
    """Return the class with this name from the list in this file.

    Raises
    ------
    AttributeError
        For a name that is not listed.
    """
    if name not in _PARTS:
        raise AttributeError(f"module 'lumencut' has no attribute {name!r}")
    found: type = getattr(importlib.import_module(f"lumencut.{_PARTS[name]}"), name)
    return found

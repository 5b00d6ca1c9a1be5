"""Pickles of public values: they name a class by its public name, so that they survive a move of modules."""

from __future__ import annotations

import importlib
import sys
from typing import Any, TypeVar

#: Modules of the non-public classes that public values hold.
_PARTS = {
    "Angle": "profile",
    "Box": "dicom_objects.extents",
    "CArm": "profile",
    "FrameSource": "frame_source",
    "Origin": "dicom_objects.study",
    "Spot": "profile",
    "Stretch": "profile",
    "Study": "dicom_objects.study",
}

_Kind = TypeVar("_Kind", bound=type)


def by_name(kind: _Kind) -> _Kind:
    """Decorate a class so that its objects are pickled by the name of the class.

    The name is public, or one of the parts listed in this file. A subclass is pickled by its own path.
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
    """Return a class listed in this file by its name.

    Raises
    ------
    AttributeError
        For a name that is not listed.
    """
    if name not in _PARTS:
        raise AttributeError(f"module 'lumencut' has no attribute {name!r}")
    found: type = getattr(importlib.import_module(f"lumencut.{_PARTS[name]}"), name)
    return found

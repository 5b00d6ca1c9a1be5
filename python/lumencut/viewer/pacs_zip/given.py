"""Checked access to a request of the page: each value has the expected kind, or is rejected."""

from __future__ import annotations

import base64
import binascii
import io
import json
import math
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError

_T = TypeVar("_T")
_SUBJECT = "what the page sent"
_MEND = "reload the page, which may be of another version, and save again"
#: Largest number of pixels of a picture, more than any screen.
_MOST_PIXELS = 64 << 20


def refused(found: str, expected: str) -> FormatError:
    """Return the error for an invalid part of a request."""
    return FormatError(_SUBJECT, found, expected, _MEND)


def read_json(content: bytes) -> Given:
    """Return the object that a request holds as JSON.

    Raises
    ------
    FormatError
        For invalid JSON, or a value other than an object.
    """
    try:
        found = json.loads(content)
    except (ValueError, RecursionError) as error:
        raise refused("a text that is no JSON", "an object of JSON") from error
    return Given(found, "the request")


class Given:
    """An object of JSON; each field is read by name and must have the expected kind.

    Parameters
    ----------
    value : object
        The value.
    name : str
        Its name in errors.

    Raises
    ------
    FormatError
        For a value that is not an object; the methods raise it for fields of another kind.
    """

    def __init__(self, value: Any, name: str) -> None:
        if not isinstance(value, dict):
            raise refused(f"{_kind(value)} as {name}", "an object")
        self._fields, self._name = value, name

    def text(self, name: str) -> str:
        """Return a text."""
        return str(self._checked(name, "a text", is_text))

    def text_or_none(self, name: str) -> str | None:
        """Return a text, or None for null."""
        return None if self._fields.get(name) is None else self.text(name)

    def flag(self, name: str) -> bool:
        """Return a boolean."""
        return bool(self._checked(name, "true or false", lambda value: isinstance(value, bool)))

    def number(self, name: str) -> float:
        """Return a finite number."""
        return float(self._checked(name, "a number", is_number))

    def number_or_none(self, name: str) -> float | None:
        """Return a finite number, or None for null."""
        return None if self._fields.get(name) is None else self.number(name)

    def numbers(self, name: str) -> list[float]:
        """Return a list of finite numbers."""
        return [checked(one, f"{self._name}: {name}", "numbers", is_number) for one in self.items(name)]

    def items(self, name: str) -> list[Any]:
        """Return a list."""
        return list(self._checked(name, "a list", lambda value: isinstance(value, list)))

    def items_or_none(self, name: str) -> list[Any] | None:
        """Return a list, or None for null."""
        return None if self._fields.get(name) is None else self.items(name)

    def texts(self, name: str) -> list[str]:
        """Return a list of texts."""
        return [checked(one, f"{self._name}: {name}", "texts", is_text) for one in self.items(name)]

    def object(self, name: str) -> Given:
        """Return an object."""
        return Given(self._fields.get(name), f"{self._name}: {name}")

    def object_or_none(self, name: str) -> Given | None:
        """Return an object, or None for null."""
        return None if self._fields.get(name) is None else self.object(name)

    def objects(self, name: str) -> list[Given]:
        """Return a list of objects."""
        return [Given(one, f"{self._name}: {name}") for one in self.items(name)]

    def plain(self, name: str) -> dict[str, Any]:
        """Return an object whose fields are checked by other code."""
        self.object(name)
        found: dict[str, Any] = self._fields[name]
        return found

    def points(self, name: str) -> npt.NDArray[np.float64]:
        """Return points (mm, LPS), shape (n, 3)."""
        return points_of(self.items(name), f"{self._name}: {name}")

    def content(self, name: str) -> bytes:
        """Return the bytes that a text holds in base64."""
        try:
            return base64.b64decode(self.text(name), validate=True)
        except (binascii.Error, ValueError) as error:
            raise refused(f"{name} of {self._name} that is no base64", "base64") from error

    def picture(self, name: str) -> npt.NDArray[np.uint8]:
        """Return the pixels of a PNG in base64, RGBA, shape (H, W, 4)."""
        return picture_of(self.content(name))

    def _checked(self, name: str, expected: str, is_so: Callable[[Any], bool]) -> Any:
        return checked(self._fields.get(name), f"{self._name}: {name}", expected, is_so)


def checked(value: _T, name: str, expected: str, is_so: Callable[[Any], bool]) -> _T:
    """Return a value if it is valid, or raise a `FormatError`."""
    if not is_so(value):
        raise refused(f"{_kind(value)} as {name}", expected)
    return value


def is_text(value: Any) -> bool:
    """Return whether a JSON value is text."""
    return isinstance(value, str)


def is_number(value: Any) -> bool:
    """Return whether a JSON value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def points_of(value: Any, name: str) -> npt.NDArray[np.float64]:
    """Return points (mm, LPS), shape (n, 3), or raise a `FormatError`."""
    rows = checked(value, name, "a list of points", lambda one: isinstance(one, list))
    is_point = all(isinstance(row, list) and len(row) == 3 and all(map(is_number, row)) for row in rows)
    if not is_point:
        raise refused(f"{name} that are no points", "three finite numbers each")
    return np.array(rows, np.float64).reshape(-1, 3)


def picture_of(content: bytes) -> npt.NDArray[np.uint8]:
    """Return the pixels of a PNG, RGBA, shape (H, W, 4), or raise a `FormatError`."""
    from PIL import Image

    try:
        with Image.open(io.BytesIO(content), formats=["PNG"]) as picture:
            width, height = picture.size
            if width * height > _MOST_PIXELS:
                raise refused(f"a picture of {width} × {height} pixels", f"at most {_MOST_PIXELS} pixels")
            return np.asarray(picture.convert("RGBA"))
    except FormatError:
        raise
    except Exception as error:  # what Pillow raises for damaged pictures is nearly everything
        raise refused("a picture that cannot be read", "a PNG") from error


def _kind(value: Any) -> str:
    """Return the kind of a value, without its content."""
    names = {dict: "an object", list: "a list", str: "a text", bool: "true or false", type(None): "nothing"}
    return names.get(type(value), "a number")

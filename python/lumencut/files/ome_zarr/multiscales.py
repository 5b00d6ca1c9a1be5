"""The metadata of an OME-Zarr image: axes, levels and their grids, channels."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.checks import numbers
from lumencut.errors import FormatError

#: Millimetres per unit; other units of OME-NGFF are no lengths of scans.
MILLIMETRES = {
    "nanometer": 1e-6,
    "micrometer": 1e-3,
    "millimeter": 1.0,
    "centimeter": 10.0,
    "decimeter": 100.0,
    "meter": 1000.0,
}
#: Every version of OME-NGFF that is read.
VERSIONS = ("0.4", "0.5")
_SPACE = ("x", "y", "z")


@dataclass(frozen=True)
class Axis:
    """An axis of the arrays.

    Attributes
    ----------
    name : str
        Such as ``x``.
    kind : str
        ``space``, ``channel``, ``time``, or empty.
    unit : str
        Such as ``micrometer``; empty if not stated.
    """

    name: str
    kind: str
    unit: str


@dataclass(frozen=True, eq=False)
class StoredLevel:
    """One level: the path of its array, and its grid along all axes, in the units of the axes."""

    path: str
    scale: npt.NDArray[np.float64]
    translation: npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Multiscale:
    """The first image of a group.

    Attributes
    ----------
    version : str
        The version of OME-NGFF.
    axes : tuple of Axis
        The axes of every array, in its order.
    levels : tuple of StoredLevel
        The levels, the finest first.
    channels : tuple of str
        The names of the channels; empty if not stated.
    states_translation : bool
        Whether the metadata state where the levels begin.
    """

    version: str
    axes: tuple[Axis, ...]
    levels: tuple[StoredLevel, ...]
    channels: tuple[str, ...]
    states_translation: bool

    @property
    def space(self) -> tuple[int, int, int]:
        """Numbers of the axes x, y and z."""
        names = [axis.name for axis in self.axes]
        x, y, z = (names.index(name) for name in _SPACE)
        return x, y, z

    @property
    def millimetres(self) -> npt.NDArray[np.float64] | None:
        """Millimetres per unit of x, y and z; None if a unit is not stated."""
        units = [self.axes[number].unit for number in self.space]
        return None if "" in units else np.array([MILLIMETRES[unit] for unit in units])


def multiscale_of(attributes: Mapping[str, Any], groups: Callable[[], list[str]], subject: str) -> Multiscale:
    """Return the checked metadata of an image; `groups` returns the groups within it.

    Raises
    ------
    FormatError
        For attributes that are not those of one image of OME-NGFF 0.4 or 0.5.
    """
    inner = attributes.get("ome", attributes)
    images = inner.get("multiscales") if isinstance(inner, Mapping) else None
    if not images:
        within = sorted(groups())
        mend = f"name one of its groups: {', '.join(within[:8])}" if within else ""
        raise FormatError(subject, "a Zarr group without multiscales", "an OME-Zarr image", mend)
    first = _mapping(images, 0, subject)
    version = str(inner.get("version") or first.get("version") or "not stated")
    if version not in VERSIONS:
        mend = "convert it to OME-NGFF 0.5"
        raise FormatError(subject, f"OME-NGFF {version:.20}", " or ".join(VERSIONS), mend)
    axes = _axes(first, subject)
    levels, states_translation = _levels(first, len(axes), subject)
    return Multiscale(version, axes, levels, _channels(inner), states_translation)


def _axes(image: Mapping[str, Any], subject: str) -> tuple[Axis, ...]:
    stated = image.get("axes")
    if not isinstance(stated, list) or not all(isinstance(one, Mapping) for one in stated):
        raise FormatError(subject, "no axes in its multiscales", "a list of axes with names")
    axes = tuple(Axis(str(one.get("name")), _kind(one), str(one.get("unit") or "")) for one in stated)
    names = [axis.name for axis in axes]
    if len(set(names)) < len(names) or not set(_SPACE) <= set(names):
        raise FormatError(subject, f"the axes {', '.join(names):.80}", "x, y and z, each once")
    for axis in axes:
        if axis.name in _SPACE and axis.unit and axis.unit not in MILLIMETRES:
            expected = f"one of {', '.join(MILLIMETRES)}"
            raise FormatError(subject, f"the unit {axis.unit:.40} of {axis.name}", expected)
    return axes


def _kind(stated: Mapping[str, Any]) -> str:
    """Return the type of an axis; by its usual name if it states none."""
    usual = {"c": "channel", "t": "time"} | dict.fromkeys(_SPACE, "space")
    return str(stated.get("type") or usual.get(str(stated.get("name")), ""))


def _levels(image: Mapping[str, Any], count: int, subject: str) -> tuple[tuple[StoredLevel, ...], bool]:
    stated = image.get("datasets")
    if not isinstance(stated, list) or not stated:
        raise FormatError(subject, "no datasets in its multiscales", "at least one level")
    shared = _grid(image.get("coordinateTransformations", []), count, subject)
    levels, translated = [], shared[2]
    for number in range(len(stated)):
        one = _mapping(stated, number, subject)
        scale, translation, states = _grid(one.get("coordinateTransformations"), count, subject)
        translated = translated or states
        levels.append(
            StoredLevel(str(one.get("path")), scale * shared[0], translation * shared[0] + shared[1])
        )
    return tuple(levels), translated


def _grid(
    stated: Any, count: int, subject: str
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], bool]:
    """Return scale and translation along all axes, and whether a translation is stated."""
    scale, translation, has_translation = np.ones(count), np.zeros(count), False
    if not isinstance(stated, list):
        raise FormatError(subject, "a level without coordinateTransformations", "its scale")
    for number in range(len(stated)):
        one = _mapping(stated, number, subject)
        kind = one.get("type")
        if kind == "scale":
            scale = numbers(FormatError, f"scale of {subject}", one.get("scale"), (count,))
        elif kind == "translation":
            translation = numbers(FormatError, f"translation of {subject}", one.get("translation"), (count,))
            has_translation = True
        elif kind != "identity":
            raise FormatError(subject, f"the transformation {kind!s:.40}", "scale and translation")
    if not (scale > 0).all():
        raise FormatError(subject, f"the scale {scale.tolist()}", "positive numbers")
    return scale, translation, has_translation


def _mapping(stated: Any, number: int, subject: str) -> Mapping[str, Any]:
    one = stated[number] if isinstance(stated, list) else None
    if not isinstance(one, Mapping):
        raise FormatError(subject, "metadata of another form", "an OME-Zarr image")
    return one


def _channels(inner: Mapping[str, Any]) -> tuple[str, ...]:
    omero = inner.get("omero")
    stated = omero.get("channels") if isinstance(omero, Mapping) else None
    if not isinstance(stated, list):
        return ()
    return tuple(str(one.get("label", "")) if isinstance(one, Mapping) else "" for one in stated)

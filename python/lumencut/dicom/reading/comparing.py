"""Compares the values of slices at the same position, because the core sees only headers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from lumencut.base.foreign_errors import refusing
from lumencut.dicom.reading.headers import Image
from lumencut.dicom.reading.pixels import PixelReader
from lumencut.dicom.reading.stack import Slice
from lumencut.dicom.reading.values import in_unit

_CHUNK = 1 << 20


def same_values(pairs: Sequence[tuple[Slice, Slice]], notes: list[str]) -> Iterator[bool]:
    """Return for each pair of slices whether all values are equal; equal copies are not decoded."""
    equal: dict[tuple[int, int], bool] = {}
    for one, other in pairs:
        key = id(one.image), id(other.image)
        if key not in equal:
            equal[key] = _are_copies(one.image, other.image) and _same_bytes(one.image, other.image)
    decoded = [pair for pair in pairs if not equal[id(pair[0].image), id(pair[1].image)]]
    first, second = [one for one, _ in decoded], [other for _, other in decoded]
    with PixelReader(first, notes) as ones, PixelReader(second, notes) as others:
        for one, other in pairs:
            if equal[id(one.image), id(other.image)]:
                yield True
                continue
            with refusing(one.image.source, "DICOM", notes):
                values = in_unit(ones.next(), *one.scaling)
            with refusing(other.image.source, "DICOM", notes):
                yield np.array_equal(values, in_unit(others.next(), *other.scaling))


def _are_copies(one: Image, other: Image) -> bool:
    """Return whether two files have the same UID; two frames of one file are not copies."""
    first, second = (image.header.get("SOPInstanceUID") for image in (one, other))
    return one is not other and bool(first) and first == second


def _same_bytes(one: Image, other: Image) -> bool:
    """Return whether two files have the same bytes."""
    if one.source.size != other.source.size:
        return False
    with one.source.open() as first, other.source.open() as second:
        while (chunk := first.read(_CHUNK)) == second.read(_CHUNK):
            if not chunk:
                return True
    return False

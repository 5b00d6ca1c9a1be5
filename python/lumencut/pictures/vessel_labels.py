"""The names of vessels, written at their ends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from lumencut.pictures.lettering import Sheet, around, writable

if TYPE_CHECKING:
    from lumencut.pictures.frame_source import VesselEnd
    from lumencut.scene.camera import Camera

_Place = tuple[float, float]


def write_vessel_names(sheet: Sheet, camera: Camera, ends: tuple[VesselEnd, ...]) -> None:
    """Write each name next to a dot where its vessel ends, in the order of the tree; see `write_names`."""
    if ends:
        seen = camera.project(np.array([point for _, point in ends]))
        write_names(
            sheet, [(name, (float(x), float(y))) for (name, _), (x, y, _) in zip(ends, seen, strict=True)]
        )


def write_names(sheet: Sheet, ends: Sequence[tuple[str, _Place]]) -> None:
    """Write each name next to a dot at its position (pixels), in this order.

    A name stands to the right of its dot, or else to the left, above or below: the first place where it lies
    within the picture and over nothing that was written before, nor over the dot of another name. A name
    without such a place is left out with its dot, as is one whose dot would lie beyond the picture or over
    something that was written before.
    """
    dots = [around(place, sheet.dot_radius) for _, place in ends]
    for (name, place), dot in zip(ends, dots, strict=True):
        if not sheet.is_free(dot):
            continue
        others = [other for other in dots if other != dot]
        for beside, anchor in _places(place, sheet.dot_radius):
            if sheet.is_free(sheet.box(writable(name), beside, anchor), others):
                sheet.dot(place)
                sheet.write(writable(name), beside, anchor)
                break


def _places(dot: _Place, radius: float) -> Iterator[tuple[_Place, str]]:
    """Return possible positions of a name next to a dot, the best first, with Pillow's anchors."""
    x, y = dot
    gap = 2 * radius
    yield (x + gap, y), "lm"
    yield (x - gap, y), "rm"
    yield (x, y - gap), "md"
    yield (x, y + gap), "ma"

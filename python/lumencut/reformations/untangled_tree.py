"""Untangled CPR: every vessel of a tree cut open in one image, without overlap."""

from __future__ import annotations

import functools
import math
import string
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.reformation import Reformation
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree

if TYPE_CHECKING:
    from lumencut.pictures.lettering import Box

#: Smallest turn of a branch for which an arc is drawn (radians).
_DRAWN_FROM = math.radians(5.0)

#: The radius of an arc that shows a turn, in line heights.
_ARC = 2.0


@dataclass(frozen=True)
class LaidOut:
    """A part of a vessel in the image, between two places where vessels meet or end.

    Attributes
    ----------
    vessel : int
        The id of the vessel.
    arc_length : numpy.ndarray, float64, shape (n,)
        Positions along the vessel (mm from its first point), increasing.
    pixels : numpy.ndarray, float64, shape (n, 2)
        Column and row of each (pixels).
    turn : float
        Turn of the part at its beginning, with all that follows it (radians, counter-clockwise in the
        picture).
    is_reversed : bool
        Whether it begins at its last position.
    """

    vessel: int
    arc_length: npt.NDArray[np.float64]
    pixels: npt.NDArray[np.float64]
    turn: float
    is_reversed: bool


class UntangledTree(Reformation):
    """A vessel tree as an image (H, W) without overlap, made by :func:`lumencut.untangled`.

    Each pixel belongs to the nearest vessel in the image, up to the width on each side. A world point lies
    where the image shows it; NaN where it does not. A pixel is folded where lines across its vessel have met
    before they reach it, or where another part of the tree is nearer in the body: there the same tissue is
    shown next to that part too.

    Attributes
    ----------
    overlaps : tuple of int
        The ids of vessels whose lumen, with the hull margin, could not be separated from others, or from
        themselves; may be empty.
    parts : tuple of LaidOut
        The vessels in the image, in the order of their ids and along them.
    closures : tuple of numpy.ndarray, shape (2, 2)
        The cuts of cycles: column and row of the two positions that are one point in the body.
    """

    _core: _lumencut.Untangled
    _arrays = (*Reformation._arrays, "vessel")

    def __init__(
        self,
        renderer: Renderer,
        core: _lumencut.Untangled,
        tree: VesselTree,
        given: Settings,
        parameters: dict[str, Any],
    ) -> None:
        recipe = ReformationRecipe(
            "untangled CPR", _lumencut.axes_words("untangled"), parameters, "untangled"
        )
        super().__init__(renderer, core, given, recipe, measurable=True)
        self._tree = tree
        self.overlaps: tuple[int, ...] = tuple(core.overlaps)
        self.parts: tuple[LaidOut, ...] = tuple(LaidOut(*part) for part in core.laid_out())
        self.closures: tuple[npt.NDArray[np.float64], ...] = tuple(
            np.array(places) for places in core.closures
        )

    @property
    def rotations(self) -> dict[int, float]:
        """The turn of each vessel at its beginning, by id (radians, counter-clockwise in the picture).

        A vessel that is turned at several places has its largest turn.
        """
        return dict(enumerate(self._core.rotations))

    @functools.cached_property
    def vessel(self) -> npt.NDArray[np.int32]:
        """The id of the vessel that each pixel shows, int32, shape (H, W), -1 where nothing is shown."""
        return self._core.vessel()

    def annotated(self, *, vessel_names: bool = True) -> npt.NDArray[np.uint8]:
        """Return the picture with labels, RGBA, uint8, shape (H, W, 4); a side below 200 pixels gets none.

        The labels are those of every reformation, an arc with degrees where a branch is turned by more than
        5°, the names of vessels (or their ids) where they end, and the same letter at both places of a cycle.
        """
        from lumencut.pictures.lettering import SMALLEST_SIDE, Sheet
        from lumencut.pictures.vessel_labels import write_names

        image = super().annotated(vessel_names=vessel_names)
        if min(image.shape[:2]) < SMALLEST_SIDE:
            return image
        sheet = Sheet(image)
        sheet.taken += _written(image != self.image)
        for letter, places in zip(_letters(len(self.closures)), self.closures, strict=True):
            for column, row in places:
                sheet.write(letter, (column, row), "mm")
        for part in self.parts:
            if abs(part.turn) > _DRAWN_FROM:
                _draw_turn(sheet, part)
        write_names(sheet, list(self._ends(vessel_names).items()))
        return sheet.pixels()

    def _ends(self, names: bool) -> dict[str, tuple[float, float]]:
        """Return the name or the id of each vessel, and where the vessel ends in the image."""
        named = [
            ((vessel.name if names else None) or str(n), self._core.ends[n])
            for n, vessel in enumerate(self._tree)
        ]
        return {name: (column, row) for name, (column, row) in named}


def _written(changed: npt.NDArray[np.bool_]) -> list[Box]:
    """Return the rectangles of the texts in the upper left and lower left quarter of a picture."""
    height, width = changed.shape[0] // 2, changed.shape[1] // 2
    boxes: list[Box] = []
    for top in (0, height):
        rows, columns = np.nonzero(changed[top : top + height, :width].any(axis=2))
        if len(rows):
            boxes.append((columns.min(), top + rows.min(), columns.max() + 1, top + rows.max() + 1))
    return boxes


def _letters(count: int) -> list[str]:
    """Return this number of names for cycles: A, B, … and AA after Z."""
    letters = string.ascii_uppercase
    return [letters[n % 26] * (n // 26 + 1) for n in range(count)]


def _draw_turn(sheet: Any, part: LaidOut) -> None:
    """Draw an arc from the original direction of a part to its direction in the image, with degrees."""
    line = part.pixels[::-1] if part.is_reversed else part.pixels
    (column, row), radius = line[0], _ARC * sheet.line_height
    # The first point at least a radius away gives the direction of the part.
    distance = np.hypot(*(line - line[0]).T)
    along = line[min(int(np.argmax(distance >= radius)), len(line) - 1) or len(line) - 1] - line[0]
    now = math.atan2(-along[1], along[0])
    before = now - part.turn
    sheet.arc((column, row), radius, before, now)
    middle, outside = (before + now) / 2, radius + sheet.line_height
    place = (column + outside * math.cos(middle), row - outside * math.sin(middle))
    words = f"{abs(math.degrees(part.turn)):.0f}°"
    if sheet.is_free(sheet.box(words, place, "mm")):
        sheet.write(words, place, "mm")

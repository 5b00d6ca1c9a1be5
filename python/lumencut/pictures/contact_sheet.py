"""Several pictures as one, each below its title."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut.pictures.lettering import SMALLEST_SIDE, Sheet, writable

Picture: TypeAlias = npt.NDArray[np.uint8]

#: Gap between the pictures of a sheet and around them (pixels).
_GAP = 8

_GROUND = (48, 48, 48, 255)


def contact_sheet(
    pictures: Sequence[Picture], titles: Sequence[str], starts: Collection[int] = ()
) -> Picture:
    """Return pictures (H, W, 4) as one, each below its title, in lines from the upper left.

    Long titles are shortened before their last comma. Pictures whose numbers are in `starts` begin a line.
    """
    panels = [_titled(picture, title) for picture, title in zip(pictures, titles, strict=True)]
    lines = _lines(panels, starts)
    width = max(sum(panel.shape[1] + _GAP for panel in line) for line in lines) + _GAP
    height = sum(max(panel.shape[0] for panel in line) + _GAP for line in lines) + _GAP
    sheet = np.full((height, width, 4), _GROUND, np.uint8)
    top = _GAP
    for line in lines:
        left = _GAP
        for panel in line:
            sheet[top : top + panel.shape[0], left : left + panel.shape[1]] = panel
            left += panel.shape[1] + _GAP
        top += max(panel.shape[0] for panel in line) + _GAP
    return sheet


def _titled(picture: Picture, title: str) -> Picture:
    """Return a picture below its title, as wide as the wider of both."""
    probe = Sheet(np.zeros((SMALLEST_SIDE, SMALLEST_SIDE, 4), np.uint8))
    name, comma, rest = title.rpartition(", ")
    words = f"{writable(name)}{comma}{writable(rest)}"
    width = max(picture.shape[1], math.ceil(probe.box(words, (0, 0))[2]) + 2)
    strip = probe.line_height + 2
    panel = np.full((strip + picture.shape[0], width, 4), _GROUND, np.uint8)
    opacity = picture[..., 3:] / 255
    blended = picture[..., :3] * opacity + np.array(_GROUND[:3]) * (1 - opacity)
    panel[strip:, : picture.shape[1], :3] = blended.round()
    head = Sheet(np.ascontiguousarray(panel[:strip]))
    head.write(words, (1, 1))
    panel[:strip] = head.pixels()
    return panel


def _lines(panels: Sequence[Picture], starts: Collection[int]) -> list[list[Picture]]:
    """Return the pictures in lines that make the sheet about 1.5 times as wide as high."""
    area = sum((panel.shape[0] + _GAP) * (panel.shape[1] + _GAP) for panel in panels)
    widest = max(math.sqrt(1.5 * area), max(panel.shape[1] for panel in panels) + 2 * _GAP)
    lines: list[list[Picture]] = []
    taken = math.inf
    for number, panel in enumerate(panels):
        taken += panel.shape[1] + _GAP
        if taken > widest or number in starts:
            lines.append([])
            taken = panel.shape[1] + 2 * _GAP
        lines[-1].append(panel)
    return lines

"""Reads the labels of a picture by comparing the shapes of letters."""

from __future__ import annotations

import functools
import itertools

import numpy as np
from PIL import Image, ImageDraw, ImageFont

#: All possible labels of an edge: one to three sides, no two on one axis.
SIDES = [
    "".join(letters)
    for count in (1, 2, 3)
    for axes in itertools.permutations(("RL", "AP", "IS"), count)
    for letters in itertools.product(*axes)
]


def heights(size: tuple[int, int]) -> tuple[int, int]:
    """Heights of words and of the letters of the sides (pixels): a fortieth of the shorter side, 12 to 64."""
    words = min(64, max(12, round(min(size) / 40)))
    return words, round(words * 1.3)


@functools.cache
def shape_of(text: str, height: int) -> np.ndarray:
    """Return the brightness of a text, white on black, without the border around it."""
    font = ImageFont.load_default(height)
    picture = Image.new("L", (height * (len(text) + 2), 3 * height))
    ImageDraw.Draw(picture).text((height, height), text, font=font, fill=255)
    return trimmed(np.array(picture))


def trimmed(grey: np.ndarray) -> np.ndarray:
    """The part of a grey picture that is not black."""
    rows, columns = np.nonzero(grey.any(axis=1))[0], np.nonzero(grey.any(axis=0))[0]
    return grey[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1] if len(rows) else grey[:0, :0]


def read(grey: np.ndarray, candidates: list[str], height: int) -> str | None:
    """Return the text on a black background; None if there is none."""
    found = trimmed(grey)
    if not found.size:
        return None
    matching = [text for text in candidates if np.array_equal(shape_of(text, height), found)]
    assert len(matching) == 1, f"{matching} in a part of {found.shape}"
    return matching[0]


def edge_parts(picture: np.ndarray) -> dict[str, np.ndarray]:
    """The grey values in the middle of the four edges."""
    grey = picture[..., 0]
    height, width = grey.shape
    deep = round(1.3 * heights((width, height))[1])
    rows, columns = slice(height // 2 - deep, height // 2 + deep), slice(width // 2 - deep, width // 2 + deep)
    wide = slice(0, 3 * deep), slice(width - 3 * deep, width)
    return {
        "left": grey[rows, wide[0]],
        "right": grey[rows, wide[1]],
        "top": grey[: 2 * deep, columns],
        "bottom": grey[-2 * deep :, columns],
    }


def read_sides(picture: np.ndarray) -> dict[str, str | None]:
    """The letters at the four edges."""
    height = heights(picture.shape[1::-1])[1]
    return {edge: read(part, SIDES, height) for edge, part in edge_parts(picture).items()}

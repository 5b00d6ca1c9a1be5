"""Writing and drawing on pictures in white with a dark outline, readable on any background."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.errors import MissingPackageError

if TYPE_CHECKING:
    from PIL.ImageFont import FreeTypeFont

#: The left, top, right and bottom edge of a rectangle (pixels).
Box: TypeAlias = tuple[float, float, float, float]

#: Pictures whose shorter side is smaller than this (pixels) get no labels.
SMALLEST_SIDE = 200

_LIGHT, _DARK = (255, 255, 255, 255), (0, 0, 0, 255)

#: Height of letters (pixels): a fortieth of the shorter side of the picture, within these limits.
_SMALLEST, _LARGEST, _PART = 12, 64, 40

#: Size of the letters for the patient's sides, relative to other letters.
_LARGER = 1.3

#: Widest name (letters) that is written in full.
_LONGEST_NAME = 32


class Sheet:
    """A copy of an RGBA picture (H, W, 4) to write on; it remembers which rectangles are already used."""

    def __init__(self, image: npt.NDArray[np.uint8]) -> None:
        from PIL import Image, ImageDraw

        self._picture = Image.fromarray(image)
        self._draw = ImageDraw.Draw(self._picture)
        self.size: tuple[int, int] = self._picture.size
        height = min(_LARGEST, max(_SMALLEST, round(min(self.size) / _PART)))
        self._fonts = (_font(height), _font(round(height * _LARGER)))
        self._outline = max(1, round(height / 10))
        self.margin = max(4, round(height / 2))
        self.line_height = round(height * 1.35)
        self.taken: list[Box] = []

    def pixels(self) -> npt.NDArray[np.uint8]:
        """Return the picture with everything drawn so far, uint8, shape (H, W, 4)."""
        return np.array(self._picture)

    def write(
        self, text: str, place: tuple[float, float], anchor: str = "la", *, is_large: bool = False
    ) -> None:
        """Write one line; `anchor` is Pillow's code for the point of the line that lies at `place`."""
        self.taken.append(self.box(text, place, anchor, is_large=is_large))
        self._draw.text(
            _whole(place),
            text,
            fill=_LIGHT,
            font=self._fonts[is_large],
            anchor=anchor,
            stroke_width=self._outline,
            stroke_fill=_DARK,
        )

    def box(
        self, text: str, place: tuple[float, float], anchor: str = "la", *, is_large: bool = False
    ) -> Box:
        """Return the rectangle that a line would cover, including its outline."""
        return self._draw.textbbox(
            _whole(place), text, font=self._fonts[is_large], anchor=anchor, stroke_width=self._outline
        )

    def wrapped(self, line: str) -> list[str]:
        """Split a line into pieces that fit between the left edge and a letter in the middle."""
        room = self.size[0] / 2 - 2 * self.margin - self._fonts[1].getlength("SAL") / 2
        pieces: list[str] = []
        # Lines break only before a letter, so that a number stays on the line of the word before it.
        for word in re.split(" (?=[a-zA-Z])", line):
            longer = f"{pieces[-1]} {word}" if pieces else word
            if pieces and self._fonts[0].getlength(longer) <= room:
                pieces[-1] = longer
            else:
                pieces.append(word)
        return pieces

    def scale_bar(self, spacing: float) -> None:
        """Draw the scale bar of a picture with pixels of this side (mm) into the lower left corner."""
        found = _lumencut.scale_bar(self.size[0], spacing)
        if found is not None:
            _, words, pixels = found
            self.ruler(pixels, words)

    def ruler(self, length: float, words: str) -> None:
        """Draw a bar of this length (pixels) into the lower left corner, with words above."""
        self._bar(round(length), self.size[1] - self.margin, words)

    def _bar(self, length: int, bottom: float, words: str) -> None:
        """Draw a bar of this length (pixels) at the left, above `bottom`, with ticks, and words above."""
        outline, thick = self._outline, max(2, self._outline)
        left, base = self.margin + outline, round(bottom) - outline
        right, tall = left + length - 1, 3 * thick
        parts = [(left, base - thick + 1, right, base)]
        parts += [(x, base - tall + 1, x + thick - 1, base) for x in (left, right - thick + 1)]
        for x0, y0, x1, y1 in parts:
            self._draw.rectangle((x0 - outline, y0 - outline, x1 + outline, y1 + outline), fill=_DARK)
        for part in parts:
            self._draw.rectangle(part, fill=_LIGHT)
        self.taken.append((left - outline, base - tall - outline, right + outline, base + outline))
        self.write(words, (left, base - tall - 2 * outline), "ld")

    def patch(self, box: Box, color: tuple[int, int, int]) -> None:
        """Fill a box with a colour, such as one that a legend explains."""
        self.taken.append(box)
        self._draw.rectangle(box, fill=(*color, 255), outline=_LIGHT)

    def paste(self, pixels: npt.NDArray[np.uint8], corner: tuple[int, int]) -> None:
        """Put RGBA pixels (H, W, 4) at the column and row of their upper left corner."""
        from PIL import Image

        (left, top), (height, width) = corner, pixels.shape[:2]
        self.taken.append((left, top, left + width, top + height))
        self._picture.paste(Image.fromarray(pixels), corner)

    def arc(self, center: tuple[float, float], radius: float, start: float, end: float) -> None:
        """Draw an arc about a point between two angles (radians, counter-clockwise from the right)."""
        # Pillow expects clockwise angles in degrees, the smaller angle first.
        first, last = sorted((-math.degrees(start), -math.degrees(end)))
        for fill, width, beyond in ((_DARK, 3 * self._outline, self._outline), (_LIGHT, self._outline, 0)):
            self._draw.arc(around(center, radius + beyond), first, last, fill=fill, width=width)

    def dot(self, place: tuple[float, float]) -> None:
        """Draw a dot about a point."""
        self.taken.append(around(place, self.dot_radius))
        for radius, fill in ((self.dot_radius, _DARK), (self.dot_radius - self._outline, _LIGHT)):
            self._draw.ellipse(around(place, radius), fill=fill)

    @property
    def dot_radius(self) -> float:
        """Return the radius of a dot with its outline (pixels)."""
        return 3 * self._outline

    def is_free(self, box: Box, others: Iterable[Box] = ()) -> bool:
        """Return whether a box lies within the picture and overlaps no other box."""
        width, height = self.size
        within = box[0] >= 0 and box[1] >= 0 and box[2] <= width and box[3] <= height
        return within and not any(_overlap(box, other) for other in (*self.taken, *others))


def around(place: tuple[float, float], radius: float) -> Box:
    """Return the rectangle of a dot at a point."""
    x, y = place
    return x - radius, y - radius, x + radius, y + radius


def writable(name: str) -> str:
    """Return a name in letters that the font has: without accents, others as `?`, cut if long."""
    bare = (letter for letter in unicodedata.normalize("NFKD", name) if not unicodedata.combining(letter))
    known = "".join(letter if letter.isascii() and letter.isprintable() else "?" for letter in bare).strip()
    return known if len(known) <= _LONGEST_NAME else known[: _LONGEST_NAME - 1] + "…"


def _overlap(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def _whole(place: tuple[float, float]) -> tuple[int, int]:
    """Return a position rounded to integers, so that letters are sharp."""
    return round(place[0]), round(place[1])


def _font(height: int) -> FreeTypeFont:
    from PIL import ImageFont

    font = ImageFont.load_default(height)
    if not isinstance(font, ImageFont.FreeTypeFont):
        mend = "install Pillow from its own wheel"
        raise MissingPackageError("labels on the picture", "Pillow without FreeType", "FreeType", mend)
    return font

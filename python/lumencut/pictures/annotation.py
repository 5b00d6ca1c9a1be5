"""Labels on a picture: sides of the patient, view, window, scale bar, colours of a rim, vessels' names."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut.pictures.lettering import SMALLEST_SIDE, Sheet
from lumencut.pictures.value_colours import write_legend
from lumencut.pictures.vessel_labels import write_vessel_names
from lumencut.scene.orientation import edges, view_name

if TYPE_CHECKING:
    from lumencut.pictures.frame_source import FrameSource
    from lumencut.scene.camera import Camera
    from lumencut.scene.window import Window


def annotated(
    image: npt.NDArray[np.uint8], camera: Camera, source: FrameSource, *, vessel_names: bool
) -> npt.NDArray[np.uint8]:
    """Return a copy of an RGBA picture (H, W, 4) with labels; too small pictures get none."""
    if min(camera.size) < SMALLEST_SIDE:
        return image.copy()
    sheet = Sheet(image)
    if source.states_orientation:
        _write_sides(sheet, edges(camera))
    _write_words(sheet, camera, source)
    _write_scale(sheet, camera, source)
    if source.legend is not None:
        write_legend(sheet, source.legend)
    if vessel_names:
        write_vessel_names(sheet, camera, source.vessel_ends)
    return sheet.pixels()


def with_labels(
    image: npt.NDArray[np.uint8], words: Iterable[str], letters: dict[str, str], spacing: float | None
) -> npt.NDArray[np.uint8]:
    """Return a copy of an RGBA picture (H, W, 4) with labels; too small pictures get none.

    Text is in the upper left corner; the letters of the patient's sides are at the edges. If the side of a
    pixel (mm) is given, a scale bar is in the lower left corner.
    """
    if min(image.shape[:2]) < SMALLEST_SIDE:
        return image.copy()
    sheet = Sheet(image)
    _write_sides(sheet, letters)
    _write_lines(sheet, words)
    if spacing is not None:
        sheet.scale_bar(spacing)
    return sheet.pixels()


def _write_sides(sheet: Sheet, letters: dict[str, str]) -> None:
    """Write the letter of each side of the patient in the middle of the edge on that side."""
    width, height, margin = *sheet.size, sheet.margin
    places = {
        "left": ((margin, height / 2), "lm"),
        "right": ((width - margin, height / 2), "rm"),
        "top": ((width / 2, margin), "mt"),
        "bottom": ((width / 2, height - margin), "mb"),
    }
    for edge, word in letters.items():
        place, anchor = places[edge]
        sheet.write(word, place, anchor, is_large=True)


def _write_words(sheet: Sheet, camera: Camera, source: FrameSource) -> None:
    """Write the view and the window into the upper left corner."""
    lines = [view_name(camera) if source.states_orientation else "orientation not stated"]
    if source.window is not None:
        lines.append(window_words(source.window))
    _write_lines(sheet, lines)


def _write_lines(sheet: Sheet, lines: Iterable[str]) -> None:
    """Write lines into the upper left corner."""
    pieces = [piece for line in lines for piece in sheet.wrapped(line)]
    for number, piece in enumerate(pieces):
        sheet.write(piece, (sheet.margin, sheet.margin + number * sheet.line_height), "la")


def _write_scale(sheet: Sheet, camera: Camera, source: FrameSource) -> None:
    """Draw a bar with its length into the lower left corner."""
    if source.states_spacing:
        sheet.scale_bar(camera.pixel_spacing)
        return
    bottom: float = sheet.size[1] - sheet.margin
    for line in reversed(sheet.wrapped("spacing not stated")):
        sheet.write(line, (sheet.margin, bottom), "ld")
        bottom -= sheet.line_height


def window_words(window: Window) -> str:
    """Return the width and the level of a window, written as in other DICOM viewers."""
    return f"W {_short(window.width)} L {_short(window.level)}"


def _short(value: float) -> str:
    """Return a number with about four digits, without an exponent at usual intensities."""
    return f"{value:.0f}" if 100 <= abs(value) < 1e7 else f"{value:.3g}"

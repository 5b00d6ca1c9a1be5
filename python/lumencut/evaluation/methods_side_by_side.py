"""Four methods side by side in one view, and where their depths differ: what ``lumencut compare`` draws."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.pictures.lettering import Sheet
from lumencut.reformations.tree_reformations import MPCPR, cr_method

if TYPE_CHECKING:
    from lumencut.pictures.frame import Frame
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings

#: Pictures whose shorter side is smaller than this (pixels) get no titles and no legend.
SMALLEST_SIDE = 200
OURS = "CSR (Lumencut)"

#: Colour of pixels from each difference of depth on (mm), and colour of pixels that a method does not show.
_COLORS = ((0.5, (255, 236, 120)), (2.0, (255, 160, 40)), (5.0, (230, 40, 40)), (20.0, (190, 40, 190)))
_NOTHING = (70, 130, 255)
#: Smallest difference of depth that the legend counts (mm).
_COUNTED = 2.0
#: Opacity of the colour over a marked pixel, and brightness of the picture below the colour.
_COVER, _DIM = 0.6, 0.6


@dataclass(frozen=True, eq=False)
class Panel:
    """The picture of a view by one method.

    Parameters
    ----------
    title : str
        The name of the method.
    frame : Frame
        The frame of the view.
    """

    title: str
    frame: Frame


def panels(
    renderer: Renderer, camera: Camera, settings: Settings, radius_offset: float, arc_threshold: float
) -> list[Panel]:
    """Return the view by mpCPR, CR, CSR by the paper's rules, and CSR by the settings.

    ``radius_offset`` and ``arc_threshold`` are those of :func:`lumencut.cr`. As in the paper, only CSR has
    silhouettes.
    """
    paper, without_lines = replace(settings, **_lumencut.PAPER), replace(settings, silhouettes=False)
    return [
        Panel("mpCPR", renderer._by(MPCPR, camera, without_lines)),
        Panel("CR", renderer._by(cr_method(radius_offset, arc_threshold), camera, without_lines)),
        Panel("CSR (the paper's rules)", renderer.render(camera, paper)),
        Panel(OURS, renderer.render(camera, settings)),
    ]


def side_by_side(
    shown: Sequence[Panel],
    pictures: Sequence[npt.NDArray[np.uint8]],
    further: Sequence[tuple[str, npt.NDArray[np.uint8]]] = (),
) -> npt.NDArray[np.uint8]:
    """Return the panels as one picture, RGBA: the pictures above, differences of depth below.

    The other panels are compared with the last one. ``pictures`` are the pictures of the panels, (H, W, 4),
    with or without labels. In the lower row colours mark pixels whose depth differs from that of the last
    panel, if either shows a value of the volume; the legend is below the last panel. ``further`` are titles
    and pictures with other pixels, which have no depth to compare; they are drawn at the right, as large as
    they fit.
    """
    ours = shown[-1].frame
    marked = [marks(panel.frame, ours) for panel in shown[:-1]]
    lower = [_painted(panel.frame, mark) for panel, mark in zip(shown, marked, strict=False)]
    legend = _legend(
        ours.image.shape[:2], [(panel.title, mark) for panel, mark in zip(shown, marked, strict=False)]
    )
    titles = [panel.title for panel in shown]
    differences = [f"{title}: depth" for title in titles[:-1]]
    rows = [
        [_titled(title, picture) for title, picture in zip(titles, pictures, strict=True)],
        [_titled(title, picture) for title, picture in zip(differences, lower, strict=True)],
    ]
    rows[1].append(_titled("", legend))
    for title, picture in further:
        rows[0].append(_titled(title, _fitted(picture, legend.shape)))
        rows[1].append(_titled("", _without_depth(legend.shape)))
    return np.concatenate([np.concatenate(row, axis=1) for row in rows])


def marks(frame: Frame, ours: Frame) -> npt.NDArray[np.float64]:
    """Return how far the depth of a frame differs from that of the frame to compare with (mm), (H, W).

    It is NaN where neither shows a value of the volume, and infinite where ours does and the frame has no
    depth.
    """
    seen = ~np.isnan(ours.value) | ~np.isnan(frame.value)
    with np.errstate(invalid="ignore"):
        apart = np.abs(frame.depth.astype(float) - ours.depth)
    return np.where(seen, np.where(np.isnan(apart), np.inf, apart), np.nan)


def share_beyond(mark: npt.NDArray[np.float64], bound: float) -> float:
    """Return how much of the tissue differs in depth by more than a bound (mm), in percent of its pixels."""
    seen = ~np.isnan(mark)
    return 100.0 * int(np.count_nonzero(mark[seen] > bound)) / max(int(np.count_nonzero(seen)), 1)


def _painted(frame: Frame, mark: npt.NDArray[np.float64]) -> npt.NDArray[np.uint8]:
    """Return the picture in dim grey, with the colours of the differences over it."""
    grey = frame.image[..., :3].mean(axis=2) * _DIM
    picture = np.repeat(grey[..., None], 3, axis=2)
    for bound, color in (*_COLORS, (np.inf, _NOTHING)):
        which = mark >= bound if bound < np.inf else np.isinf(mark)
        picture[which] = (1 - _COVER) * grey[which, None] + _COVER * np.array(color)
    return _opaque(np.rint(picture).astype(np.uint8))


def _legend(
    size: tuple[int, ...], differences: Sequence[tuple[str, npt.NDArray[np.float64]]]
) -> npt.NDArray[np.uint8]:
    """Return the legend on black: the colours, their meaning, and how much of the tissue differs."""
    sheet = Sheet(_opaque(np.zeros((*size[:2], 3), np.uint8)))
    bounds = [bound for bound, _ in _COLORS]
    ends = [*(f"{bound:g} to {end:g} mm" for bound, end in itertools.pairwise(bounds))]
    words = [*ends, f"{bounds[-1]:g} mm and more", "nothing shown there"]
    line, left = sheet.line_height, sheet.margin
    sheet.write("Difference of depth from", (left, left))
    sheet.write(f"{OURS}:", (left, left + line))
    colors = [*(color for _, color in _COLORS), _NOTHING]
    for number, (color, text) in enumerate(zip(colors, words, strict=True), 2):
        top = left + round(number * 1.2 * line)
        sheet.patch((left, top, left + line, top + line - 2), color)
        sheet.write(text, (left + round(1.5 * line), top))
    top = left + round(9 * line)
    sheet.write(f"More than {_COUNTED:g} mm on", (left, top))
    for number, (title, mark) in enumerate(differences, 1):
        text = f"{share_beyond(mark, _COUNTED):.1f} % of the tissue: {title}"
        sheet.write(text, (left, top + number * line))
    return sheet.pixels()


def _fitted(picture: npt.NDArray[np.uint8], shape: tuple[int, ...]) -> npt.NDArray[np.uint8]:
    """Return a picture as large as it fits, in the middle of black pixels of a given shape."""
    from PIL import Image

    (height, width), (rows, columns) = shape[:2], picture.shape[:2]
    scale = min(height / rows, width / columns)
    size = (max(1, round(columns * scale)), max(1, round(rows * scale)))
    small = Image.fromarray(picture).resize(size, Image.Resampling.LANCZOS)
    ground = Image.new("RGBA", (width, height), (0, 0, 0, 255))
    ground.alpha_composite(small, ((width - size[0]) // 2, (height - size[1]) // 2))
    return np.array(ground)


def _without_depth(shape: tuple[int, ...]) -> npt.NDArray[np.uint8]:
    """Return black pixels with the reason why there is nothing to compare."""
    sheet = Sheet(_opaque(np.zeros((*shape[:2], 3), np.uint8)))
    for number, line in enumerate(
        ("Its pixels are not those", "of the view: it has", "no depth to compare.")
    ):
        sheet.write(line, (sheet.margin, sheet.margin + number * sheet.line_height))
    return sheet.pixels()


def _titled(title: str, picture: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Return a picture below a strip with its title, with a dark line at the right."""
    height, width = picture.shape[:2]
    strip = Sheet(_opaque(np.zeros((max(24, round(min(height, width) / 16)), width, 3), np.uint8)))
    strip.write(title, (width / 2, strip.size[1] / 2), "mm", is_large=True)
    whole = np.concatenate([strip.pixels(), picture])
    whole[:, -1] = (90, 90, 90, 255)
    return whole


def _opaque(picture: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    return np.dstack([picture, np.full(picture.shape[:2], 255, np.uint8)])

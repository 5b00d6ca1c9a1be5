"""Pictures of the quantities of a cut surface: depth, cost, levels, kinds of pieces and zones."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from lumencut.scene.camera import Camera
    from lumencut.scene.vessel_tree import VesselTree

#: RGB, uint8, shape (H, W, 3).
Picture: TypeAlias = npt.NDArray[np.uint8]

#: Stripes, wedges, half-planes and full planes.
PIECE_COLORS = ((101, 67, 33), (222, 184, 135), (70, 110, 200), (130, 190, 235))
EVEN_LEVEL, ODD_LEVEL = (60, 160, 80), (200, 70, 60)
#: Colours of zones that colour-blind readers tell apart (Okabe and Ito).
ZONE_COLORS = (
    (230, 159, 0),
    (86, 180, 233),
    (0, 158, 115),
    (240, 228, 66),
    (0, 114, 178),
    (213, 94, 0),
    (204, 121, 167),
)
LINE = (230, 40, 40)
#: Share of the pixels whose values span the grey scale (%).
_SPAN = (1, 99)


def grey(values: npt.NDArray[np.floating]) -> Picture:
    """Return values as grey, the smallest bright: near, or of little cost."""
    low, high = np.percentile(values, _SPAN)
    share = np.clip((high - values) / max(high - low, 1e-6), 0, 1)
    picture: Picture = np.repeat((40 + 215 * share).astype(np.uint8)[..., None], 3, axis=2)
    return picture


def relief(values: npt.NDArray[np.floating], spacing: float) -> Picture:
    """Return values (mm) as a surface towards the viewer, lit from the upper left."""
    low, high = np.percentile(values, _SPAN)
    down, right = np.gradient(np.clip(values, low, high), spacing)
    # The light comes from the left, from above, and from the viewer.
    light = (1 + 0.6 * right + 0.6 * down) / np.sqrt((1 + right**2 + down**2) * (1 + 2 * 0.6**2))
    picture: Picture = (grey(values) * np.clip(0.35 + 0.65 * light, 0, 1)[..., None]).astype(np.uint8)
    return picture


def lit(colors: Picture, depth: npt.NDArray[np.floating], spacing: float) -> Picture:
    """Return colours on the surface of a depth (mm)."""
    shade = relief(depth, spacing).astype(float) / 255
    return np.asarray(colors * (0.35 + 0.65 * shade), np.uint8)


def levels(level: npt.NDArray[np.floating]) -> Picture:
    """Return levels of detail in two colours in turn, blended as the levels are."""
    share = np.abs(np.mod(level, 2) - 1)[..., None]
    return np.asarray(share * np.array(EVEN_LEVEL) + (1 - share) * np.array(ODD_LEVEL), np.uint8)


def pieces(piece: npt.NDArray[np.integer]) -> Picture:
    """Return kinds of pieces in their colours."""
    picture: Picture = np.array(PIECE_COLORS, np.uint8)[piece]
    return picture


def zones(vessel: npt.NDArray[np.integer]) -> Picture:
    """Return the zones of vessels in their colours."""
    picture: Picture = np.array(ZONE_COLORS, np.uint8)[vessel % len(ZONE_COLORS)]
    return picture


def with_centerlines(picture: Picture, tree: VesselTree, camera: Camera) -> Picture:
    """Return a picture with the centerlines of a tree over it."""
    return _drawn(picture, [_pixels(vessel.points, camera) for vessel in tree])


def _pixels(points: npt.NDArray[np.float64], camera: Camera) -> npt.NDArray[np.float64]:
    """Return the places of world points in a picture (pixels from its upper left corner)."""
    return camera.project(points)[:, :2] + 0.5


def _drawn(picture: Picture, lines: list[npt.NDArray[np.float64]]) -> Picture:
    """Return a picture with lines over it, smoothed by drawing them four times as large."""
    from PIL import Image, ImageDraw

    enlarged, (height, width) = 4, picture.shape[:2]
    cover = Image.new("L", (width * enlarged, height * enlarged), 0)
    draw = ImageDraw.Draw(cover)
    for places in lines:
        corners = [(float(x), float(y)) for x, y in places * enlarged]
        draw.line(corners, fill=255, width=enlarged + 1)
    small = np.asarray(cover.resize((width, height), Image.Resampling.BOX), float)[..., None] / 255
    return np.asarray(picture * (1 - small) + np.array(LINE) * small, np.uint8)

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
#: Sides of a tube's cross-section, and distance between its rings (radii).
_SIDES, _RING_STEP = 12, 1.5
#: Colour strength of wires on the far side of a tube.
_FAR_SIDE = 0.35


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
    lines = [(_pixels(vessel.points, camera), 1.0) for vessel in tree]
    return _drawn(picture, lines)


def with_wireframe(picture: Picture, tree: VesselTree, camera: Camera) -> Picture:
    """Return a picture with the vessel walls of a tree over it, as rings and lines along the vessels."""
    lines = []
    for vessel in tree:
        radius = np.ones(len(vessel.points)) if vessel.radius is None else np.maximum(vessel.radius, 0.5)
        wall, outwards = _tube(vessel.points, radius)
        faces = np.einsum("nsk,k->ns", outwards, np.asarray(camera.direction)) < 0
        rings = _ring_places(vessel.points, radius)
        strips = [(wall[at], faces[at]) for at in rings]
        strips += [(wall[:, side], faces[:, side]) for side in range(_SIDES)]
        for points, is_near in strips:
            lines += [(_pixels(points, camera), 1.0 if is_near.mean() > 0.5 else _FAR_SIDE)]
    lines.sort(key=lambda line: line[1])
    return _drawn(picture, lines)


def _tube(
    points: npt.NDArray[np.float64], radius: npt.NDArray[np.float64]
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Return points on the wall, (n, sides + 1, 3), and the directions to them from the centerline."""
    tangent = np.gradient(points, axis=0)
    tangent /= np.maximum(np.linalg.norm(tangent, axis=1, keepdims=True), 1e-12)
    normal = np.cross(tangent[0], np.eye(3)[np.abs(tangent[0]).argmin()])
    frames = []
    for along in tangent:
        # The normal turns with the vessel, but not around it.
        normal = normal - (normal @ along) * along
        normal /= max(np.linalg.norm(normal), 1e-12)
        frames.append((normal, np.cross(along, normal)))
    first, second = (np.array(axis) for axis in zip(*frames, strict=True))
    angle = np.linspace(0, 2 * np.pi, _SIDES + 1)
    outwards = first[:, None] * np.cos(angle)[:, None] + second[:, None] * np.sin(angle)[:, None]
    return points[:, None] + radius[:, None, None] * outwards, outwards


def _ring_places(points: npt.NDArray[np.float64], radius: npt.NDArray[np.float64]) -> list[int]:
    """Return the points of a vessel that get a ring."""
    kept, apart = [0], 0.0
    for i in range(1, len(points)):
        apart += float(np.linalg.norm(points[i] - points[i - 1]))
        if apart >= _RING_STEP * radius[i]:
            kept.append(i)
            apart = 0.0
    return kept


def _pixels(points: npt.NDArray[np.float64], camera: Camera) -> npt.NDArray[np.float64]:
    """Return the places of world points in a picture (pixels from its upper left corner)."""
    return camera.project(points)[:, :2] + 0.5


def _drawn(picture: Picture, lines: list[tuple[npt.NDArray[np.float64], float]]) -> Picture:
    """Return a picture with lines of a strength over it, smoothed by drawing them four times as large."""
    from PIL import Image, ImageDraw

    enlarged, (height, width) = 4, picture.shape[:2]
    cover = Image.new("L", (width * enlarged, height * enlarged), 0)
    draw = ImageDraw.Draw(cover)
    for places, strength in lines:
        corners = [(float(x), float(y)) for x, y in places * enlarged]
        draw.line(corners, fill=round(255 * strength), width=enlarged + 1)
    small = np.asarray(cover.resize((width, height), Image.Resampling.BOX), float)[..., None] / 255
    return np.asarray(picture * (1 - small) + np.array(LINE) * small, np.uint8)

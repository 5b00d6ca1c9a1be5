"""Found vessels drawn over four projections of the volume, coloured by confidence."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from lumencut import Camera, Renderer, Settings, Vessel, VesselTree, Volume

PIXELS_PER_SIDE = 900
TURNS = (0, 45, 90, 135)
"""Views in degrees from the front; those from behind are mirror images."""
COLORS = ((220, 40, 40), (245, 220, 60), (60, 220, 90))
"""For confidence 0, 0.7 and 1."""


def save_pictures(path: Path, volume: Volume, tree: VesselTree) -> None:
    """Write one picture of four projections; sure vessels are thick, doubtful ones thin."""
    renderer = Renderer(volume, None)
    front = Camera.anterior(volume, size=(PIXELS_PER_SIDE, PIXELS_PER_SIDE))
    sheet = Image.new("RGB", (2 * PIXELS_PER_SIDE, 2 * PIXELS_PER_SIDE))
    for number, turn in enumerate(TURNS):
        camera = front.rotated(degrees=turn)
        frame = renderer.render(camera, Settings(context="mip"))
        picture = Image.fromarray(np.asarray(frame.image)[..., :3] // 2)
        draw = ImageDraw.Draw(picture)
        for vessels, width in ((tree.doubtful, 1), (tree, 3)):
            for vessel in vessels:
                _draw(draw, camera, vessel, width)
        draw.text((10, 10), f"{turn} degrees from the front", fill=(255, 255, 255))
        sheet.paste(picture, (PIXELS_PER_SIDE * (number % 2), PIXELS_PER_SIDE * (number // 2)))
    sheet.save(path)


def _draw(draw: ImageDraw.ImageDraw, camera: Camera, vessel: Vessel, width: int) -> None:
    columns, rows, _ = camera.project(vessel.points).T
    confidence = np.ones(len(vessel)) if vessel.confidence is None else vessel.confidence
    channels = [np.interp(confidence, (0, 0.7, 1), channel) for channel in zip(*COLORS, strict=True)]
    for n in range(len(vessel) - 1):
        color = tuple(int(channel[n]) for channel in channels)
        draw.line([columns[n], rows[n], columns[n + 1], rows[n + 1]], fill=color, width=width)

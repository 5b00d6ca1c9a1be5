"""Make the reformations of `reformations.json` with the Python package: what the pane of the page must show.

Run it from anywhere in an environment that holds the package. It writes a picture for each beside itself, and
into the table the side of its pixels (mm), and the world point (mm, LPS) of a place in it.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

import lumencut
from lumencut import Camera, Settings, Vessel, Window, phantom
from lumencut.reformations.uncurling import fitted_uncurling

HERE = Path(__file__).parent


def filling(extent: tuple[float, float], size: list[int]) -> float:
    """The side of the pixels (mm) in which an extent (mm) fits into a pane."""
    return max(extent[0] / (size[0] - 2), extent[1] / (size[1] - 2), 0.05)


def spiral_of(scene: Any, vessel: Vessel, angle: float, size: list[int], settings: Settings) -> Any:
    """The spiral CPR whose rows are as long as a pane is wide."""
    side = filling((0.0, vessel.length), size)
    radius = 1.25 * float(vessel.radius.max()) + 2
    usual, finest = float(np.median(vessel.radius)), float(scene.volume.spacing.min())
    pitch = max(finest, usual / 4, math.pi * radius**2 / (size[0] * side))
    while True:
        made = lumencut.spiral(
            scene.volume, vessel, pitch, radius, "arc", side, angle, settings=settings, device="cpu"
        )
        if made.size[0] <= size[0]:
            return made
        pitch *= 1.01 * made.size[0] / size[0]


def made(scene: Any, asked: dict[str, Any], size: list[int], settings: Settings) -> Any:
    """The reformation that a message of the page asks for."""
    how: dict[str, Any] = {"settings": settings, "device": "cpu"}
    kind = asked["kind"]
    if kind == "untangled":
        side = asked["side"]
        camera = Camera((0, 0, 0), side["direction"], side["up"], tuple(size), 1.0)
        coarse = lumencut.untangled(scene.volume, scene.tree, camera, pixel_spacing=1.0, **how)
        places = np.concatenate([part.pixels for part in coarse.parts])
        extent = places.max(axis=0) + 25.0
        return lumencut.untangled(
            scene.volume, scene.tree, camera, pixel_spacing=filling(tuple(extent), size), **how
        )
    vessel = scene.tree[asked["vessel"]]
    if kind == "uncurl":
        side = asked["side"]
        camera = Camera((0, 0, 0), side["direction"], side["up"], tuple(size), 1.0)
        return lumencut.uncurl(scene.volume, vessel, fitted_uncurling(camera, vessel), asked["amount"], **how)
    if kind == "spiral":
        return spiral_of(scene, vessel, asked["angle"], size, settings)
    if kind == "endoscopy":
        how = {"backwards": asked["backwards"], "tree": scene.tree, "device": "cpu"}
        return lumencut.endoscopy(scene.volume, vessel, asked["at"], asked["lens"], size=tuple(size), **how)
    first = lumencut.lumen_map(scene.volume, vessel, asked["of"], tree=scene.tree, **how)
    side_of_pixels = filling((2 * math.pi * first.mean_radius, vessel.length), size)
    return lumencut.lumen_map(
        scene.volume, vessel, asked["of"], side_of_pixels, profile=first.profile, tree=scene.tree, **how
    )


def main() -> None:
    """Write the pictures, and complete the table."""
    path = HERE / "reformations.json"
    table = json.loads(path.read_text("utf-8"))
    settings = Settings(window=Window(*table["window"]))
    for row in table["reformations"]:
        scene = getattr(phantom, row["phantom"])()
        picture = made(scene, row["asked"], table["size"], settings)
        Image.fromarray(picture.image).save(HERE / f"{row['name']}.png", optimize=True)
        row["pixel_spacing"] = picture.pixel_spacing
        row["point"] = picture.world_from_pixel([row["pixel"]])[0].tolist()
    path.write_text(json.dumps(table, indent=2) + "\n", "utf-8")


if __name__ == "__main__":
    main()

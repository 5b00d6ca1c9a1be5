"""Render the views of `views.json` with the Python package: what the page must show.

Run it from anywhere in an environment that holds the package. It writes two pictures for each view beside
itself: with one sample for each pixel, and with two along each side.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from PIL import Image

import lumencut
from lumencut import Camera, Settings, Window, phantom

HERE = Path(__file__).parent


def rendered(view: dict[str, Any], size: tuple[int, int], samples: int) -> Image.Image:
    """The picture of a view."""
    scene = getattr(phantom, view["phantom"])()
    window = Window(*view["window"])
    # The context shows the same window as the vessels, as it does in the page.
    settings = Settings(window=window, context_window=window, samples=samples, **view["settings"])
    camera = Camera(size=size, **view["camera"])
    if view["method"] == "mpcpr":
        frame = lumencut.mpcpr(scene.volume, scene.tree, camera, settings, device="cpu")
    else:
        frame = lumencut.Renderer(scene.volume, scene.tree, "cpu").render(camera, settings)
    return Image.fromarray(frame.image)


def main() -> None:
    """Write the pictures."""
    table = json.loads((HERE / "views.json").read_text("utf-8"))
    for view in table["views"]:
        for samples in (1, 2):
            picture = rendered(view, tuple(table["size"]), samples)
            picture.save(HERE / f"{view['name']}-{samples}.png", optimize=True)


if __name__ == "__main__":
    main()

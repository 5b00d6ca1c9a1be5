"""Render the views of `views.json` and measure a phantom with the Python package: what the page must show.

Run it from anywhere in an environment that holds the package. It writes two pictures for each view beside
itself: with one sample for each pixel, and with two along each side. `measuring.json` and `measuring.csv`
hold what is measured of the phantom `stenosis`; `labels.json` the letters and scale bars of some views.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from PIL import Image

import lumencut
from lumencut import Camera, Settings, Window, _lumencut, phantom
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel, vessels_csv
from lumencut.scene.orientation import edges

HERE = Path(__file__).parent


def rendered(view: dict[str, Any], size: tuple[int, int], samples: int) -> Image.Image:
    """The picture of a view."""
    scene = getattr(phantom, view["phantom"])()
    window = Window(*view["window"])
    # Context and vessels share the window, as in the page.
    plain = {"edge_samples": 1}  # The page averages whole pictures instead.
    settings = Settings(window=window, context_window=window, samples=samples, **plain, **view["settings"])
    camera = Camera(size=size, **view["camera"])
    if view["method"] == "mpcpr":
        frame = lumencut.mpcpr(scene.volume, scene.tree, camera, settings, device="cpu")
    else:
        frame = lumencut.Renderer(scene.volume, scene.tree, "cpu").render(camera, settings)
    return Image.fromarray(frame.image)


def measured() -> None:
    """Write what is measured of the phantom with a narrowing of 50 %."""
    scene = phantom.stenosis()
    vessel = scene.tree[0]
    profile = lumencut.measure(scene.volume, vessel, tree=scene.tree)
    told = {
        "nascet": str(profile.stenosis(30.0, (10.0, 50.0))),
        "ecst": str(profile.stenosis(30.0, None, "ecst", 9.0)),
        "area": str(profile.stenosis(30.0, (10.0, 50.0), "area")),
        "narrowest": profile.narrowest(),
        "diameter": profile.diameter_at(profile.narrowest()[0]),
        "references": profile.suggested_references(profile.narrowest()[0]),
        "widest": profile.widest(),
    }
    (HERE / "measuring.json").write_text(json.dumps(told, indent=2) + "\n", "utf-8")
    marked = MeasuredVessel.of("0", vessel, profile, Marked(30.0, (10.0, 50.0)))
    table = vessels_csv([marked])
    (HERE / "measuring.csv").write_text(table, "utf-8")


#: Oblique views with different pixel sizes (mm), one along the body.
LAID = [
    {"center": [2, -1, 3], "direction": [0.48, 0.8, 0.36], "up": [-0.6, 0, 0.8], "pixel_spacing": 0.45},
    {"center": [0, 0, 0], "direction": [0, 0, -1], "up": [0, -1, 0], "pixel_spacing": 0.07},
    {"center": [0, 0, 0], "direction": [0.6, 0.64, 0.48], "up": [-0.8, 0.48, 0.36], "pixel_spacing": 1.3},
]


def labels(size: tuple[int, int] = (400, 300)) -> dict[str, Any]:
    """The letters at the edges of views and their scale bars."""
    found = []
    for view in LAID:
        camera = Camera(size=size, **view)
        _, words, pixels = _lumencut.scale_bar(size[0], camera.pixel_spacing)
        found.append({"camera": view, "letters": edges(camera), "words": words, "pixels": pixels})
    return {"size": size, "views": found}


def main() -> None:
    """Write the pictures, the numbers and the labels."""
    measured()
    (HERE / "labels.json").write_text(json.dumps(labels(), indent=2) + "\n", "utf-8")
    table = json.loads((HERE / "views.json").read_text("utf-8"))
    for view in table["views"]:
        for samples in (1, 2):
            picture = rendered(view, tuple(table["size"]), samples)
            picture.save(HERE / f"{view['name']}-{samples}.png", optimize=True)


if __name__ == "__main__":
    main()

"""Figures 1, 7 and 8 of the paper: scans by the cut surface and by earlier methods."""

from __future__ import annotations

import math

import numpy as np

from lumencut.evaluation.figures.drawing import Picture
from lumencut.evaluation.figures.figure import Figure, Panel
from lumencut.evaluation.figures.scenes import RULES, Scenes, settings_of
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.tree_reformations import MPCPR, cr_method
from lumencut.scene.camera import VIEWS, Camera
from lumencut.scene.settings import Settings

#: Radius offset and arc-length threshold of CR in the paper's pictures of about 1000 pixels.
_CR_OF_LEGS, _CR_OF_NECK, _PAPER_PIXELS = (150.0, 300.0), (50.0, 150.0), 1000.0
_UPWARDS = (0.0, 0.0, 1.0)


def bifurcation(scenes: Scenes) -> Figure:
    """Figure 1: a bifurcation of the aorta from three sides."""
    renderer = scenes.aorta
    scene, size = renderer.scene, scenes.size
    oblique = np.add(VIEWS["inferior"][0], VIEWS["right"][0])
    front = Camera.anterior(scene, size)
    views = [
        ("b", "From the front: the nearer branch hides part of the farther one.", front),
        (
            "c",
            "From below and the right: vessels are cut open at grazing angles too.",
            Camera.fitted(scene, oblique, _UPWARDS, size),
        ),
        (
            "d",
            "From below: a cutaway between both legs opens the view of the aorta.",
            Camera.inferior(scene, size),
        ),
    ]
    walls = {"": scenes.wireframe(renderer, front, "dvr")}
    panels = [Panel("a", "The whole volume (DVR), and the vessel walls as a wireframe.", walls)]
    for part, caption, camera in views:
        panels.append(Panel(part, caption, _by_both(renderer, camera)))
    shown = "the CT of the demo" if scenes.has_ct else "a phantom, as the CT of the demo was not available"
    return Figure("Figure 1", f"A bifurcation of the aorta: {shown}. The context is MIDA.", panels)


def bypass(scenes: Scenes) -> Figure:
    """Figure 7: a cross-over bypass between the legs by mpCPR, CR and CSR."""
    renderer = scenes.legs
    camera = Camera.anterior(renderer.scene, scenes.tall_size)
    turned = camera.rotated(math.radians(35)).rotated(math.radians(-25), "right")
    turned = Camera.fitted(renderer.scene, turned.direction, turned.up, scenes.tall_size)
    panels = [
        Panel("a", "mpCPR: the bypass runs along the rows, so it is thin.", _by_mpcpr(renderer, camera)),
        Panel(
            "b",
            "CR: the bypass has its width, but its discs break the tissue around it.",
            _by_cr(renderer, camera, _CR_OF_LEGS),
        ),
        Panel("c", "CSR: width and surroundings are whole.", _by_both(renderer, camera, context=None)),
        Panel("d", "CSR from above and the side, with MIDA as context.", _by_both(renderer, turned)),
    ]
    return Figure("Figure 7", "Vessels of the legs with a cross-over bypass: a phantom.", panels)


def neck(scenes: Scenes) -> Figure:
    """Figure 8: the vessels of the neck by mpCPR, CR and CSR."""
    renderer = scenes.neck
    camera = scenes.anterior(renderer)
    panels = [
        Panel("a", "mpCPR: farther vessels hide nearer ones.", _by_mpcpr(renderer, camera)),
        Panel("b", "CR: surroundings cut off vessels behind them.", _by_cr(renderer, camera, _CR_OF_NECK)),
        Panel("c", "CSR: nearer vessels lie in front.", _by_both(renderer, camera, context=None)),
    ]
    return Figure("Figure 8", "Vessels of the neck: a phantom.", panels)


def _by_both(renderer: Renderer, camera: Camera, **changes: object) -> dict[str, Picture]:
    return {
        rule: renderer.render(camera, settings_of(rule, **changes), images=["image"]).image[..., :3]
        for rule in RULES
    }


def _by_mpcpr(renderer: Renderer, camera: Camera) -> dict[str, Picture]:
    return {"": renderer._by(MPCPR, camera, _without_lines(), ["image"]).image[..., :3]}


def _by_cr(renderer: Renderer, camera: Camera, pixels: tuple[float, float]) -> dict[str, Picture]:
    scale = max(camera.size) / _PAPER_PIXELS
    offset, threshold = pixels
    method = cr_method(offset * scale, threshold * scale)
    return {"": renderer._by(method, camera, _without_lines(), ["image"]).image[..., :3]}


def _without_lines() -> Settings:
    """Return settings of pictures without silhouettes, which only CSR has in the paper."""
    return Settings(silhouettes=False, context=None)

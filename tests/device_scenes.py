"""Scenes and settings for the tests of the GPU, and renderers of them."""

from __future__ import annotations

import functools

from conftest import SHARED_DATA
from lumencut import (
    Camera,
    Opacity,
    Renderer,
    Settings,
    Slab,
    TransferFunction,
    phantom,
    read_centerlines,
    read_volume,
)

POINTS = TransferFunction([(100, (20, 200, 90), 0.0), (250, (250, 40, 10), 0.2), (900, (255, 250, 200), 0.9)])
SETTINGS = {
    "default": Settings(),
    "no context": Settings(context=None, silhouettes=False, depth_filter=False),
    "lumen first": Settings(lumen_first=True, lumen_margin=0.5, levels=0),
    "quiet centerlines": Settings(centerline_smoothing=0.5),
    "centerlines": Settings(preserve_lumen=False, cost_weight=3, levels=2),
    "slab mean": Settings(slab=Slab(4, "mean"), background=(10, 200, 30, 128)),
    "slab min": Settings(slab=Slab(3, "min"), context="average"),
    "dvr shaded": Settings(opacity=Opacity(50, 300), context="dvr", context_shading=True),
    "mida": Settings(opacity=Opacity(50, 300), context_gamma=0.4, context_transfer=POINTS),
    "preview": Settings(opacity=Opacity(50, 300), context_preview=True),
    "mip": Settings(opacity=Opacity(50, 300), context="mip", slab=Slab(5, "max")),
    "minip": Settings(opacity=Opacity(50, 300), context="minip"),
}
CONTEXTS = ("default", "dvr shaded", "mida", "preview", "mip", "minip", "slab min")


@functools.cache
def scene(name):
    """A volume and a tree."""
    if name == "stent":
        folder = SHARED_DATA / "stent-cta"
        return read_volume(folder / "stent_cta.nii.gz"), read_centerlines(folder / "centerlines.vtp", "lps")
    if name == "dissection":
        folder = SHARED_DATA / "dissection-cta"
        lines = read_centerlines(folder / "aorta_arch_centerlines_LPS.vtp", "lps")
        return read_volume(folder / "ct_cropped.nii.gz"), lines
    made = phantom.aorta(scale=0.25)
    return made.volume, made.tree


@functools.cache
def pair(name, with_tree=True):
    """Renderers of a scene on the GPU and on the CPU."""
    volume, tree = scene(name)
    return tuple(Renderer(volume, tree if with_tree else None, device) for device in ("gpu", "cpu"))


def oblique(scene, size):
    return Camera.fitted(scene, (0.4, 1.0, -0.3), (0.1, 0.2, 1), size)

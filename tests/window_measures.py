"""The part of the grey range that a window gives to each tissue, and the contrast of the lumen."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lumencut import Camera, Renderer, Settings, Window
from lumencut.scene.settings import ContextName
from window_scenes import BONE, FAT, LUMEN, SOFT, WALL, Angiography

PICTURE = (96, 96)

#: Weights of red, green and blue in the brightness of a colour (Rec. 709).
BRIGHTNESS = (0.2126, 0.7152, 0.0722)


def share(window: Window, values: npt.ArrayLike) -> float:
    """Return the median of some values within a window: 0 is black, 1 white; values may exceed both."""
    return float((np.median(np.asarray(values, np.float64)) - window.level) / window.width + 0.5)


def along_centerlines(scene: Angiography) -> npt.NDArray[np.float64]:
    """The voxels nearest to the points of the centerlines."""
    index = np.rint(np.concatenate([vessel.points for vessel in scene.tree])).astype(int)
    i, j, k = index.T
    return np.asarray(scene.array[i, j, k], np.float64)


def shares(scene: Angiography, window: Window) -> dict[str, float]:
    """Return the position of each tissue's median in the window; NaN if the angiography lacks the tissue."""
    near = _near_vessels(scene)
    masks = {
        "lumen": scene.labels == LUMEN,
        "wall": scene.labels == WALL,
        "tissue": np.isin(scene.labels, (SOFT, FAT)) & near,
        "bone": scene.labels == BONE,
        "background": scene.labels == 0,
    }
    values = {name: scene.array[mask] for name, mask in masks.items()}
    finite = {name: some[np.isfinite(some)] for name, some in values.items()}
    found = {name: share(window, some) if some.size else np.nan for name, some in finite.items()}
    return {"centerline": share(window, along_centerlines(scene)), **found}


def _near_vessels(scene: Angiography) -> npt.NDArray[np.bool_]:
    """Return the voxels within 6 mm of a lumen along each axis."""
    near: npt.NDArray[np.bool_] = scene.labels == LUMEN
    for axis in range(3):
        reach = [np.roll(near, step, axis) for step in range(-6, 7)]
        near = np.logical_or.reduce(reach)
    return near


def contrast(scene: Angiography, context: ContextName, window: Window | None = None) -> tuple[float, float]:
    """Return the brightness of the lumen and of its surroundings in a picture of only the volume, 0 to 1.

    Each is a median over pixels whose rays meet neither bone nor calcifications.
    """
    camera = Camera.left(scene.volume, PICTURE)
    frame = Renderer(scene.volume).render(camera, Settings(context=context, context_window=window))
    bright = frame.image[..., :3] @ np.array(BRIGHTNESS) / 255
    lumen = _seen(camera, scene.labels == LUMEN)
    hidden = _grown(_seen(camera, np.isin(scene.labels, scene.brighter)), 1)
    inside = _seen(camera, scene.labels != 0)
    beside = _grown(lumen, 10) & ~_grown(lumen, 3) & inside & ~hidden
    core = ~_grown(~lumen, 1) & ~hidden
    assert core.sum() > 20 < beside.sum(), scene.name
    return float(np.median(bright[core])), float(np.median(bright[beside]))


def background(scene: Angiography, context: ContextName, window: Window | None = None) -> float:
    """Return the median brightness of rays that meet only the darkest value, 0 to 1."""
    camera = Camera.left(scene.volume, PICTURE)
    frame = Renderer(scene.volume).render(camera, Settings(context=context, context_window=window))
    bright = frame.image[..., :3] @ np.array(BRIGHTNESS) / 255
    shown = _grown(_seen(camera, scene.array > np.min(scene.array)), 3)
    alone = _seen(camera, np.ones(scene.array.shape, bool)) & ~shown
    assert alone.sum() > 20, scene.name
    return float(np.median(bright[alone]))


def _seen(camera: Camera, mask: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Return the pixels whose rays pass through some voxels."""
    place = np.rint(camera.project(np.argwhere(mask).astype(np.float64))[:, :2]).astype(int)
    seen = np.zeros(camera.size[::-1], bool)
    inside = ((place >= 0) & (place < camera.size)).all(axis=1)
    seen[place[inside, 1], place[inside, 0]] = True
    # Pixels are smaller than voxels.
    return ~_grown(~_grown(seen, 1), 1)


def _grown(mask: npt.NDArray[np.bool_], pixels: int) -> npt.NDArray[np.bool_]:
    """Return the mask, widened by some pixels along both axes."""
    for axis in range(2):
        mask = np.any([np.roll(mask, step, axis) for step in range(-pixels, pixels + 1)], axis=0)
    return mask

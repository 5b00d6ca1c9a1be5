"""The scenes of the list of frames: volumes and vessel trees, reproducible on every run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import Vessel, VesselTree, Volume, phantom, read_centerlines, read_volume
from scenes import lattice, nearly_along_y, wandering

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"
"""Real volumes and their centerlines; a scene whose files are not there has no frames."""
REAL = {
    "stent": ("stent-cta/stent_cta.nii.gz", "stent-cta/centerlines.vtp"),
    "dissection": ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/aorta_arch_centerlines_LPS.vtp"),
    "aorta-mra": ("aorta-mra/aorta.mha", "aorta-mra/aorta_full_centerlines_LPS.vtp"),
}
SMALL = ("straight_tube", "helix", "y_junction", "crossing", "trefoil", "collinear_run", "calcified_wall")
"""The phantoms that are made without a choice."""
WORKLOADS = {"aorta": 0.25, "runoff": 0.1, "cervical": 0.12}
"""The phantoms of clinical size, and the scale at which they are small."""
STENOSES = (0, 50, 90)
"""Percent of the diameter that the phantom of a stenosis loses."""
DTYPES = {
    **{name: name for name in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8", "bool")},
    "big-endian i2": ">i2",
    "big-endian f8": ">f8",
}
"""The types of voxels."""
RANGES = {"i1": (-128, 128), "i2": (-32768, 32768), "u4": (0, 2**32), "i8": (-(10**11), 10**11)}
"""Types whose voxels lie between two ends, more than the mantissa of a 32-bit float holds among them."""
GRIDS = {
    "isotropic": np.eye(3),
    "anisotropic": np.diag([0.6, 0.9, 2.3]),
    "left-handed": np.diag([1.1, 0.8, -1.7]),
    "axes permuted": np.array([[0.0, 0.0, 1.3], [1.1, 0.0, 0.0], [0.0, -0.9, 0.0]]),
    "oblique": np.array([[0.8, -0.6, 0.0], [0.48, 0.64, -0.6], [0.36, 0.48, 0.8]]),
    "sheared": np.array([[1.0, 0.4, -0.1], [-0.2, 1.2, 0.3], [0.2, 0.0, -1.5]]),
}
"""Columns of the affine: mm per index along i, j, k."""


@dataclass(frozen=True)
class Scene:
    """The arguments of a renderer."""

    volume: Volume | None
    tree: VesselTree | None


def placed(array: npt.NDArray[Any], columns: npt.NDArray[np.float64]) -> Volume:
    """A volume on the grid of these columns, its middle at (3, -40, 12) mm."""
    affine = np.eye(4)
    middle = (np.array(array.shape[::-1]) - 1) / 2
    affine[:3, :3], affine[:3, 3] = columns, np.array([3.0, -40.0, 12.0]) - columns @ middle
    return Volume(array, world_from_index=affine)


def through(volume: Volume) -> VesselTree:
    """Two vessels that wind through a volume and leave it at their ends."""
    t = np.linspace(-0.1, 1.1, 50)
    size = np.array(volume.size) - 1.0
    made = []
    for phase, radius in ((0.0, 1.0), (2.2, 0.6)):
        waves = [0.5 + 0.35 * np.cos(5 * t + phase), 0.5 + 0.3 * np.sin(4 * t + phase), t]
        points = np.stack(waves, axis=1) * size
        world = points @ volume.world_from_index[:3, :3].T + volume.world_from_index[:3, 3]
        made.append(Vessel(world, radius))
    return VesselTree(made)


def noise(dtype: str, shape: tuple[int, int, int] = (14, 9, 12)) -> npt.NDArray[Any]:
    """Voxels of this type from 0 to 100, or True and False."""
    values = np.random.default_rng(3).uniform(0, 100, shape)
    return values > 50 if dtype == "bool" else values.astype(dtype)


def with_lines(volume: Volume) -> Scene:
    """The volume and vessels through it."""
    return Scene(volume, through(volume))


def damaged(value: float) -> npt.NDArray[np.float32]:
    """Noise with one value here and there, and all over one corner."""
    array: npt.NDArray[np.float32] = noise("f4", (19, 21, 23))
    array.reshape(-1)[::37] = value
    array[:8, :8, :8] = value
    return array


ARRAYS: dict[str, Callable[[], npt.NDArray[Any]]] = {
    "reversed axes": lambda: noise("i2")[::-1, :, ::-1],
    "column order": lambda: np.asfortranarray(noise("i2")),
    "axes swapped": lambda: noise("f4").transpose(1, 2, 0),
    "every second": lambda: noise("u2", (20, 20, 20))[::2, ::2, ::2],
    "some NaN": lambda: damaged(np.nan),
    "only NaN": lambda: np.full((9, 8, 7), np.nan, np.float32),
    "some infinite": lambda: damaged(np.inf),
    "huge values": lambda: 1e30 * noise("f4"),
    "tiny values": lambda: 1e-30 * noise("f8"),
    "one value": lambda: np.full((9, 8, 7), 40, np.int16),
    "one slice": lambda: noise("i2", (1, 20, 20)),
    "one column": lambda: noise("i2", (20, 1, 1)),
    "one voxel": lambda: noise("i2", (1, 1, 1)),
}
"""Arrays that are unusual in their values, their size or their place in memory."""


def reshaped(change: Callable[[Vessel], Vessel]) -> VesselTree:
    """Some smooth vessels, every second one changed."""
    return VesselTree(change(one) if n % 2 else one for n, one in enumerate(wandering(5)))


def _circle() -> VesselTree:
    angle = np.linspace(0, 2 * np.pi, 61)
    points = 20 * np.stack([np.cos(angle), 0.3 * np.sin(2 * angle), np.sin(angle)], axis=1)
    points[-1] = points[0]
    return VesselTree([Vessel(points, 2.0)])


TREES: dict[str, Callable[[], VesselTree]] = {
    "wandering": lambda: wandering(3),
    "many vessels": lambda: wandering(7, vessels=40, points=60),
    "lattice": lambda: lattice(2),
    "nearly along y": lambda: nearly_along_y(4),
    "no radii": lambda: VesselTree(Vessel(one.points) for one in wandering(5)),
    "some radii": lambda: reshaped(lambda one: Vessel(one.points)),
    "radii of zero": lambda: reshaped(lambda one: Vessel(one.points, 0.0)),
    "wide": lambda: reshaped(lambda one: Vessel(one.points, 30.0)),
    "points repeated": lambda: reshaped(lambda one: Vessel(np.repeat(one.points, 3, axis=0), 1.5)),
    "vessels repeated": lambda: VesselTree([*wandering(5), *wandering(5)]),
    "loop": _circle,
    "one segment": lambda: VesselTree([Vessel([(0, 0, 0), (3, 4, 5)], (1, 2))]),
    "end-on": lambda: VesselTree([Vessel([(0, n, 0) for n in range(9)], 2.0)]),
    "far away": lambda: VesselTree(Vessel(one.points + 9e5, one.radius) for one in wandering(5)),
}
"""Trees without a volume."""


def _phantom(name: str, **values: float) -> Scene:
    made: phantom.Phantom = getattr(phantom, name)(**values)
    return Scene(made.volume, made.tree)


def _of_type(name: str) -> Scene:
    return with_lines(placed(noise(DTYPES[name]), GRIDS["sheared"]))


def _in_range(dtype: str) -> Scene:
    random = np.random.default_rng(4)
    array = random.integers(*RANGES[dtype], (11, 14, 12), np.int64).astype(dtype)
    return with_lines(placed(array, GRIDS["oblique"]))


def _on_grid(name: str) -> Scene:
    return with_lines(placed(noise("f4", (19, 21, 23)), GRIDS[name]))


def _unusual(name: str) -> Scene:
    return with_lines(placed(ARRAYS[name](), GRIDS["anisotropic"]))


def _tree(name: str) -> Scene:
    return Scene(None, TREES[name]())


def _real(files: tuple[str, str]) -> Scene | None:
    volume, lines = (DATA / name for name in files)
    if not (volume.is_file() and lines.is_file()):
        return None
    return Scene(read_volume(volume), read_centerlines(lines, "lps"))


def _makers() -> dict[str, Callable[[], Scene | None]]:
    return {
        **{name: partial(_phantom, name) for name in SMALL},
        **{f"stenosis {percent}": partial(_phantom, "stenosis", percent=percent) for percent in STENOSES},
        **{name: partial(_phantom, name, scale=scale) for name, scale in WORKLOADS.items()},
        **{f"voxels {name}": partial(_of_type, name) for name in DTYPES},
        **{f"range of {name}": partial(_in_range, name) for name in RANGES},
        **{f"grid {name}": partial(_on_grid, name) for name in GRIDS},
        **{f"array {name}": partial(_unusual, name) for name in ARRAYS},
        **{f"tree {name}": partial(_tree, name) for name in TREES},
        **{name: partial(_real, files) for name, files in REAL.items()},
    }


SCENES = _makers()
"""How each scene is made, by its name."""


@cache
def scene(name: str) -> Scene | None:
    """The scene of this name, or None if its files do not exist."""
    return SCENES[name]()

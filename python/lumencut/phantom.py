"""Synthetic scenes with known truth: volume, vessel tree, radii, stenoses and plaques.

Small phantoms (`straight_tube`, `helix`, `y_junction`, `crossing`, `trefoil`, `collinear_run`, `stenosis`,
`calcified_wall`) have closed-form answers: tubes in fat, no noise, voxels of 0.5 mm. `airways` has dark
lumens in lung. Three workloads (`aorta`, `runoff`, `cervical`) have the sizes of Table 2 of Auzinger et
al., IEEE TVCG 19(12), 2013, doi:10.1109/TVCG.2013.215, and resemble CT angiographies.

The lumen has 350 HU (-1000 HU in `airways`), the vessel wall 60 HU, soft plaque 40 HU and calcifications
1000 HU; fat around the small phantoms has -100 HU. Edges are ramps one voxel wide, centred on the true
surface. The wall is 0.5 mm + 8 % of the reference radius thick. A lumen is the union of its segments: rods
with round ends whose radius is linear between points.
"""

from __future__ import annotations

from dataclasses import dataclass
from operator import index
from typing import Literal

import numpy as np
import numpy.typing as npt

from lumencut._lumencut import make_phantom
from lumencut.errors import SettingsError
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

__all__ = [
    "Phantom",
    "Plaque",
    "Stenosis",
    "airways",
    "aorta",
    "calcified_wall",
    "cervical",
    "collinear_run",
    "crossing",
    "helix",
    "runoff",
    "stenosis",
    "straight_tube",
    "trefoil",
    "y_junction",
]


@dataclass(frozen=True)
class Stenosis:
    """A narrowing of the lumen, concentric with the centerline.

    The radius is smallest over the middle two fifths of the length. On both sides it widens to the reference
    radius along half a cosine.

    Attributes
    ----------
    vessel : int
        Index of the vessel in the tree.
    arc_length : float
        Position of its middle along the vessel (mm from the first point).
    length : float
        Its length along the vessel (mm).
    percent : float
        Reduction of the diameter at its middle (percent of the reference diameter).

    """

    vessel: int
    arc_length: float
    length: float
    percent: float


@dataclass(frozen=True)
class Plaque:
    """A plaque in the wall of a vessel.

    Attributes
    ----------
    vessel : int
        Index of the vessel in the tree.
    arc_length : float
        Position of its middle along the vessel (mm from the first point).
    kind : {"soft", "calcified"}
        Soft plaque fills the space between the lumen and the reference radius; a calcification lies against
        the outside of the lumen.
    angle : float
        Direction of its middle around the vessel (radians): 0 is the perpendicular direction nearest to
        anterior (to superior if the vessel runs anteriorly or posteriorly); right-handed about the vessel's
        direction.
    length : float
        Its length along the vessel (mm).
    angular_extent : float
        Its extent around the vessel (radians), 2π for a whole ring.
    thickness : float
        Its thickness across the wall at its middle (mm).
    position : tuple of 3 float
        Its middle (mm, LPS); on the centerline for a whole ring.

    """

    vessel: int
    arc_length: float
    kind: Literal["soft", "calcified"]
    angle: float
    length: float
    angular_extent: float
    thickness: float
    position: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Phantom:
    """A volume and its vessel tree, with the truth about them.

    Attributes
    ----------
    name : str
        Its name, that of the function that makes it.
    volume : Volume
        Voxels of type int16 (HU) on an axis-aligned grid.
    tree : VesselTree
        The vessels (mm, LPS) with the true lumen radius (mm) and names. Connected vessels share identical end
        points.
    reference_radius : tuple of ndarray, each of shape (n,), float64
        The healthy lumen radius at each point of each vessel (mm).
    stenoses : tuple of Stenosis
        All stenoses.
    plaques : tuple of Plaque
        All plaques.

    """

    name: str
    volume: Volume
    tree: VesselTree
    reference_radius: tuple[npt.NDArray[np.float64], ...]
    stenoses: tuple[Stenosis, ...]
    plaques: tuple[Plaque, ...]


def straight_tube() -> Phantom:
    """One tube of radius 4 mm along z, from (0, 0, -30) to (0, 0, 30), 60 segments of 1 mm."""
    return _phantom("straight_tube")


def helix() -> Phantom:
    """One tube of radius 3 mm along (20 cos t, 20 sin t, 30 t / 2π - 30), two turns, 240 segments."""
    return _phantom("helix")


def y_junction() -> Phantom:
    """Three tubes that share the end point (0, 0, 0).

    A trunk of radius 5 mm from (0, 0, -30) and two branches of radius 4 mm to (±20, 0, 30).
    """
    return _phantom("y_junction")


def crossing() -> Phantom:
    """Two straight tubes of radius 3 mm that cross in the anterior view, 20 mm apart in depth.

    "front" runs along x at y = -10, "back" along z at y = 10.
    """
    return _phantom("crossing")


def trefoil() -> Phantom:
    """A closed trefoil knot of radius 3 mm that crosses itself three times in the anterior view.

    10·(sin t + 2 sin 2t, -sin 3t, cos t - 2 cos 2t) in 300 segments; the last point is the first.
    """
    return _phantom("trefoil")


def collinear_run() -> Phantom:
    """Two tubes of radius 3 mm with segments along the axis of the anterior view.

    "bend" runs up along z, 40 mm backwards along y, then up again; "end-on" runs along y only and is a point
    in that view.
    """
    return _phantom("collinear_run")


def stenosis(percent: float = 50.0) -> Phantom:
    """One tube of radius 4 mm along z, from z = -30 to 30, narrowed around z = 0 by soft plaque 16 mm long.

    Parameters
    ----------
    percent : float, default 50
        Reduction of the diameter (percent), at least 0 and below 100.

    Raises
    ------
    SettingsError
        For a percentage outside this range.

    """
    return _phantom("stenosis", percent=percent)


def calcified_wall() -> Phantom:
    """One tube of radius 4 mm along z, from z = -30 to 30, with a calcification at z = 0.

    It is 2 mm thick, 8 mm long and one radian wide, on the outside of the lumen towards the patient's left.
    """
    return _phantom("calcified_wall")


def airways() -> Phantom:
    """Airways in lung: six generations, each airway with a wider and a narrower branch.

    Lumens of -1000 HU have radii from 6 to 1.3 mm and walls of 60 HU, 1 to 1.5 mm thick; lung has -850 HU,
    the noise is 15 HU, and voxels have 0.7 mm. The walls of the airways "1.2" and "2.1.1" have a place of
    4 mm where they are only 0.2 mm thick.
    """
    return _phantom("airways")


def aorta(seed: int = 0, *, scale: float = 1.0) -> Phantom:
    """Abdominal aorta with coeliac, mesenteric, renal and iliac arteries (paper Fig. 1).

    512 x 512 x 256 voxels of 0.75 x 0.75 x 1 mm, about 800 segments.

    Parameters
    ----------
    seed : int, default 0
        Varies the bends, calcifications and noise. The same seed gives the same bytes.
    scale : float, default 1
        Multiplies the number of voxels along each axis, 0.02 to 2; field of view and tree do not change.

    Raises
    ------
    SettingsError
        If the seed is not an unsigned 64-bit integer, or the scale is out of range.

    """
    return _phantom("aorta", seed=seed, scale=scale)


def runoff(seed: int = 0, *, scale: float = 1.0) -> Phantom:
    """Arteries of the lower extremities with a femoro-femoral cross-over bypass (paper Fig. 7).

    512 x 512 x 1305 voxels of 0.75 x 0.75 x 1 mm (684 MB), about 2,200 segments, from the aorta to the
    feet. The bypass avoids an occlusive stenosis of the left iliac artery and closes a cycle.

    Parameters
    ----------
    seed, scale
        As for `aorta`.

    Raises
    ------
    SettingsError
        As for `aorta`.

    """
    return _phantom("runoff", seed=seed, scale=scale)


def cervical(seed: int = 0, *, scale: float = 1.0) -> Phantom:
    """Cervical arteries from the aortic arch to the circle of Willis (paper Fig. 8).

    512 x 512 x 575 voxels of 0.75 x 0.75 x 0.7 mm, about 1,100 segments. Both vertebral arteries meet in
    the basilar artery.

    Parameters
    ----------
    seed, scale
        As for `aorta`.

    Raises
    ------
    SettingsError
        As for `aorta`.

    """
    return _phantom("cervical", seed=seed, scale=scale)


def _phantom(name: str, *, percent: float = 50.0, seed: int = 0, scale: float = 1.0) -> Phantom:
    made = make_phantom(name, percent=float(percent), seed=_checked_seed(seed), scale=float(scale))
    return Phantom(
        name=made["name"],
        volume=Volume(made["array"], world_from_index=made["world_from_index"]),
        tree=VesselTree(
            [Vessel(points, radius=radius, name=name) for points, radius, name in made["vessels"]]
        ),
        reference_radius=tuple(made["reference_radius"]),
        stenoses=tuple(Stenosis(**stenosis) for stenosis in made["stenoses"]),
        plaques=tuple(Plaque(**plaque) for plaque in made["plaques"]),
    )


def _checked_seed(seed: int) -> int:
    try:
        number = index(seed)
    except TypeError:
        number = -1
    if not 0 <= number < 2**64:
        raise SettingsError("seed", f"{seed!r}", "an integer from 0 to 2**64 - 1")
    return number

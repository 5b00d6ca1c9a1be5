"""Suggested names of vessels, by a short list of rules about anatomy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from lumencut import _lumencut
from lumencut.base.pickles import by_name
from lumencut.errors import VesselTreeError
from lumencut.scene.images import as_volume
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume


@by_name
@dataclass(frozen=True)
class SuggestedName:
    """What the rules suggest for one vessel; see :func:`lumencut.suggest_names`.

    Attributes
    ----------
    name : str or None
        A name for a reader to confirm; None if the rules are not sure. A vessel that runs on into another
        one has both names: ``"Abdominal aorta to right external iliac artery"``.
    stretches : tuple of (str, float, float)
        The named parts of the vessel: name, and the arc lengths of their ends (mm).
    is_vein_or_heart : bool
        Whether the vessel seems to be a vein or part of the heart.
    """

    name: str | None
    stretches: tuple[tuple[str, float, float], ...]
    is_vein_or_heart: bool


def suggest_names(tree: VesselTree, volume: Volume | Any = None) -> tuple[SuggestedName, ...]:
    """Suggest names for the vessels of a tree. It changes no name.

    The rules use the place, course, width and branches of the vessels: the aorta with its bifurcation or the
    branches of its arch; its visceral, renal and iliac branches; carotid, subclavian and vertebral arteries.
    Sides are the patient's. Vessels about which the rules are not sure get no name.

    Parameters
    ----------
    tree : VesselTree
        Vessels that meet, with radii; a vessel without radii gets no name.
    volume : Volume, or anything :func:`lumencut.render` takes as one, optional
        The scan. With it, vessels that are brighter or paler than the aorta are suggested to be veins or the
        heart.

    Returns
    -------
    tuple of SuggestedName
        One for each vessel.

    Raises
    ------
    VesselTreeError
        For anything but a tree.
    VolumeError
        For anything that is not a volume.
    """
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("vessel tree", type(tree).__name__, "a VesselTree")
    arrays = [(vessel.points, vessel.radius) for vessel in tree]
    found = _lumencut.suggest_names(arrays, None if volume is None else as_volume(volume))
    return tuple(
        SuggestedName(name, tuple((word, *ends) for word, ends in stretches), is_vein)
        for name, stretches, is_vein in found
    )

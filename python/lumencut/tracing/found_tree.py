"""The tree of found vessels, with the doubtful ones separate."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lumencut.base.checks import number
from lumencut.errors import SettingsError
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree

_Array = npt.NDArray[np.float64]


def checked_radius(smallest_radius: float) -> float:
    """Return the checked smallest radius of vessels to find (mm)."""
    smallest = number(SettingsError, "smallest_radius", smallest_radius)
    if not 0 <= smallest < float("inf"):
        raise SettingsError("smallest_radius", f"{smallest:g}", "0 or more (mm)")
    return smallest


def found_tree(
    vessels: list[tuple[_Array, _Array, _Array, str]], parts: list[list[int]], notes: list[str]
) -> VesselTree:
    """Return the tree of the certain vessels; it also stores the doubtful ones, the parts and the notes."""
    made = [
        (Vessel(points, radius, confidence=confidence), doubt)
        for points, radius, confidence, doubt in vessels
    ]
    tree = VesselTree(vessel for vessel, doubt in made if not doubt)
    tree._doubtful = tuple(vessel for vessel, doubt in made if doubt)
    tree._doubts = tuple(doubt for _, doubt in made if doubt)
    tree._parts = tuple(map(tuple, parts))
    tree._notes = tuple(notes)
    return tree

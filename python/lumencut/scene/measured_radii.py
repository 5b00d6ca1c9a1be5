"""Measured radii of the vessels of a tree, and notes on them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import number
from lumencut.base.wording import counted
from lumencut.errors import SettingsError
from lumencut.scene.images import as_volume
from lumencut.scene.wall_level import Wall, wall_level

_Floats = npt.NDArray[np.float64]


def measured_radii(
    volume: Any,
    vessels: list[tuple[_Floats, _Floats | None]],
    step: float,
    fwhm: float | None,
    wall: Wall,
    progress: Callable[[int, int], object] | None,
) -> tuple[list[_Floats | None], list[str]]:
    """Return the radii of each vessel, and a sentence for each vessel that was measured only in part."""
    found = _lumencut.measured_radii(
        as_volume(volume),
        vessels,
        number(SettingsError, "step", step),
        None if fwhm is None else number(SettingsError, "fwhm", fwhm),
        wall_level(wall),
        progress,
    )
    notes = [
        f"vessel {n}: the radius of {counted(kept, 'point')} of {kept + measured} was not measured"
        for n, (_, measured, kept) in enumerate(found)
        if kept
    ]
    return [radius for radius, _, _ in found], notes

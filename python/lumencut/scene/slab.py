"""Slabs: the thickness of the cut surface, and which value of this thickness is shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from lumencut import _lumencut
from lumencut.base.checks import choice, number
from lumencut.base.pickles import by_name
from lumencut.errors import SettingsError


@by_name
@dataclass(frozen=True)
class Slab:
    """A thick cut surface.

    Parameters
    ----------
    thickness : float
        The thickness along the view direction, centred on the cut surface (mm, 0 to 1000): 4 mm show what
        is up to 2 mm before and 2 mm behind.
    mode : {"max", "mean", "min"}, default "max"
        The value along the view direction that is shown.

    Raises
    ------
    SettingsError
        For a thickness out of range or an unknown mode.
    """

    thickness: float
    mode: Literal["max", "mean", "min"] = "max"

    def __post_init__(self) -> None:
        object.__setattr__(self, "thickness", number(SettingsError, "slab thickness", self.thickness))
        choice(SettingsError, "slab mode", self.mode, _lumencut.SETTINGS["slab"].choices)
        _lumencut.check_slab(self.thickness, self.mode)

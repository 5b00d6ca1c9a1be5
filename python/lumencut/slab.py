"""Slabs: how thick the cut surface is, and what is shown of its thickness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from lumencut import _lumencut
from lumencut._checks import choice, number
from lumencut._pickles import by_name
from lumencut.errors import SettingsError


@by_name
@dataclass(frozen=True)
class Slab:
    """A thick cut surface.

    Parameters
    ----------
    thickness : float
        The whole slab along the view direction, the cut surface in its middle (mm, 0 to 1000): 4 mm show what
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

"""The focus: how far around the vessels the cut surface is shown, and how it fades into the context."""

from __future__ import annotations

from dataclasses import dataclass

from lumencut import _lumencut
from lumencut.base.checks import number
from lumencut.base.pickles import by_name
from lumencut.errors import SettingsError


@by_name
@dataclass(frozen=True)
class Focus:
    """The cut surface near the vessels, within the context (after the VesselGlyph of Straka et al. 2004).

    Both lengths are measured in the picture, from the nearest wall of any vessel.

    Parameters
    ----------
    margin : float, default 2.0
        Distance beyond the nearest wall up to which the cut surface is fully shown (mm, -1000000 to 1000000).
        If negative, lumens fade too.
    fade : float, default 6.0
        Further distance over which the cut surface fades into the context (mm, 0 to 1000000). 0 is a hard
        edge; any other fade is at least two pixels wide.

    Raises
    ------
    SettingsError
        For a length out of range.
    """

    margin: float = 2.0
    fade: float = 6.0

    def __post_init__(self) -> None:
        for name in ("margin", "fade"):
            object.__setattr__(self, name, number(SettingsError, f"focus {name}", getattr(self, name)))
        _lumencut.check_focus(self.margin, self.fade)

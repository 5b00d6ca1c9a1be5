"""Diameters, areas and stenoses of vessels, with their uncertainties.

All names are names of `lumencut` too.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lumencut.base.public_names import public_name

if TYPE_CHECKING:
    from lumencut.measuring.comparison import Change, Comparison, compare_scans
    from lumencut.measuring.flags import Flag
    from lumencut.measuring.measurements import Measurements
    from lumencut.measuring.profile import Profile
    from lumencut.measuring.sections import CrossSection, cross_section, measure
    from lumencut.measuring.stenosis import Stenosis

__all__ = [
    "Change",
    "Comparison",
    "CrossSection",
    "Flag",
    "Measurements",
    "Profile",
    "Stenosis",
    "compare_scans",
    "cross_section",
    "measure",
]


def __getattr__(name: str) -> Any:
    return public_name(__name__, __all__, name)

"""Whether lumen is brighter or darker than the tissue around it, as an argument of a public function."""

from __future__ import annotations

import copy
from typing import Any, Literal, TypeAlias

from lumencut.base.checks import choice
from lumencut.errors import SettingsError
from lumencut.scene.volume import Volume

Polarity: TypeAlias = Literal["bright", "dark"]

#: The names of the core.
POLARITIES = ("bright", "dark")


def traced_volume(volume: Volume, polarity: Any) -> Volume:
    """Return the volume in which lumen of this polarity is traced; it shares the voxels.

    Raises
    ------
    SettingsError
        For another polarity.
    """
    choice(SettingsError, "polarity", polarity, POLARITIES)
    if volume._polarity == polarity:
        return volume
    traced = copy.copy(volume)
    traced._polarity = polarity
    return traced

"""The level of the walls of vessels, as a caller gives it."""

from __future__ import annotations

from typing import Literal, TypeAlias

from lumencut._checks import choice, numbers
from lumencut.errors import SettingsError

#: Level and standard deviation in the unit of the volume; "off" for no wall; None for the default in CT.
Wall: TypeAlias = tuple[float, float] | Literal["off"] | None


def wall_level(wall: Wall) -> tuple[float, float] | None:
    """Return the wall level for the core; a standard deviation of 0 means no distinct walls.

    Raises
    ------
    SettingsError
        For another word, or a level or a standard deviation that is invalid.
    """
    if wall is None:
        return None
    if isinstance(wall, str):
        choice(SettingsError, "wall", wall, ("off",), " or a level and its standard deviation")
        return (0.0, 0.0)
    level, deviation = numbers(SettingsError, "wall", wall, (2,))
    if not deviation > 0:
        expected = 'a standard deviation above 0, or "off"'
        raise SettingsError("wall", f"{level} ± {deviation}", expected)
    return (float(level), float(deviation))

"""The brightness of the walls of vessels, as an argument of a public function."""

from __future__ import annotations

from typing import Literal, TypeAlias

from lumencut.base.checks import choice, numbers
from lumencut.errors import SettingsError

#: Level and its standard deviation in the unit of the volume; "off": no walls; None: the default for CT.
Wall: TypeAlias = tuple[float, float] | Literal["off"] | None


def wall_level(wall: Wall) -> tuple[float, float] | None:
    """Return the wall level in the form of the core; a standard deviation of 0 means no distinct walls.

    Raises
    ------
    SettingsError
        For an unknown word, or an invalid level or standard deviation.
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

"""Transfer functions: the colour and the opacity that an intensity has in the context."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from lumencut import _lumencut
from lumencut.base.checks import integers, number
from lumencut.base.pickles import by_name
from lumencut.errors import SettingsError

ControlPoint: TypeAlias = tuple[float, tuple[int, int, int], float]


@by_name
@dataclass(frozen=True)
class TransferFunction:
    """Colour and opacity by intensity: linear between control points, constant beyond the outermost ones.

    Parameters
    ----------
    points : sequence of (float, (int, int, int), float), 1 to 64 of them
        For each control point its intensity (the volume's unit, HU for CT), its colour (RGB, 0 to 255) and
        the opacity of one millimetre of it (0 to 1). Intensities must rise; two equal ones make a step.

    Raises
    ------
    SettingsError
        For no points or too many, intensities that fall, or numbers out of range.
    """

    points: tuple[ControlPoint, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", _checked(self.points))
        _lumencut.check_transfer_function(self.points)


def _checked(points: Any) -> tuple[ControlPoint, ...]:
    expected = "control points (intensity, (r, g, b), opacity)"
    if isinstance(points, str) or not isinstance(points, Sequence):
        raise SettingsError(
            "points of the transfer function", type(points).__name__, f"a sequence of {expected}"
        )
    made = []
    for count, point in enumerate(points, 1):
        name = f"control point {count} of the transfer function"
        if isinstance(point, str) or not isinstance(point, Sequence) or len(point) != 3:
            raise SettingsError(name, f"{point!r:.80}", f"one of the {expected}")
        red, green, blue = integers(SettingsError, f"colour of {name}", point[1], 0, 255, 3)
        intensity = number(SettingsError, f"intensity of {name}", point[0])
        made.append((intensity, (red, green, blue), number(SettingsError, f"opacity of {name}", point[2])))
    return tuple(made)

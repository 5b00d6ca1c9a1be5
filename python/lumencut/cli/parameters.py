"""Types of options: vectors, sizes, colours, slabs and transfer functions, each written as one word."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias

import click

if TYPE_CHECKING:
    _Type = click.ParamType[Any]
else:
    _Type = click.ParamType

_Parameter: TypeAlias = "click.Parameter | None"
_Context: TypeAlias = "click.Context | None"


#: Bytes of each unit of memory.
BYTES = {"": 1, "k": 1 << 10, "m": 1 << 20, "g": 1 << 30, "t": 1 << 40}

#: The names of ``lumencut.scene.window.WINDOW_NAMES``; copied so that ``--help`` does not import numpy.
WINDOW_NAMES = ("auto", "cta", "soft-tissue", "bone", "lung", "full", "mra", "stent", "sac")


class Parts(_Type):
    """Numbers with a separator between them; ``form`` shows the user how to write them."""

    def __init__(self, form: str, separator: str, kind: type[float] | type[int]) -> None:
        self.name, self._separator, self._kind = form, separator, kind

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> tuple[float, ...]:
        """Return the numbers."""
        if not isinstance(value, str):
            return tuple(value)
        try:
            numbers = tuple(self._kind(part) for part in value.lower().split(self._separator))
        except ValueError:
            numbers = ()
        count = self.name.lower().count(self._separator) + 1
        if len(numbers) != count or not all(math.isfinite(number) for number in numbers):
            self.fail(f"{value!r} is not of the form {self.name}", param, ctx)
        return numbers


class NumberOrNone(_Type):
    """A number, or the word none."""

    name = "NUMBER|none"

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> float | str:
        """Return the number, or the word."""
        if value == "none":
            return "none"
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor none", param, ctx)


class Places(_Type):
    """One or two places on a vessel, as arc lengths in mm."""

    name = "MM[,MM]"

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> tuple[float, ...]:
        """Return the one or two arc lengths."""
        if not isinstance(value, str):
            return tuple(value)
        try:
            places = tuple(float(part) for part in value.split(","))
        except ValueError:
            places = ()
        if not 1 <= len(places) <= 2 or not all(math.isfinite(place) for place in places):
            self.fail(f"{value!r} is not of the form {self.name}, such as 12.5 or 3,40", param, ctx)
        return places


class PlaceOnVessel(_Type):
    """A place on a vessel: the name or id of the vessel, and an arc length in mm."""

    name = "NAME|ID@MM"

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> tuple[str, float]:
        """Return the name or id of the vessel, and the arc length."""
        if not isinstance(value, str):
            return tuple(value)
        word, _, place = value.rpartition("@")
        try:
            at = float(place.lower().removesuffix("mm"))
        except ValueError:
            at = math.nan
        if not (word and math.isfinite(at)):
            self.fail(f"{value!r} is not of the form {self.name}, such as LAD@41mm", param, ctx)
        return word, at


class WallOption(Parts):
    """The level of vessel walls with its standard deviation, "off" for no walls, or "auto"."""

    def __init__(self) -> None:
        super().__init__("LEVEL,DEVIATION", ",", float)

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> Any:
        """Return the level and its standard deviation, "off", or None for "auto"."""
        if value in ("auto", "off"):
            return None if value == "auto" else value
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            self.fail(f"{value!r} is not of the form {self.name}, such as 45,25, nor auto or off", param, ctx)


def joined_places(
    ctx: click.Context, param: click.Parameter, given: tuple[tuple[float, ...], ...]
) -> tuple[float, ...] | None:
    """Return the places of all uses of an option; None if the option was not given.

    Raises
    ------
    click.BadParameter
        For more than two places.
    """
    places = tuple(place for one in given for place in one)
    if len(places) > 2:
        found = ", ".join(f"{place:g}" for place in places)
        mend = f"give one or two, such as {param.opts[0]} 12.5 or {param.opts[0]} 3,40"
        raise click.BadParameter(f"found {len(places)} places ({found}); {mend}", ctx, param)
    return places or None


class WindowOption(Parts):
    """A window, given as width and level in this order, or by its name."""

    def __init__(self, names: tuple[str, ...]) -> None:
        super().__init__("WIDTH/LEVEL", "/", float)
        self.names = names

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> Any:
        """Return the name or the two numbers."""
        if isinstance(value, str) and value in self.names:
            return value
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            known = ", ".join(self.names)
            self.fail(
                f"{value!r} is not of the form {self.name}, such as 900/300, nor one of {known}", param, ctx
            )


class Named(_Type):
    """One of several names, or a vector."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names, self.name = names, "|".join(names) + "|X,Y,Z"

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> Any:
        """Return the name or the vector."""
        if value in self.names:
            return value
        try:
            return VECTOR.convert(value, param, ctx)
        except click.BadParameter:
            self.fail(f"{value!r} is neither one of {', '.join(self.names)} nor a vector X,Y,Z", param, ctx)


class Color(_Type):
    """A colour in hexadecimal, with or without opacity."""

    def __init__(self, form: str, lengths: tuple[int, ...]) -> None:
        self.name, self._lengths = form, lengths

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> tuple[int, ...]:
        """Return the channels, 0 to 255."""
        if not isinstance(value, str):
            return tuple(value)
        digits = value.removeprefix("#")
        try:
            channels = tuple(bytes.fromhex(digits))
        except ValueError:
            channels = ()
        if len(channels) not in self._lengths or len(digits) != 2 * len(channels):
            self.fail(f"{value!r} is not a colour of the form {self.name}", param, ctx)
        return channels


class Thickness(_Type):
    """A thickness in mm and, after a colon, how the values within it are combined."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names, self.name = names, "MM[:" + "|".join(names) + "]"

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> tuple[float, str]:
        """Return the thickness and how its values are combined, by default the first name."""
        length, colon, name = str(value).lower().partition(":")
        try:
            thickness = float(length.removesuffix("mm"))
        except ValueError:
            thickness = math.nan
        if not math.isfinite(thickness) or (colon and name not in self.names):
            self.fail(f"{value!r} is not of the form {self.name}, such as 4mm:{self.names[-1]}", param, ctx)
        return thickness, name or self.names[0]


class Transfer(_Type):
    """The name of a transfer function, or its control points."""

    name = "NAME|INTENSITY:RRGGBB:OPACITY,..."

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names = names

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> Any:
        """Return the name, or the control points (intensity, colour, opacity)."""
        if value in self.names or not isinstance(value, str):
            return value
        return tuple(self._point(point, param, ctx) for point in value.split(","))

    def _point(self, text: str, param: _Parameter, ctx: _Context) -> tuple[float, tuple[int, ...], float]:
        parts = text.split(":")
        if len(parts) != 3:
            known = ", ".join(self.names)
            self.fail(f"{text!r} is neither one of {known} nor INTENSITY:RRGGBB:OPACITY", param, ctx)
        try:
            return float(parts[0]), RGB.convert(parts[1], param, ctx), float(parts[2])
        except ValueError:
            self.fail(f"{text!r} is not of the form INTENSITY:RRGGBB:OPACITY", param, ctx)


VECTOR = Parts("X,Y,Z", ",", float)
SIZE = Parts("WIDTHxHEIGHT", "x", int)
PLACES = Places()
WALL = WallOption()
WINDOW = WindowOption(WINDOW_NAMES)
RGB = Color("RRGGBB", (3,))
RGBA = Color("RRGGBB[AA]", (3, 4))


class Quantity(_Type):
    """A number followed by a unit."""

    def __init__(self, name: str, units: dict[str, int], example: str) -> None:
        self.name, self._units, self._example = name, units, example

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number in the smallest unit."""
        if not isinstance(value, str):
            return float(value)
        found = re.fullmatch(r"([\d.]+)\s*([a-z]*?)(?:i?b)?", value.lower())
        try:
            return float(found[1]) * self._units[found[2]] if found else self._refuse(value, param, ctx)
        except (ValueError, KeyError):
            return self._refuse(value, param, ctx)

    def _refuse(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> NoReturn:
        self.fail(f"{value!r} is not of the form {self.name}, such as {self._example}", param, ctx)

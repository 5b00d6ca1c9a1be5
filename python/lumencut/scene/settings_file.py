"""Settings as a TOML file: a key for each setting, with a comment about its effect."""

from __future__ import annotations

import difflib
import json
import os
import textwrap
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from lumencut import _lumencut
from lumencut.base.paths import WRITABLE, checked_path, replace_whole
from lumencut.base.wording import listed
from lumencut.errors import FileError, FormatError, SettingsError
from lumencut.scene.focus import Focus
from lumencut.scene.slab import Slab
from lumencut.scene.transfer import TransferFunction
from lumencut.scene.window import WINDOW_NAMES, Opacity, Window

_Settings = TypeVar("_Settings")

_HEAD = "# Settings of Lumencut. A setting that is left out has its default."
_LARGEST = 1 << 20
_WIDTH = 100
_NONE = "none"
_EXPECTED = "a settings file, such as lumencut settings writes"

_TABLES: dict[str, tuple[Callable[..., Any], tuple[str, ...]]] = {
    "window": (Window, ("level", "width")),
    "opacity": (Opacity, ("transparent", "opaque")),
    "slab": (Slab, ("thickness", "mode")),
    "focus": (Focus, ("margin", "fade")),
}
_POINT = ("intensity", "color", "opacity")

#: Example values for settings whose defaults come from the data.
_EXAMPLES = {
    "number": "0.5",
    "window": "{ level = 300.0, width = 900.0 }",
    "opacity": "{ transparent = 50.0, opaque = 150.0 }",
    "slab": '{ thickness = 4.0, mode = "mean" }',
    "focus": "{ margin = 2.0, fade = 6.0 }",
    "transfer": '"angio"',
    # It lies above the example of `rim_low`.
    "rim_high": "20.0",
}


def settings_text(settings: Any) -> str:
    """Return settings as the text of a file, in the order of the table, with comments."""
    blocks = [_HEAD]
    for name, setting in _lumencut.SETTINGS.items():
        value = getattr(settings, name)
        if value is None and setting.default is None:
            usual = f'"{setting.choices[-1]}"' if setting.kind == "choice" else _EXAMPLES[setting.kind]
            example = _EXAMPLES.get(name, usual)
            line = f"# {name} = {example}"
        else:
            line = f"{name} = {_line(setting, value)}"
        blocks.append("\n".join([*_comment(setting), line]))
    return "\n\n".join(blocks) + "\n"


def write_settings(settings: Any, path: str | os.PathLike[str]) -> None:
    """Write settings as a file, which appears only when complete."""
    text = settings_text(settings)
    replace_whole(checked_path(path, WRITABLE), lambda place: place.write_text(text, "utf-8"))


def read_settings(path: str | os.PathLike[str], make: Callable[..., _Settings]) -> _Settings:
    """Read the settings of a file; ``make`` creates them, and all errors name the file."""
    place = checked_path(path, _EXPECTED)
    found = _parsed(place)
    for name in found:
        if name not in _lumencut.SETTINGS:
            raise _unknown(place, name)
    try:
        return make(**{name: _read(name, _lumencut.SETTINGS[name], value) for name, value in found.items()})
    except SettingsError as error:
        raise SettingsError(f"{error.subject} in {place}", error.found, error.expected, error.mend) from error


def _comment(setting: _lumencut.Setting) -> list[str]:
    """Return the effect of the setting, its default, and other possible values."""
    default = setting.open if setting.default is None else _line(setting, setting.default)
    others = ""
    if setting.kind == "choice":
        names = [*setting.choices, *([_NONE] if setting.optional else [])]
        others = f"; one of {', '.join(map(_written, names))}"
    elif setting.kind == "window":
        others = f"; or one of {', '.join(map(_written, WINDOW_NAMES))}"
    elif setting.range is not None:
        none = f", or {_written(None)}" if setting.optional and setting.default is not None else ""
        others = f"; {setting.range[0]:g} to {setting.range[1]:g}{none}"
    texts = (setting.sentence.replace("`", ""), f"Default: {default}{others}.")
    return [line for text in texts for line in textwrap.wrap(f"# {text}", _WIDTH, subsequent_indent="# ")]


def _line(setting: _lumencut.Setting, value: Any) -> str:
    """Return the value of a setting as a line of TOML."""
    return f"[{', '.join(map(_written, value))}]" if setting.kind == "vessels" else _written(value)


def _written(value: Any) -> str:
    """Return a value as TOML."""
    match value:
        case None:
            return f'"{_NONE}"'
        case bool():
            return "true" if value else "false"
        case int() | float():
            return repr(value)
        case str():
            # JSON escapes the same characters as TOML, except one.
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        case tuple():
            return f'"#{bytes(value).hex()}"'
        case TransferFunction():
            points = (dict(zip(_POINT, point, strict=True)) for point in value.points)
            return "[\n" + "".join(f"  {_table(point)},\n" for point in points) + "]"
    return _table(vars(value))


def _table(values: Mapping[str, Any]) -> str:
    return "{ " + ", ".join(f"{name} = {_written(value)}" for name, value in values.items()) + " }"


def _parsed(path: Path) -> dict[str, Any]:
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST + 1)
    except OSError as error:
        raise FileError(str(path), error.strerror or str(error), _EXPECTED) from error
    if len(content) > _LARGEST:
        raise FormatError(str(path), f"more than {_LARGEST} bytes", _EXPECTED)
    try:
        return tomllib.loads(content.decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise FormatError(str(path), f"no TOML ({error})", _EXPECTED) from error
    except RecursionError as error:
        raise FormatError(str(path), "values nested too deeply", _EXPECTED) from error


def _unknown(path: Path, name: str) -> SettingsError:
    alike = difflib.get_close_matches(name.lower().replace("-", "_"), _lumencut.SETTINGS, 1)
    mend = f"perhaps {alike[0]} is meant" if alike else "lumencut settings lists them all"
    return SettingsError(str(path), f"the key {name[:80]!r}, which no setting has", "names of settings", mend)


def _read(subject: str, setting: _lumencut.Setting, value: Any) -> Any:
    """Return a TOML value in the form that the setting accepts."""
    if value == _NONE and setting.optional:
        return None
    match setting.kind:
        case "flag":
            return _of_type(subject, value, bool, "true or false")
        case "count":
            return _of_type(subject, value, int, "a whole number")
        case "number":
            return _of_type(subject, value, (int, float), "a number")
        case "choice":
            return _of_type(subject, value, str, ", ".join(f'"{name}"' for name in setting.choices))
        case "vessels":
            return tuple(_of_type(subject, value, list, 'an array of ids and names, such as ["LAD", 2]'))
        case "color":
            return _color(subject, value, len(setting.default))
        case "window" if isinstance(value, str):
            return value
        case "transfer" if isinstance(value, list):
            return TransferFunction(tuple(_point(subject, point) for point in value))
        case "transfer":
            return _of_type(subject, value, str, "a name, or an array of control points")
    make, names = _TABLES[setting.kind]
    return make(**_fields(subject, value, names))


def _of_type(subject: str, value: Any, kind: Any, expected: str) -> Any:
    # In Python True and False are integers, in TOML they are not.
    if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
        raise SettingsError(subject, f"{value!r:.80}", expected)
    return value


def _color(subject: str, value: Any, channels: int) -> tuple[int, ...]:
    digits = value.removeprefix("#") if isinstance(value, str) else ""
    try:
        color = tuple(bytes.fromhex(digits))
    except ValueError:
        color = ()
    if len(digits) != 2 * len(color) or len(color) not in {3, channels}:
        form = '"#rrggbb"' if channels == 3 else '"#rrggbb" or "#rrggbbaa"'
        raise SettingsError(subject, f"{value!r:.80}", f"a colour of the form {form}")
    return (*color, *[255] * (channels - len(color)))


def _point(subject: str, value: Any) -> tuple[Any, Any, Any]:
    fields = _fields(f"control point of {subject}", value, _POINT)
    return fields["intensity"], _color(subject, fields["color"], 3), fields["opacity"]


def _fields(subject: str, value: Any, names: tuple[str, ...]) -> dict[str, Any]:
    """Return the values of a table that must have exactly these names."""
    if not isinstance(value, dict) or set(value) != set(names):
        found = listed([repr(name) for name in value]) if isinstance(value, dict) and value else repr(value)
        raise SettingsError(subject, f"{found:.80}", f"a table of {', '.join(names)}")
    return value

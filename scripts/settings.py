"""Generate the class `Settings`, ``docs/settings.md`` and the defaults in ``docs/python.md`` from the tables.

The tables, `settings/table.rs` and `defaults.rs`, are read from the built package; no tool knows their form.
"""

from __future__ import annotations

import math
import re
import textwrap
from pathlib import Path

from lumencut._lumencut import QUANTITIES, SETTINGS, Setting
from lumencut.scene.window import WINDOW_NAMES

ROOT = Path(__file__).resolve().parent.parent

CLASS_HEAD = '''"""All settings with units and defaults.

``make generate`` generates this file from the table of settings in the core.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from lumencut.base.pickles import by_name
from lumencut.scene.checked_settings import CheckedSettings
from lumencut.scene.focus import Focus
from lumencut.scene.slab import Slab
from lumencut.scene.transfer import TransferFunction
from lumencut.scene.window import Opacity, Window

'''
CLASS = '''

@by_name
@dataclass(frozen=True)
class Settings(CheckedSettings):
    """Settings of the cut surface (Auzinger et al. 2013, section 3) and of the context behind it.

    Parameters
    ----------
{parameters}

    Raises
    ------
    SettingsError
        For a setting outside its range.
    """

{fields}
'''
PAGE = """# Settings

Each setting is a field of `lumencut.Settings`. It is also an option of `lumencut render` and
`lumencut turntable`, with hyphens instead of underscores. A value outside the range is rejected.
[The command line](command-line.md) describes settings in a TOML file. `make generate` generates this page.

| setting | kind | range | unit | default | what it does |
|---|---|---|---|---|---|
{rows}
"""
PLAIN = {
    "flag": "bool",
    "number": "float",
    "count": "int",
    "opacity": "Opacity",
    "slab": "Slab",
    "focus": "Focus",
    "vessels": "tuple[int | str, ...]",
}
"""The types of Python that need no more than their name."""


def class_file() -> str:
    """The module of the class `Settings`."""
    parameters = "\n".join(parameter(name, setting) for name, setting in SETTINGS.items())
    fields = "\n".join(
        f"    {name}: {annotation(name, setting)} = {literal(setting.default)}"
        for name, setting in SETTINGS.items()
    )
    aliases = "".join(
        f"{alias(name)}: TypeAlias = Literal[{names(setting)}]\n"
        for name, setting in SETTINGS.items()
        if setting.kind == "choice"
    )
    return CLASS_HEAD + aliases + CLASS.format(parameters=parameters, fields=fields)


def parameter(name: str, setting: Setting) -> str:
    """The entry of a setting in the documentation of the class."""
    parts = [kind_in_words(setting)]
    if setting.range is not None:
        parts.append(span(setting))
    default = literal(setting.default).removesuffix(".0")
    parts.append("optional" if setting.open is not None else f"default {default}")
    text = f"{setting.sentence} {setting.details}".strip()
    if setting.open is not None:
        text += f" If not given: {setting.open}."
    lines = textwrap.wrap(text.replace("`", "``"), 100, break_on_hyphens=False)
    return "\n".join([f"    {name} : {', '.join(parts)}", *(f"        {line}" for line in lines)])


def kind_in_words(setting: Setting) -> str:
    """The type of a setting as the documentation of the class names it."""
    match setting.kind:
        case "color":
            return f"({', '.join(['int'] * len(setting.default))})"
        case "choice":
            return f"{{{names(setting)}}}" + (" or None" if setting.optional else "")
        case "transfer":
            return f"{{{names(setting)}}} or TransferFunction"
        case "window":
            return "Window, or a name of `Window.named`"
        case "vessels":
            return "tuple of int or str"
    return PLAIN[setting.kind] + (" or None" if setting.optional and setting.open is None else "")


def annotation(name: str, setting: Setting) -> str:
    """The type of a field."""
    match setting.kind:
        case "color":
            kind = f"tuple[{', '.join(['int'] * len(setting.default))}]"
        case "choice":
            kind = alias(name)
        case "transfer":
            kind = "str | TransferFunction"
        case "window":
            kind = "Window | str"
        case _:
            kind = PLAIN[setting.kind]
    return f"{kind} | None" if setting.optional else kind


def alias(name: str) -> str:
    """What the type of the names of a setting is called."""
    return "".join(word.capitalize() for word in name.split("_")) + "Name"


def names(setting: Setting) -> str:
    """The names that can be chosen."""
    return ", ".join(f'"{name}"' for name in setting.choices)


def literal(value: object) -> str:
    """A default as Python writes it."""
    return f'"{value}"' if isinstance(value, str) else repr(value)


def span(setting: Setting) -> str:
    """The range of a number."""
    low, high = setting.range or (0.0, 0.0)
    return f"{plain(low)} to {plain(high)}"


def plain(number: float) -> str:
    """A number without an exponent, and without a fraction where it is whole."""
    return str(int(number)) if number == int(number) else str(number)


def page() -> str:
    """The page of all settings."""
    return PAGE.format(rows="\n".join(row(name, setting) for name, setting in SETTINGS.items()))


def row(name: str, setting: Setting) -> str:
    """The row of a setting."""
    limits, unit = (span(setting), (setting.unit or "").strip("()")) if setting.range else ("", "")
    text = f"{setting.sentence} {setting.details}".strip()
    return f"| `{name}` | {page_kind(setting)} | {limits} | {unit} | {page_default(setting)} | {text} |"


def page_kind(setting: Setting) -> str:
    """The kind of a setting as the page names it."""
    match setting.kind:
        case "color":
            return f"{len(setting.default)} whole numbers, 0 to 255"
        case "choice":
            named = ", ".join(f"`{name}`" for name in setting.choices)
            return f"one of {named}" + (" or None" if setting.optional else "")
        case "transfer":
            return "name or `TransferFunction`"
        case "window":
            return "`Window` or " + ", ".join(f"`{name}`" for name in WINDOW_NAMES)
        case "vessels":
            return "ids and names"
        case "flag" | "number" | "count":
            none = " or None" if setting.optional and setting.open is None else ""
            return {"flag": "yes or no", "number": "number", "count": "whole number"}[setting.kind] + none
    return f"`{PLAIN[setting.kind]}`"


def page_default(setting: Setting) -> str:
    """The default of a setting as the page names it."""
    match setting.default:
        case None:
            return setting.open or "none"
        case ():
            return "none"
        case bool(flag):
            return "yes" if flag else "no"
        case float(number):
            return plain(number)
        case str(name):
            return f"`{name}`"
    return str(setting.default)


def with_defaults(text: str) -> str:
    """A page with the table of defaults between its marks."""
    rows = "\n".join(
        f"| `{name}` | {plain(default).replace('-', '−')} | {limits(*span)} | {unit} | {about} |"
        for name, _, unit, span, default, about in QUANTITIES
    )
    table = f"| parameter | default | range | unit | what it is |\n|---|---|---|---|---|\n{rows}\n"
    return re.sub(r"(<!-- defaults -->\n).*(<!-- end -->)", rf"\1{table}\2", text, flags=re.DOTALL)


def limits(low: float, high: float) -> str:
    """A range as pages state it."""
    if math.isinf(high):
        return "above 0" if low > 0 else f"from {plain(low)}"
    return f"{plain(low)} to {plain(high)}".replace("-", "−")


def files() -> dict[Path, str]:
    """Each file that repeats a table, and what it has to hold."""
    python = ROOT / "docs/python.md"
    return {
        ROOT / "python/lumencut/scene/settings.py": class_file(),
        ROOT / "docs/settings.md": page(),
        python: with_defaults(python.read_text("utf-8")),
    }


if __name__ == "__main__":
    for path, content in files().items():
        path.write_text(content, "utf-8")

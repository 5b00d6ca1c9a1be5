"""Options for the settings of a picture, created from the table of settings, and a file of them to keep."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut._lumencut import LOOK_SENTENCES, LOOKS, PAPER, SETTINGS, Setting
from lumencut.cli import options
from lumencut.cli.options import FILE, Command, added
from lumencut.cli.parameters import RGB, RGBA, WINDOW, WINDOW_NAMES, NumberOrNone, Parts, Thickness, Transfer
from lumencut.cli.report import say, verbose_option
from lumencut.errors import SettingsError

if TYPE_CHECKING:
    from lumencut.scene.settings import Settings

NO_CONTEXT = "none"

#: The most common settings come first; the others follow in the order of the table.
_FIRST = ("window", "opacity", "background")

#: Placeholder for a number in the help, by the unit of the setting; otherwise "NUMBER".
_METAVARS = {"mm": "MM", "mm per level": "MM", "mm per mm": "SLOPE", "radii": "RADII"}

#: How to write values, for the help; it follows the sentence about the setting.
_WRITTEN = {
    "window": f", such as 900/300 (width, then level), or one of {', '.join(WINDOW_NAMES)}",
    "flag": " (yes or no)",
    "color": " (hexadecimal)",
    "slab": ", such as 4mm:mean",
    "focus": ", such as 2:6",
    "vessels": "; may be given several times",
}


def paper_option(command: Command) -> Command:
    """Add the option --paper, which starts from the paper's rules."""
    rules = " ".join(_words(name, value) for name, value in PAPER.items())
    text = f"Start from the rules of the CSR paper (2013): {rules}. Other options change them further."
    return click.option("--paper", is_flag=True, help=text)(command)


def _words(name: str, value: Any) -> str:
    """Return the option that gives a setting this value, as the user types it."""
    words = name.replace("_", "-")
    if value is None:
        return f"--{words} {NO_CONTEXT}"
    if isinstance(value, bool):
        return f"--{words}" if value else f"--no-{words}"
    return f"--{words} {value:g}" if isinstance(value, float) else f"--{words} {value}"


look_option = click.option(
    "--look",
    type=click.Choice(tuple(LOOKS)),
    help="Start from several settings at once. "
    + "; ".join(f"{name}: {sentence}" for name, sentence in LOOK_SENTENCES.items())
    + ". Other options change them further.",
)

settings_option = click.option(
    "--settings",
    "settings_file",
    type=FILE,
    help="Start from the settings in this TOML file, as lumencut settings writes it. Other options "
    "change them further.",
)


rim_option = click.option(
    "--measured",
    is_flag=True,
    help="Measure the vessels to show diameters, instead of showing the radii of CENTERLINES. All other "
    "values are always measured; narrowing and deviation need a session file as CENTERLINES with a marked "
    "stenosis.",
)


def setting_options(command: Command) -> Command:
    """Add one option for each field of `Settings`, under its name."""
    names = [*_FIRST, *(name for name in SETTINGS if name not in _FIRST)]
    options = (_option(name, SETTINGS[name]) for name in names)
    return added((settings_option, look_option, *options), command)


def look_options(command: Command) -> Command:
    """Add the options that change how a surface is shown, by whatever method it was found."""
    names = (*_FIRST, "slab")
    return added((settings_option, *(_option(name, SETTINGS[name]) for name in names)), command)


def _option(name: str, setting: Setting) -> Any:
    """Return the option of a setting. If it is not given, its value is None, for the setting's default."""
    words = f"--{name.replace('_', '-')}"
    if setting.kind == "flag":
        return click.option(f"{words}/--no-{words[2:]}", default=None, help=_help(setting))
    if setting.kind == "vessels":
        return click.option(words, multiple=True, metavar="NAME|ID", help=_help(setting))
    kind, metavar = _type(setting)
    return click.option(words, type=kind, metavar=metavar, help=_help(setting))


def _type(setting: Setting) -> tuple[Any, str | None]:
    """Return the type of an option's value, and its placeholder in the help."""
    match setting.kind:
        case "number":
            metavar = _METAVARS.get(setting.unit or "", "NUMBER")
            has_none = setting.optional and setting.open is None
            return (NumberOrNone(), f"{metavar}|{NO_CONTEXT}") if has_none else (float, metavar)
        case "count":
            return int, "N"
        case "color":
            return (RGB if len(setting.default) == 3 else RGBA), None
        case "window":
            return WINDOW, f"{WINDOW.name}|NAME"
        case "opacity":
            return Parts("TRANSPARENT:OPAQUE", ":", float), None
        case "focus":
            return Parts("MARGIN:FADE", ":", float), None
        case "slab":
            return Thickness(setting.choices), None
        case "transfer":
            return Transfer(setting.choices), Transfer.name
    none = [NO_CONTEXT] if setting.optional else []
    return click.Choice([*setting.choices, *none]), None


def _help(setting: Setting) -> str:
    """Return the help of a setting: its effect, how to write values, and its default."""
    sentence = re.sub(r"`(\w+)`", lambda name: name[1].replace("_", "-"), setting.sentence.rstrip("."))
    return f"{sentence}{_WRITTEN.get(setting.kind, '')}; {_default(setting)}."


def _default(setting: Setting) -> str:
    if setting.open is not None:
        return f"default: {setting.open}"
    match setting.default:
        case bool(flag):
            return f"default {'yes' if flag else 'no'}"
        case ():
            return "default: none"
        case tuple(channels):
            return f"default {bytes(channels).hex()}"
        case str(name):
            return f"default {name}"
        case number:
            return f"default {number:g}"


def settings_from(chosen: dict[str, Any], base: Settings | None = None) -> Settings:
    """Return the settings of the options; all others come from `base`, or from the paper's rules.

    Without both they have their defaults.
    """
    from lumencut.scene.settings import Settings

    given = {name: chosen[name] for name in SETTINGS if chosen.get(name) not in (None, ())}
    path = chosen.get("settings_file")
    if path is not None and base is not None:
        found = "--settings and --like exclude each other: both name all settings"
        raise click.UsageError(f"{found}; give single settings as options with --like")
    if path is not None and chosen.get("paper"):
        mend = "lumencut settings --paper writes a file of the paper's rules"
        raise click.UsageError(f"--settings and --paper exclude each other; {mend}")
    start = base or Settings() if path is None else Settings.from_file(path)
    rules = {**(PAPER if chosen.get("paper") else {}), **_look(chosen.get("look"))}
    try:
        fields = {name: _as_field(SETTINGS[name], value) for name, value in given.items()}
        return replace(start, **{**rules, **fields})
    except SettingsError as error:
        raise click.UsageError(str(error)) from error


def _look(name: str | None) -> dict[str, Any]:
    """Return the settings of a look."""
    from lumencut.scene.checked_settings import look_values

    return {} if name is None else look_values(name)


def _as_field(setting: Setting, value: Any) -> Any:
    """Convert the value of an option to that of the setting."""
    from lumencut.scene.focus import Focus
    from lumencut.scene.slab import Slab
    from lumencut.scene.transfer import TransferFunction
    from lumencut.scene.window import Opacity, Window

    match setting.kind:
        case "window" if not isinstance(value, str):
            width, level = value
            return Window(level=level, width=width)
        case "opacity":
            return Opacity(*value)
        case "focus":
            return Focus(*value)
        case "slab":
            return Slab(*value)
        case "transfer" if isinstance(value, tuple):
            return TransferFunction(value)
        case "choice" | "number" if setting.optional and value == NO_CONTEXT:
            return None
        case "color" if len(value) < len(setting.default):
            return (*value, 255)
    return value


@click.command(short_help="Write a file of settings.")
@click.option("-o", "--output", type=options.FILE, help="The file, such as look.toml; default: print.")
@paper_option
@setting_options
@verbose_option
def settings(output: Path | None, **chosen: Any) -> None:
    """Write all settings with their values, units and meaning as a TOML file.

    The values are the defaults, or those of the options. Edit the file, and pass it to render, turntable or
    evaluate with --settings.

    \b
    lumencut settings --window 900/300 --no-silhouettes -o look.toml
    lumencut render ct.nii.gz centerlines.vtp --settings look.toml -o out.png
    """  # noqa: D301 - click needs the control character itself
    from lumencut.scene.settings_file import settings_text

    found = settings_from(chosen)
    if output is None:
        say(settings_text(found).rstrip("\n"))
        return
    options.check_folder(output)
    found.save(output)
    say(str(output))

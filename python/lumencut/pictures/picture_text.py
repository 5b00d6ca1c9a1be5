"""The text in a PNG of Lumencut, and settings as JSON."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any, NoReturn

from lumencut import _lumencut
from lumencut.errors import FileError, FormatError
from lumencut.scene.focus import Focus
from lumencut.scene.settings import Settings
from lumencut.scene.slab import Slab
from lumencut.scene.transfer import TransferFunction
from lumencut.scene.window import Opacity, Window

KEYWORD = "Lumencut"

_LONGEST = 100_000
_CLASSES: dict[str, Any] = {"window": Window, "opacity": Opacity, "slab": Slab, "focus": Focus}


def text_of(path: Path, expected: str) -> str:
    """Return the text in a PNG. Its pixels are not decoded; a file that is cut off is rejected.

    Parameters
    ----------
    path : Path
        The picture.
    expected : str
        What the error says was expected.

    Raises
    ------
    FormatError
        For an incomplete PNG, or one without such text.
    FileError
        For a file that cannot be read.
    """
    from PIL.PngImagePlugin import PngImageFile

    try:
        with path.open("rb") as file:
            picture = PngImageFile(file)
            text = picture.info.get(KEYWORD)
            picture.verify()
    except OSError as error:
        if error.errno is not None:
            raise FileError(str(path), error.strerror or str(error), expected) from None
        text = _unreadable(path, expected)
    except (SyntaxError, ValueError, EOFError, struct.error, IndexError, KeyError, TypeError):
        text = _unreadable(path, expected)
    if not isinstance(text, str):
        found = "a picture without a description of its rendering"
        mend = "use the file that Lumencut wrote: programs that change a picture may drop its description"
        raise FormatError(str(path), found, expected, mend)
    if len(text) > _LONGEST:
        raise FormatError(str(path), f"a text of {len(text)} letters", f"at most {_LONGEST}")
    return text


def _unreadable(path: Path, expected: str) -> NoReturn:
    raise FormatError(str(path), "no PNG, or a damaged one", expected, "copy it again") from None


def plain_settings(settings: Settings) -> dict[str, Any]:
    """Return settings in a form for JSON: windows, slabs and transfer functions by their fields."""
    return {name: _plain(getattr(settings, name)) for name in _lumencut.SETTINGS}


def _plain(value: Any) -> Any:
    is_made = isinstance(value, (*_CLASSES.values(), TransferFunction))
    return vars(value) if is_made else value


def settings_of(content: dict[str, Any]) -> Settings:
    """Return settings from their form in JSON.

    Raises
    ------
    KeyError
        For other settings than those of this version.
    TypeError, SettingsError
        For invalid values of a setting.
    """
    if content.keys() != _lumencut.SETTINGS.keys():
        raise KeyError("other settings than those of this version")
    return Settings(**{name: _made(name, value) for name, value in content.items()})


def _made(name: str, value: Any) -> Any:
    """Create the value of a setting from its fields, if it has fields; `Settings` checks all others."""
    kind = _lumencut.SETTINGS[name].kind
    if not isinstance(value, dict):
        return value
    if kind == "transfer":
        return TransferFunction(**value)
    return _CLASSES[kind](**value)

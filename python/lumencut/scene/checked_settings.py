"""The behaviour of `Settings`: checks its fields once by the table of the core."""

from __future__ import annotations

import operator
import os
from typing import Any, Self

from lumencut import _lumencut
from lumencut.base.checks import choice, flag, integers, number
from lumencut.base.wording import a
from lumencut.errors import SettingsError
from lumencut.scene.focus import Focus
from lumencut.scene.slab import Slab
from lumencut.scene.transfer import TransferFunction
from lumencut.scene.window import Opacity, checked_window

_CLASSES = {"opacity": Opacity, "slab": Slab, "focus": Focus}


class CheckedSettings:
    """The base of `Settings`; also stores the values that the core has checked and converted."""

    # A slot is not a field: it is not compared, printed or pickled.
    __slots__ = ("_checked",)
    _checked: _lumencut.Settings

    def __post_init__(self) -> None:
        for name, setting in _lumencut.SETTINGS.items():
            object.__setattr__(self, name, _value(name, setting, getattr(self, name)))
        self._keep()

    @classmethod
    def paper(cls, **changes: Any) -> Self:
        """Return the paper's rules, with all other settings at their defaults.

        They are those of Auzinger et al. 2013, section 3: the smallest cost wins at each level of detail, the
        depth filter knows no zones, and silhouettes follow the gradient of the depth.

        Parameters
        ----------
        **changes
            Other values for single settings, as keyword arguments.

        Raises
        ------
        SettingsError
            For a setting outside its range.
        """
        return cls(**{**_lumencut.PAPER, **changes})

    @classmethod
    def look(cls, name: str, **changes: Any) -> Self:
        """Return a look: several settings under one name, with all others at their defaults.

        Parameters
        ----------
        name : {"lumen", "focus", "body", "mip", "slab"}
            ``lumen``: the cut over the entire picture, the default. ``focus``: the cut close to the vessels,
            within the shaded body. ``body``: the shaded body without a cut. ``mip``: the largest value
            along each ray, without a cut. ``slab``: the largest value in 10 mm around the cut.
        **changes
            Other values for single settings, as keyword arguments.

        Raises
        ------
        SettingsError
            For an unknown name, or a setting outside its range.
        """
        choice(SettingsError, "name of the look", name, tuple(_lumencut.LOOKS))
        return cls(**{**look_values(name), **changes})

    @classmethod
    def focused(cls, **changes: Any) -> Self:
        """Return the look *focus*: the exact cut close to the vessels, within the shaded body.

        It has ``focus=Focus(2.0, 6.0)``, ``context="mida"`` and ``context_shading=True``; all other settings
        have their defaults.

        Parameters
        ----------
        **changes
            Other values for single settings, as keyword arguments.

        Raises
        ------
        SettingsError
            For a setting outside its range.
        """
        return cls.look("focus", **changes)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Self:
        """Return the settings of a TOML file as :meth:`save` writes it.

        Each key is the name of a setting; settings missing in the file have their defaults. Windows,
        opacities and slabs are tables of their fields, colours texts such as ``"#ffdc00"``, control points of
        a transfer function an array of tables with ``intensity``, ``color`` and ``opacity``. ``"none"``
        stands for None.

        Parameters
        ----------
        path : path-like
            The file, of at most 1 MiB.

        Raises
        ------
        FileError
            If the file cannot be read.
        FormatError
            If the file is not TOML.
        SettingsError
            For a key that no setting has, or a value of another type or outside its range. The error names
            the file.
        """
        from lumencut.scene.settings_file import read_settings

        return read_settings(path, cls)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all settings as a TOML file with comments, which appears only when complete.

        :meth:`from_file` reads equal settings back. A setting of None, whose value comes from the data,
        appears only in a comment.

        Parameters
        ----------
        path : path-like
            The file, usually with the extension ``.toml``.

        Raises
        ------
        FileError
            If the file cannot be written.
        """
        from lumencut.scene.settings_file import write_settings

        write_settings(self, path)

    def __getstate__(self) -> dict[str, Any]:
        return vars(self)

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        self._keep()

    def _keep(self) -> None:
        object.__setattr__(self, "_checked", _lumencut.Settings(self))


def checked(settings: CheckedSettings) -> _lumencut.Settings:
    """Return the settings in the form of the core; they were checked when they were created."""
    return settings._checked


def look_values(look: str) -> dict[str, Any]:
    """Return the settings of the look with this name."""
    values = _lumencut.LOOKS[look]
    return {name: _CLASSES[name](*value) if name in _CLASSES else value for name, value in values.items()}


def _value(name: str, setting: _lumencut.Setting, value: Any) -> Any:
    """Convert a value to the type of its setting; an error names the setting. The core checks ranges."""
    if value is None and setting.optional:
        return None
    or_none = " or None" if setting.optional else ""
    match setting.kind:
        case "flag":
            return flag(SettingsError, name, value)
        case "number":
            return number(SettingsError, name, value)
        case "count":
            low, high = setting.range or (0, 0)
            return integers(SettingsError, name, [value], int(low), int(high), 1)[0]
        case "color":
            return integers(SettingsError, name, value, 0, 255, len(setting.default))
        case "choice":
            choice(SettingsError, name, value, setting.choices, or_none)
        case "window":
            return checked_window(name, value)
        case "vessels":
            return _vessels(name, value)
        case "transfer":
            if not isinstance(value, TransferFunction):
                choice(SettingsError, name, value, setting.choices, f", a TransferFunction{or_none}")
        case kind:
            if not isinstance(value, _CLASSES[kind]):
                raise SettingsError(name, repr(value), f"{a(_CLASSES[kind].__name__)}{or_none}")
    return value


def _vessels(name: str, value: Any) -> tuple[int | str, ...]:
    """Check the type of ids and names of vessels; whether a tree has them is checked later."""
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        return tuple(_id_or_name(one) for one in value)
    except TypeError:
        expected = "several ids and names of vessels, such as ('LAD', 2)"
        raise SettingsError(name, f"{value!r:.80}", expected) from None


def _id_or_name(one: Any) -> int | str:
    """Return an id or a name unchanged; raise TypeError for anything else, such as True or an array."""
    if isinstance(one, bool):
        raise TypeError
    return one if isinstance(one, str) else operator.index(one)

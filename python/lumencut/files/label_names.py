"""Names of the labels of a label map, where its file has them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping

from lumencut.base.file_kinds import kind_of
from lumencut.base.paths import checked_path
from lumencut.errors import FileError, SettingsError
from lumencut.files.grids import open_grid


def read_label_names(path: str | os.PathLike[str]) -> dict[int, str]:
    """Read the names of labels of a label map.

    Known are the segments of 3D Slicer (``.seg.nrrd``, ``Segment0_Name`` and ``Segment0_LabelValue``) and the
    table of labels that TotalSegmentator writes into NIfTI files as an extension of the header.

    Parameters
    ----------
    path : path-like
        The label map.

    Returns
    -------
    dict of int to str
        The name of each label; empty where the file has none.

    Raises
    ------
    FileError
        If the file cannot be read.
    """
    place = checked_path(path, "the path of a label map")
    try:
        kind = kind_of(place)
    except OSError as error:
        raise FileError(str(place), error.strerror or str(error), "a file that can be read") from error
    has_names = kind is not None and kind.name in ("an NRRD volume", "a NIfTI volume")
    opened = open_grid(place) if has_names else None
    return {} if opened is None else opened.label_names


def chosen_labels(words: Iterable[str], known: Mapping[int, str]) -> dict[int, str]:
    """Return the labels that are written as ``52``, ``52=aorta`` or by a name of the file.

    Parameters
    ----------
    words : iterable of str
        The labels as they are written.
    known : mapping of int to str
        The names in the file, as :func:`read_label_names` returns them.

    Returns
    -------
    dict of int to str
        The name of each label that is chosen.

    Raises
    ------
    SettingsError
        For a word that is neither a value nor a name of the file.
    """
    labels: dict[int, str] = {}
    values = {name: value for value, name in known.items()}
    for word in words:
        value, equals, name = word.partition("=")
        if value.strip().lstrip("-").isdigit():
            number = int(value)
            labels[number] = name if equals else known.get(number, f"label {number}")
        elif word in values:
            labels[values[word]] = word
        else:
            names = f", or a name of the file: {', '.join(values)}" if values else ""
            raise SettingsError("label", repr(word), f"a value such as 52 or 52=aorta{names}")
    return labels

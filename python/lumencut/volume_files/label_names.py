"""Names of the labels of a label map, where its file has them."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from lumencut._files import checked_path
from lumencut.errors import FileError, SettingsError
from lumencut.file_kinds import kind_of

_HEADER_LIMIT = 1 << 20
_SEGMENT = re.compile(rb"^Segment(\d+)_(Name|LabelValue):=(.*?)\r?$", re.MULTILINE)
_LABEL = re.compile(r"<Label\b[^>]*?\bKey=\"(-?\d+)\"[^>]*>(?:<!\[CDATA\[)?([^<\]]*)")


def read_label_names(path: str | os.PathLike[str]) -> dict[int, str]:
    """Read the names of labels that a label map holds beside its voxels.

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
        Where the file cannot be read.
    """
    place = checked_path(path, "the path of a label map")
    try:
        kind = kind_of(place)
    except OSError as error:
        raise FileError(str(place), error.strerror or str(error), "a file that can be read") from error
    known = {"an NRRD volume": _of_slicer, "a NIfTI volume": _of_nifti}
    names = None if kind is None else known.get(kind.name)
    return {} if names is None else names(place)


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
        For a word that is no value and no name of the file.
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


def _of_slicer(path: Path) -> dict[int, str]:
    with path.open("rb") as file:
        header = file.read(_HEADER_LIMIT).partition(b"\n\n")[0]
    found: dict[bytes, dict[bytes, str]] = {}
    for number, field, value in _SEGMENT.findall(header):
        found.setdefault(number, {})[field] = value.decode("utf-8", "replace").strip()
    whole = (one for one in found.values() if one.get(b"LabelValue", "").isdigit() and one.get(b"Name"))
    return {int(one[b"LabelValue"]): one[b"Name"] for one in whole}


def _of_nifti(path: Path) -> dict[int, str]:
    import nibabel

    header = nibabel.load(path).header
    contents = [extension.get_content() for extension in getattr(header, "extensions", [])]
    texts = [text.decode("utf-8", "replace") if isinstance(text, bytes) else str(text) for text in contents]
    labels = (label for text in texts for label in _LABEL.findall(text[:_HEADER_LIMIT]))
    return {int(key): name.strip() for key, name in labels if name.strip()}

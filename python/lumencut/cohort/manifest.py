"""The list of the studies of a cohort: a table with a row for each, or patterns of file names."""

from __future__ import annotations

import glob
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from lumencut.base.paths import checked_path
from lumencut.cohort.manifest_table import Row, table_of
from lumencut.dicom.web.address import is_address
from lumencut.errors import FormatError

#: The columns that say where centerlines come from; a study may use only one of them.
SOURCES = ("centerlines", "mask", "points", "seeds")
READING = ("label", "series", "phase", "fwhm")
KNOWN = ("id", "volume", *SOURCES, *READING)
#: Placeholder of the id of a study in a pattern of file names.
PLACE = "{id}"

_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,99}")
_SESSION = re.compile(r"sub-([A-Za-z0-9]+)_ses-([A-Za-z0-9]+)")
_ID_RULE = "letters and digits, with - and _ between them, at most 100 in all"
_EXPECTED = "a table with the columns id and volume (.csv or .tsv)"
_NUMBERS = re.compile(r"[-+0-9.eE,;\s]+")
_MOST_NAMED = 20


@dataclass(frozen=True)
class Study:
    """One study of a cohort.

    Attributes
    ----------
    id : str
        Its id in the manifest: letters, digits, ``-`` and ``_``.
    volume : Path
        The file or folder of its scan.
    source : {"centerlines", "mask", "points", "seeds", "none"}
        Where its centerlines come from; with ``"none"`` all vessels are found.
    given : str
        The file of the source, or points as written in the manifest (mm, LPS); empty for "none".
    reading : mapping of str to str
        The entries of ``label``, ``series``, ``phase`` and ``fwhm`` in the manifest, if any.
    further : tuple of str
        The further columns of the manifest, in their order.
    left_out : str
        Why it is not processed, such as a missing scan; empty for all others.
    """

    id: str
    volume: Path
    source: str = "none"
    given: str = ""
    reading: Mapping[str, str] = field(default_factory=dict)
    further: tuple[str, ...] = ()
    left_out: str = ""

    @property
    def label(self) -> str:
        """The prefix of its file names, in the style of BIDS: ``sub-ID`` or ``sub-ID_ses-SESSION``."""
        found = _SESSION.fullmatch(self.id)
        if found:
            return self.id
        return f"sub-{re.sub('[_-]', '', self.id.removeprefix('sub-'))}"

    @property
    def folder(self) -> Path:
        """Its folder within the results: ``sub-ID`` or ``sub-ID/ses-SESSION``."""
        return Path(*self.label.split("_"))

    @property
    def files(self) -> tuple[Path, ...]:
        """Its input files and folders."""
        return (self.volume,) if self.given_as_text or not self.given else (self.volume, Path(self.given))

    @property
    def given_as_text(self) -> bool:
        """Whether the manifest contains the points themselves, not the name of a file."""
        return self.source in ("points", "seeds") and _NUMBERS.fullmatch(self.given) is not None


@dataclass(frozen=True)
class Manifest:
    """The studies of a cohort in the order of the manifest.

    Attributes
    ----------
    path : str
        The table, or the pattern of the volumes.
    studies : tuple of Study
        Its studies.
    further : tuple of str
        The names of the further columns, which are copied into ``studies.csv``.
    notes : tuple of str
        Notes on further columns whose names differ by one letter from a known one.
    """

    path: str
    studies: tuple[Study, ...]
    further: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def study(self, study_id: str) -> Study:
        """Return the study of an id.

        Raises
        ------
        FormatError
            If no study has it.
        """
        for one in self.studies:
            if one.id == study_id:
                return one
        raise FormatError(self.path, f"no study {study_id!r}", f"one of its {len(self.studies)} ids")


def read_manifest(path: str | Path, **patterns: str | None) -> Manifest:
    """Read the list of the studies of a cohort. No file of a study is opened.

    Parameters
    ----------
    path : str or path
        A table with a line for each study, ``.csv`` or ``.tsv``, UTF-8. Its columns are ``id``, ``volume``,
        at most one of ``centerlines``, ``mask``, ``points`` and ``seeds`` in each line, and ``label``,
        ``series``, ``phase`` and ``fwhm`` as for :func:`lumencut.read_volume` and :func:`lumencut.measure`.
        Further columns are copied. Relative paths start from the folder of the table. Or a pattern of the
        names of volumes with ``{id}`` for the id, such as ``scans/{id}.nii.gz``.
    **patterns : str, optional
        With a pattern of volumes: those of ``centerlines``, ``mask``, ``points`` or ``seeds``.

    Returns
    -------
    Manifest
        The studies, in the order of the table, or of their ids.

    Raises
    ------
    FormatError
        For a file that is not such a table, and, in one message, for all invalid rows: duplicate or invalid
        ids, no volume, two sources of centerlines.
    FileError
        For a file that is missing or unreadable.
    """
    given = {name: pattern for name, pattern in patterns.items() if pattern is not None}
    if PLACE in str(path):
        return _of_patterns(str(path), given)
    if given:
        found = f"a pattern of {next(iter(given))} together with the table {path}"
        raise FormatError("manifest", found, f"a pattern of volumes with {PLACE}, or a column of the table")
    place = checked_path(path, _EXPECTED)
    table = table_of(place, KNOWN)
    missing = [name for name in ("id", "volume") if name not in table.names]
    if missing:
        found = f"the columns {', '.join(table.names)}"
        raise FormatError(str(place), found, f"also {' and '.join(missing)}", "; ".join(table.notes))
    further = tuple(name for name in table.names if name not in KNOWN)
    mistakes: list[str] = []
    studies = [_study(row, further, place.absolute().parent, mistakes) for row in table.rows]
    _check(str(place), studies, [f"line {row.line}" for row in table.rows], mistakes)
    return Manifest(str(place), tuple(studies), further, table.notes)


def _study(row: Row, further: tuple[str, ...], home: Path, mistakes: list[str]) -> Study:
    """Return the study of a row; mistakes in the row are added to the list of mistakes."""
    values = row.values
    sources = [name for name in SOURCES if values.get(name)]
    where = f"line {row.line}"
    if len(sources) > 1:
        mistakes.append(f"{where}: {' and '.join(sources)}, of which one is expected")
    if not values["volume"]:
        mistakes.append(f"{where}: no volume")
    source = sources[0] if sources else "none"
    made = Study(
        id=values["id"],
        volume=Path(_within(home, values["volume"])),
        source=source,
        given=values.get(source, ""),
        reading={name: values[name] for name in READING if values.get(name)},
        further=tuple(values[name] for name in further),
    )
    if made.given and not made.given_as_text:
        made = Study(made.id, made.volume, source, _within(home, made.given), made.reading, made.further)
    if "label" in made.reading and source != "mask":
        mistakes.append(f"{where}: a label without a mask")
    if "fwhm" in made.reading and not _is_width(made.reading["fwhm"]):
        mistakes.append(f"{where}: the fwhm {made.reading['fwhm']!r}, where a width in mm is expected")
    return made


def _within(home: Path, given: str) -> str:
    """Return a path relative to the folder of the table; the address of a PACS is returned unchanged."""
    return given if is_address(given) else str(home / given)


def _is_width(text: str) -> bool:
    try:
        return 0 < float(text) <= 20
    except ValueError:
        return False


def _check(path: str, studies: list[Study], where: list[str], mistakes: list[str]) -> None:
    """Reject invalid and duplicate ids, and report all mistakes at once."""
    seen: dict[str, tuple[str, str]] = {}
    for one, place in zip(studies, where, strict=True):
        if not _ID.fullmatch(one.id):
            mistakes.append(f"{place}: the id {one.id!r}, where {_ID_RULE} are expected")
            continue
        # In lower case, because some file systems ignore case.
        key = one.label.lower()
        if key in seen:
            first, known = seen[key]
            alike = "" if known == one.id else f" like {known!r} (case, - and _ are ignored)"
            mistakes.append(f"{place}: the id {one.id!r}{alike}, which {first} has")
        seen.setdefault(key, (place, one.id))
    if not studies:
        raise FormatError(path, "no study", "a line for each study")
    if mistakes:
        more = len(mistakes) - _MOST_NAMED
        named = "; ".join(mistakes[:_MOST_NAMED]) + (f"; and {more} more" if more > 0 else "")
        raise FormatError(path, named, "a study in each line, with its own id", "correct these lines")


def _of_patterns(pattern: str, sources: Mapping[str, str]) -> Manifest:
    """Return the studies whose volumes match a pattern, ordered by their ids."""
    if len(sources) > 1:
        raise FormatError("manifest", f"patterns of {' and '.join(sources)}", "one of them")
    for name, other in sources.items():
        if PLACE not in other:
            raise FormatError(f"pattern of {name}", f"{other!r}", f"{PLACE} in place of the id")
    found = {study_id: Path(path) for study_id, path in _matches(pattern)}
    studies = []
    for study_id, volume in sorted(found.items()):
        source = next(iter(sources), "none")
        given = str(Path(sources[source].replace(PLACE, study_id)).absolute()) if sources else ""
        studies.append(Study(study_id, volume.absolute(), source, given))
    if not studies:
        raise FormatError(pattern, "no such file", f"files whose names have an id in place of {PLACE}")
    _check(pattern, studies, [str(one.volume) for one in studies], [])
    return Manifest(pattern, tuple(studies))


def _matches(pattern: str) -> list[tuple[str, str]]:
    """Return ids and paths of the files that match a pattern; if {id} occurs twice, both must be equal."""
    before, *others = pattern.split(PLACE)
    rest = [f"(?P=id){_expression(part)}" for part in others[1:]]
    expression = re.compile(f"{_expression(before)}(?P<id>[^/]+?){_expression(others[0])}{''.join(rest)}/?")
    paths = glob.glob(pattern.replace(PLACE, "*"))
    matched = [(expression.fullmatch(path), path) for path in paths]
    return [(match["id"], path) for match, path in matched if match]


def _expression(part: str) -> str:
    """Return a part of a pattern as a regular expression; ``*`` and ``?`` do not match ``/``."""
    return re.escape(part).replace(r"\*", "[^/]*").replace(r"\?", "[^/]")

"""A BIDS data set as a manifest: one angiography of each session, or participant without sessions."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lumencut.base.paths import checked_path
from lumencut.cohort.manifest import Manifest, Study
from lumencut.cohort.manifest_table import table_of
from lumencut.errors import FileError, FormatError, LumencutError

#: Suffixes of the file names of angiographies; BIDS has ``angio`` for MR, and none for CT so far.
SUFFIXES = ("angio", "cta", "ct")
_ENDINGS = (".nii.gz", ".nii")
#: Extensions of images that may be the angiography in another format; named in the reason.
_IMAGES = (*_ENDINGS, ".nrrd", ".nhdr", ".mha", ".mhd", ".hdr", ".dcm", ".mgz")
_EXPECTED = "a BIDS data set with folders sub-…"
_MOST_NAMED = 8


def read_bids(folder: str | Path, suffixes: Sequence[str] = SUFFIXES, labels: Sequence[str] = ()) -> Manifest:
    """Return the angiographies of a BIDS data set as studies, by their participants and sessions.

    Parameters
    ----------
    folder : str or path
        The data set.
    suffixes : sequence of str
        Endings of the names of angiographies before ``.nii.gz``, such as ``angio`` or ``acq-cta_ct``; case
        is ignored.
    labels : sequence of str
        The participants, with or without ``sub-``; all by default.

    Returns
    -------
    Manifest
        A study for each participant, or for each of its sessions. Its vessels are found in the scan. A study
        without an angiography is left out, with the reason; so is one that ``participants.tsv`` or
        ``sub-…_sessions.tsv`` lists but that has no folder.

    Raises
    ------
    FormatError
        For sessions with several angiographies, missing participants, and a data set without any angiography.
    FileError
        For a missing folder.
    """
    home = checked_path(folder, _EXPECTED)
    if not home.is_dir():
        raise FileError(str(home), "no such folder", _EXPECTED)
    notes: list[str] = []
    found = [path.name for path in home.glob("sub-*") if path.is_dir()]
    listed = _listed(home / "participants.tsv", "participant_id", "sub-", notes)
    people = sorted({*found, *listed})
    wanted = {f"sub-{label.removeprefix('sub-')}" for label in labels}
    missing = sorted(wanted - set(people))
    if missing:
        expected = f"some of its {len(people)} participants"
        raise FormatError(str(home), f"no {' and no '.join(missing)}", expected)
    chosen = [person for person in people if not wanted or person in wanted]
    studies = [study for person in chosen for study in _of_person(home / person, suffixes, notes)]
    if all(study.left_out for study in studies):
        reasons = "; ".join(f"{study.id}: {study.left_out}" for study in studies[:_MOST_NAMED])
        found_none = f"no angiography ({reasons})" if reasons else "no angiography"
        mend = "name others by --suffix"
        raise FormatError(str(home), found_none, f"names that end with {_ends(suffixes)}", mend)
    return Manifest(str(home), tuple(studies), notes=tuple(notes))


def _listed(path: Path, column: str, prefix: str, notes: list[str]) -> list[str]:
    """The names in a column of a BIDS table; none if the table is missing or cannot be read."""
    if not path.is_file():
        return []
    try:
        table = table_of(path, [column])
    except LumencutError as error:
        notes.append(f"{error}; the table is not used")
        return []
    if column not in table.names:
        notes.append(f"{path}: found no column {column}; the table is not used")
        return []
    names = [row.values[column] for row in table.rows]
    return [f"{prefix}{name.removeprefix(prefix)}" for name in names if name]


def _of_person(person: Path, suffixes: Sequence[str], notes: list[str]) -> list[Study]:
    """Return the studies of a participant: one for each session, or one if there are no sessions."""
    if not person.is_dir():
        return [Study(person.name, person, left_out="participants.tsv lists it, but there is no folder")]
    table = person / f"{person.name}_sessions.tsv"
    listed = _listed(table, "session_id", "ses-", notes)
    sessions = sorted({*(path.name for path in person.glob("ses-*") if path.is_dir()), *listed})
    if not sessions:
        return [_study(person, person.name, suffixes)]
    studies = [_study(person / session, f"{person.name}_{session}", suffixes) for session in sessions]
    outside = [path for path in _images(person) if path.relative_to(person).parts[0] not in sessions]
    outside = [path for path in outside if _is_angiography(path.name, suffixes)]
    if outside:
        reason = f"an angiography outside of the sessions: {_names(outside)}; move it into a folder ses-…"
        studies.insert(0, Study(person.name, outside[0].absolute(), left_out=reason))
    return studies


def _study(place: Path, name: str, suffixes: Sequence[str]) -> Study:
    """Return the study of a folder; without an angiography the study is left out."""
    if not place.is_dir():
        return Study(name, place, left_out=f"no folder {place.name} of this session of the table of sessions")
    images = _images(place)
    found = [path for path in images if _is_angiography(path.name, suffixes)]
    if len(found) > 1:
        names = ", ".join(path.name for path in found)
        mend = "name one by --suffix, such as --suffix acq-cta_ct"
        raise FormatError(str(place), f"{len(found)} angiographies: {names}", "one", mend)
    if found:
        return Study(name, found[0].absolute())
    there = f"found {_names(images)}" if images else "found no image"
    return Study(name, place, left_out=f"no name that ends with {_ends(suffixes)}; {there}")


def _images(place: Path) -> list[Path]:
    """Return all files of a folder that may be images, judged by their names."""
    return sorted(path for path in place.rglob("*") if path.name.lower().endswith(_IMAGES))


def _names(paths: Sequence[Path]) -> str:
    more = len(paths) - _MOST_NAMED
    return ", ".join(path.name for path in paths[:_MOST_NAMED]) + (f" and {more} more" if more > 0 else "")


def _ends(suffixes: Sequence[str]) -> str:
    return ", ".join(f"_{suffix}.nii.gz" for suffix in suffixes)


def _is_angiography(name: str, suffixes: Sequence[str]) -> bool:
    lower = name.lower()
    ending = next((ending for ending in _ENDINGS if lower.endswith(ending)), None)
    if ending is None or not lower.startswith("sub-"):
        return False
    stem = lower.removesuffix(ending)
    return any(stem.endswith(f"_{suffix.lower()}") for suffix in suffixes)

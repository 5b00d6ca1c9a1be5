"""A data set of BIDS as a manifest: one angiography of each session, or participant without sessions."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lumencut._files import checked_path
from lumencut.cohort.manifest import Manifest, Study
from lumencut.errors import FileError, FormatError

#: How the names of angiographies end; BIDS has ``angio`` for MR and none for CT so far.
SUFFIXES = ("angio", "cta", "ct")
_ENDINGS = (".nii.gz", ".nii")
_EXPECTED = "a data set of BIDS with folders sub-…"


def read_bids(folder: str | Path, suffixes: Sequence[str] = SUFFIXES, labels: Sequence[str] = ()) -> Manifest:
    """Return the angiographies of a data set of BIDS as studies, by their participants and sessions.

    Parameters
    ----------
    folder : str or path
        The data set.
    suffixes : sequence of str
        How the names of angiographies end before ``.nii.gz``, such as ``angio`` or ``acq-cta_ct``; large
        letters count as small ones.
    labels : sequence of str
        The participants, with or without ``sub-``; all where none is named.

    Returns
    -------
    Manifest
        A study for each session whose folder has an angiography; their vessels are found in the scan.

    Raises
    ------
    FormatError
        For sessions with several angiographies, participants that are not there, and a data set without any.
    FileError
        For a folder that is not there.
    """
    home = checked_path(folder, _EXPECTED)
    if not home.is_dir():
        raise FileError(str(home), "no such folder", _EXPECTED)
    people = sorted(path for path in home.glob("sub-*") if path.is_dir())
    wanted = {f"sub-{label.removeprefix('sub-')}" for label in labels}
    missing = sorted(wanted - {path.name for path in people})
    if missing:
        expected = f"some of its {len(people)} participants"
        raise FormatError(str(home), f"no {' and no '.join(missing)}", expected)
    studies = [
        study
        for person in people
        if not wanted or person.name in wanted
        for place in sorted(person.glob("ses-*")) or [person]
        for study in _studies(place, suffixes)
    ]
    if not studies:
        ends = ", ".join(f"_{suffix}.nii.gz" for suffix in suffixes)
        raise FormatError(
            str(home), "no angiography", f"names that end with {ends}", "name others by --suffix"
        )
    return Manifest(str(home), tuple(studies))


def _studies(place: Path, suffixes: Sequence[str]) -> list[Study]:
    """The study of a session, or none where it has no angiography."""
    found = [path for path in sorted(place.rglob("sub-*.nii*")) if _is_angiography(path.name, suffixes)]
    if len(found) > 1:
        names = ", ".join(path.name for path in found)
        mend = "name one by --suffix, such as --suffix acq-cta_ct"
        raise FormatError(str(place), f"{len(found)} angiographies: {names}", "one", mend)
    name = place.name if place.name.startswith("sub-") else f"{place.parent.name}_{place.name}"
    return [Study(name, path.absolute()) for path in found]


def _is_angiography(name: str, suffixes: Sequence[str]) -> bool:
    ending = next((ending for ending in _ENDINGS if name.endswith(ending)), None)
    if ending is None:
        return False
    stem = name.removesuffix(ending).lower()
    return any(stem.endswith(f"_{suffix.lower()}") for suffix in suffixes)

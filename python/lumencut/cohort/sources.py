"""The scan of a study and its centerlines: read, traced from a mask or points, or found in the scan."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.cohort.manifest import Study
from lumencut.cohort.recipe import Centerlines, Reading
from lumencut.errors import FormatError, LineWarning, TracingError
from lumencut.files.centerline_file import CenterlineFile
from lumencut.files.centerlines import read_centerlines
from lumencut.files.mask_files import MaskFile, open_mask
from lumencut.files.volumes import read_volume
from lumencut.scene.placement import check_meeting
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.tracing.mask_tracing import trace_mask
from lumencut.tracing.seed_tracing import trace_from
from lumencut.tracing.tracer import trace
from lumencut.tracing.vessel_finding import find_vessels

_Points = npt.NDArray[np.float64]


@dataclass(frozen=True)
class StudyVessels:
    """The vessels of a study.

    Attributes
    ----------
    tree : VesselTree
        The certain ones.
    doubtful : tuple of (Vessel, str)
        The uncertain ones, each with its reason.
    """

    tree: VesselTree
    doubtful: tuple[tuple[Vessel, str], ...] = ()

    @classmethod
    def of(cls, *trees: VesselTree) -> StudyVessels:
        """Return the vessels of trees, with the doubtful ones separate."""
        doubtful = [pair for tree in trees for pair in zip(tree.doubtful, tree.doubts, strict=True)]
        # A single tree is kept as it is, because it knows in which space its coordinates are.
        one = trees[0] if len(trees) == 1 else VesselTree([vessel for tree in trees for vessel in tree])
        return cls(one, tuple(doubtful))


def scan_of(study: Study, how: Reading) -> Volume:
    """Read the scan of a study by the manifest and the recipe."""
    return read_volume(study.volume, **reading_of(study, how))


def reading_of(study: Study, how: Reading) -> dict[str, Any]:
    """Return the arguments of :func:`lumencut.read_volume` with which to read the scan of a study."""
    chosen = {name: study.reading.get(name) for name in ("series", "phase")}
    return {**chosen, "fill_gaps": how.fill_gaps, "resample_slices": how.resample_slices}


def vessels_of(study: Study, volume: Volume, how: Centerlines) -> StudyVessels:
    """Return the vessels of a study.

    Raises
    ------
    LumencutError
        For unreadable files, and scans without vessels.
    """
    match study.source:
        case "centerlines":
            tree = read_centerlines(study.given, volume=volume)
            check_meeting(volume, tree)
            return StudyVessels(tree)
        case "mask":
            mask = mask_of(study)
            tree = trace_mask(mask.read(), volume, labels=mask.labels, shortest_branch=how.shortest_branch)
            return StudyVessels(tree)
        case "points":
            return StudyVessels(_along_points(study, volume, how))
        case "seeds":
            return _from_seeds(places_of(study, volume), volume, how)
    return _most_important(find_vessels(volume, smallest_radius=how.smallest_radius), how)


def _most_important(found: VesselTree, how: Centerlines) -> StudyVessels:
    """Return the most important part of the found vessels, or all parts if the recipe asks for them."""
    every = StudyVessels.of(found)
    if how.all_parts or len(found.parts) < 2:
        return every
    return StudyVessels(VesselTree([found[vessel] for vessel in found.parts[0]]), every.doubtful)


def mask_of(study: Study) -> MaskFile:
    """Return the mask of a study, and the labels in it that are lumen.

    Raises
    ------
    SettingsError
        For a label that is neither a value nor a name in the file of the mask.
    FormatError, FileError
        For an unreadable mask.
    """
    words = [word.strip() for word in study.reading.get("label", "").split(";")]
    return open_mask(study.given, [word for word in words if word])


def places_of(study: Study, volume: Volume | None = None) -> _Points:
    """Return the points of a study, shape (n, 3), mm, LPS.

    Raises
    ------
    FormatError
        For invalid text.
    """
    if not study.given_as_text:
        return CenterlineFile(study.given).within(volume, are_lines=False)[0].points
    try:
        written = [place for place in study.given.split(";") if place.strip()]
        return np.array([[float(x) for x in place.split(",")] for place in written]).reshape(-1, 3)
    except ValueError:
        expected = "three numbers x,y,z for each point (mm, LPS), and ; between points"
        raise FormatError(f"{study.source} of {study.id}", f"{study.given!r:.80}", expected) from None


def _along_points(study: Study, volume: Volume, how: Centerlines) -> VesselTree:
    """Return the vessels along points: the manifest holds points of one vessel, a file those of several."""
    if study.given_as_text:
        tree = trace(volume, [places_of(study)], bridge=how.bridge)
    else:
        lines = list(read_centerlines(study.given, volume=volume))
        names = [line.name for line in lines]
        tree = trace(volume, [line.points for line in lines], bridge=how.bridge, names=names)
    for note in tree.notes:
        warnings.warn(LineWarning(note), stacklevel=2)
    return tree


def _from_seeds(seeds: _Points, volume: Volume, how: Centerlines) -> StudyVessels:
    """Return all vessels that the seeds reach; a seed inside vessels already reached adds nothing."""
    trees: list[VesselTree] = []
    for seed in seeds:
        if any(_reaches(tree, seed) for tree in trees):
            continue
        tree = trace_from(volume, seed, smallest_radius=how.smallest_radius)
        # Seeds in the same part give bit-identical vessels, which are kept once.
        if not any(np.array_equal(tree.points, other.points) for other in trees):
            trees.append(tree)
    if not trees:
        raise TracingError("seeds", "no point", "a point in a vessel")
    return StudyVessels.of(*trees)


def _reaches(tree: VesselTree, seed: _Points) -> bool:
    """Return whether a seed lies in the lumen of a vessel of the tree."""
    for vessel in tree:
        distance = np.linalg.norm(vessel.points - seed, axis=1)
        nearest = int(distance.argmin())
        if vessel.radius is not None and distance[nearest] <= vessel.radius[nearest]:
            return True
    return False

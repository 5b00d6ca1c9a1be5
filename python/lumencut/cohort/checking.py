"""Which studies of a manifest will fail, told from the headers of their files before anything runs."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lumencut.centerline_file import CenterlineFile
from lumencut.cohort.manifest import Study
from lumencut.cohort.recipe import Reading
from lumencut.cohort.sources import mask_of, places_of, reading_of
from lumencut.errors import LumencutError
from lumencut.mask_grid import place_within
from lumencut.volume_files import open_volume
from lumencut.volume_files.opened import VolumeFile


def trouble_of(study: Study, how: Reading) -> str:
    """Return why a study will fail, as far as headers tell; empty where they tell nothing against it.

    The voxels of volumes and masks are not read; files of centerlines and points are.
    """
    try:
        volume = open_volume(study.volume, **reading_of(study, how))
        match study.source:
            case "mask":
                return _other_grid(volume, mask_of(study).file)
            case "centerlines":
                CenterlineFile(study.given)
            case "points" | "seeds":
                return _outside(volume, study)
    except LumencutError as error:
        return str(error)
    except Exception as error:
        # A file that its reader does not expect at all fails the study, not the check of all others.
        return f"unexpected {type(error).__name__}: {error}"
    return ""


def _other_grid(volume: VolumeFile, mask: VolumeFile) -> str:
    """Say where the corners of a mask are not those of its volume, to a tenth of a voxel."""
    if mask.is_segmentation:
        place_within(mask, volume)
        return ""
    apart = max(float(np.linalg.norm(_corners(volume) - corner, axis=1).min()) for corner in _corners(mask))
    steps = np.linalg.norm(volume.world_from_index[:3, :3], axis=0)
    if apart <= 0.1 * float(steps.max()):
        return ""
    return f"{mask.path}: found corners up to {apart:.4g} mm beside those of the volume; expected its grid"


def _corners(file: VolumeFile) -> npt.NDArray[np.float64]:
    """The middles of the corner voxels, shape (8, 3), mm, LPS."""
    last = np.array(file.size) - 1
    index = np.stack(np.meshgrid(*((0, end) for end in last), indexing="ij"), axis=-1).reshape(-1, 3)
    return np.asarray(index @ file.world_from_index[:3, :3].T + file.world_from_index[:3, 3])


def _outside(volume: VolumeFile, study: Study) -> str:
    """Say which points lie outside of the volume, or that there are too few."""
    if not study.given_as_text:
        CenterlineFile(study.given)
        return ""
    points = places_of(study)
    if study.source == "points" and len(points) < 2:
        return f"points: found {len(points)}; expected two or more along the vessel"
    inverse = np.linalg.inv(volume.world_from_index)
    index = points @ inverse[:3, :3].T + inverse[:3, 3]
    beyond = ((index < -0.5) | (index > np.array(volume.size) - 0.5)).any(axis=1)
    if not beyond.any():
        return ""
    place = ", ".join(f"{x:g}" for x in points[beyond][0])
    return f"{study.source}: found {place} (mm, LPS), outside of the volume; expected points within it"

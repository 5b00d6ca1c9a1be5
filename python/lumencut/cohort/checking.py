"""Which studies of a manifest will fail, told from the headers of their files before anything runs."""

from __future__ import annotations

import numpy as np

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
                mask = mask_of(study).file
                place_within(mask, volume, always=mask.is_segmentation)
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

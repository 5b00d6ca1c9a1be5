"""A tiny angiography on disk: a bent tube and its centerline."""

from pathlib import Path

import nibabel as nib
import numpy as np

LUMEN, TISSUE = 300, 40
#: Voxels along i, j, k, all of 1 mm; LPS with the first voxel at the origin.
SIZE = (24, 20, 32)


def bent_line():
    """Points of the centerline (mm, LPS), shape (25, 3)."""
    z = np.linspace(3.0, 28.0, 25)
    return np.stack([8.0 + 6.0 * np.sin(z / 8.0), 6.0 + 0.3 * z, z], axis=1)


def write_volume(path: Path) -> Path:
    """Write the tube, of radius 3 mm, as NIfTI."""
    index = np.stack(np.meshgrid(*map(np.arange, SIZE), indexing="ij"), axis=-1).astype(float)
    distance = np.min([np.linalg.norm(index - point, axis=-1) for point in bent_line()], axis=0)
    image = nib.Nifti1Image(
        np.where(distance < 3, LUMEN, TISSUE).astype(np.int16), np.diag([-1.0, -1.0, 1.0, 1.0])
    )
    image.header.set_xyzt_units("mm")
    nib.save(image, path)
    return path


def write_lines(path: Path, points=None, radius=3.0, title="line") -> Path:
    """Write one line as a legacy VTK file."""
    points = bent_line() if points is None else np.asarray(points)
    count = len(points)
    rows = ["# vtk DataFile Version 3.0", title, "ASCII", "DATASET POLYDATA", f"POINTS {count} double"]
    rows += [" ".join(map(str, point)) for point in points]
    rows += [f"LINES 1 {count + 1}", " ".join(map(str, [count, *range(count)]))]
    if radius is not None:
        rows += [f"POINT_DATA {count}", "SCALARS Radius double 1", "LOOKUP_TABLE default"]
        rows += [str(radius)] * count
    path.write_text("\n".join(rows) + "\n")
    return path


def write_volume_of(volume, path: Path) -> Path:
    """Write a volume of the package (mm, LPS) as NIfTI."""
    ras_from_lps = np.diag([-1.0, -1.0, 1.0, 1.0])
    image = nib.Nifti1Image(volume.array.transpose(2, 1, 0), ras_from_lps @ volume.world_from_index)
    image.header.set_xyzt_units("mm")
    nib.save(image, path)
    return path

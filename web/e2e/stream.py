"""Write a real scan as the stream that the page reads, and its centerlines beside it.

The command line names the folder of the shared data and the two files to write. It needs the Python package.
"""

from __future__ import annotations

import json
import shutil
import struct
import sys
from pathlib import Path

import numpy as np

import lumencut


def main() -> None:
    """Write the files."""
    shared, volume_file, axis_file = (Path(name) for name in sys.argv[1:4])
    volume = lumencut.read_volume(shared / "stent-cta/stent_cta.nii.gz")
    voxels = np.ascontiguousarray(volume.array)
    header = json.dumps(
        {
            "version": 1,
            "size": voxels.shape[::-1],
            "dtype": voxels.dtype.name,
            "world_from_index": volume.world_from_index.tolist(),
            "notes": [],
            "name": "scan",
        }
    ).encode()
    header += b" " * (-(12 + len(header)) % 16)
    volume_file.parent.mkdir(parents=True, exist_ok=True)
    volume_file.write_bytes(b"LCVOLUME" + struct.pack("<I", len(header)) + header + voxels.tobytes())
    shutil.copyfile(shared / "stent-cta/centerlines.vtp", axis_file)


if __name__ == "__main__":
    main()

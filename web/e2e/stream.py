"""Write a scan as the stream that the page reads.

The command line names the folder of the shared data, and the files for its scan and centerlines; or it names
the phantom `aorta`, which is written with few voxels, and the file. It needs the Python package.
"""

from __future__ import annotations

import json
import shutil
import struct
import sys
from pathlib import Path

import numpy as np

import lumencut
from lumencut import phantom

SCALE = 0.4


def main() -> None:
    """Write the files."""
    source, volume_file, *axis_files = (Path(name) for name in sys.argv[1:])
    if source == Path("aorta"):
        volume = phantom.aorta(scale=SCALE).volume
    else:
        volume = lumencut.read_volume(source / "stent-cta/stent_cta.nii.gz")
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
    for axis_file in axis_files:
        shutil.copyfile(source / "stent-cta/centerlines.vtp", axis_file)


if __name__ == "__main__":
    main()

"""Programs that check DICOM files of Lumencut: dciodvfy (dicom3tools), and dcmtk as a second reader."""

from __future__ import annotations

import io
import subprocess
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image


def faults(path: Path, kind: str = "Error") -> list[str]:
    """Return the lines of dciodvfy that report errors or warnings, as asked."""
    said = subprocess.run(["dciodvfy", "-new", path], capture_output=True, text=True, errors="replace")
    return [line for line in (said.stdout + said.stderr).splitlines() if line.startswith(kind)]


def seen_by_dcmtk(path: Path, frame: int = 1) -> npt.NDArray[np.uint8]:
    """Return the pixels of a frame as read by dcmtk: (H, W, 3), or (H, W) if grey."""
    command = ["dcm2pnm", "--frame", str(frame), "--write-raw-pnm", path]
    said = subprocess.run(command, capture_output=True, check=True)
    return np.asarray(Image.open(io.BytesIO(said.stdout)))

"""Render a small phantom with the installed package and save the picture.

`make wheel` runs it in an environment with only the package and its requirements. It prints where the package
was found, and fails if the picture does not show the vessels of the phantom.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import lumencut
from lumencut import Camera, Renderer, phantom

#: Lumen of the phantoms, and the tolerance of samples at the centerline (HU).
LUMEN, TOLERANCE = 350.0, 1.0


def main() -> None:
    """Render into the named file."""
    scene = phantom.y_junction()
    frame = Renderer(scene.volume, scene.tree, "cpu").render(Camera.anterior(scene.tree, size=(256, 256)))
    on_centerline = frame.value[frame.distance < scene.volume.spacing[0] / 2]
    if set(np.unique(frame.vessel)) != set(range(len(scene.tree))):
        sys.exit(f"found the vessels {np.unique(frame.vessel)} in the picture; expected all of the phantom")
    if not on_centerline.size or np.abs(on_centerline - LUMEN).max() > TOLERANCE:
        sys.exit(f"found {on_centerline} HU along the centerlines; expected {LUMEN} HU")
    frame.save(Path(sys.argv[1]))
    print(f"lumencut {lumencut.__version__} in {Path(lumencut.__file__).parent} rendered {sys.argv[1]}")


if __name__ == "__main__":
    main()

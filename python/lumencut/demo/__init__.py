"""The CT angiography of the demo: an abdominal aorta with a stent graft, its mesenteric and iliac arteries.

The volume is ``stent.npz`` of imageio 2.9.0 (BSD-2-Clause), downloaded once from the package index, verified
by checksum and cached. Its source states no spacing; 1 mm is nominal. The centerlines (LPS, mm), derived from
it for Lumencut, are part of this package.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
import tempfile
import zipfile
from importlib.resources import as_file, files
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lumencut.base.paths import replace_whole
from lumencut.errors import FormatError, LumencutError

if TYPE_CHECKING:
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

REQUIREMENT = "imageio==2.9.0"
WHEEL_SHA256 = "3604d751f03002e8e0e7650aa71d8d9148144a87daf17cb1f3228e80747f2e6b"
MEMBER = "imageio/resources/images/stent.npz"
MEMBER_SHA256 = "60a83d2296b51ee6a53153e9ba96ba9020391b0c8952895d9d60a0a629ac6bb6"

#: Two points (mm, LPS) on each of three vessels, as a user might click them: aorta to left leg artery, aorta
#: to right leg artery, and the superior mesenteric artery.
STENT_POINTS = (
    ((58, 98, 250), (112, 64, 3)),
    ((58, 98, 250), (1, 69, 12)),
    ((56, 92, 235), (75, 7, 183)),
)

_TIMEOUT_S = 10


class UnreachableError(LumencutError, OSError):
    """The volume of the demo is neither cached nor available from the package index."""


def default_cache() -> Path:
    """Return the user's cache folder of this package."""
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "lumencut"


def stent_scene(cache: Path | None = None) -> tuple[Volume, VesselTree]:
    """Return the volume and the vessel tree of the demo.

    Parameters
    ----------
    cache : Path, optional
        Folder for the volume, created if missing; default: :func:`default_cache`.

    Raises
    ------
    UnreachableError
        If the volume is neither cached nor available.
    FormatError
        If the checksum of a file differs.
    """
    from lumencut.files.centerlines import read_centerlines
    from lumencut.scene.volume import Volume

    content = _checked(*_cached(cache or default_cache()), MEMBER_SHA256)
    voxels = np.load(BytesIO(content), allow_pickle=False)["arr_0"]
    with as_file(files("lumencut.demo") / "stent-centerlines.vtp") as path:
        tree = read_centerlines(path, "lps", unit="mm")
    # The axes [k, j, i] point to head, back and left: the identity in LPS. The anatomy shows it: the aorta
    # divides below, the spine lies behind it, its middle to the right.
    return Volume(voxels, states_spacing=False, states_orientation=True), tree


def demo_scene(cache: Path | None = None) -> tuple[Volume, VesselTree, UnreachableError | None]:
    """Return :func:`stent_scene`; if it is unavailable, a phantom of an aorta and the error."""
    try:
        return *stent_scene(cache), None
    except UnreachableError as error:
        from lumencut.phantom import aorta

        phantom = aorta(scale=0.5)
        return phantom.volume, phantom.tree, error


def _cached(cache: Path) -> tuple[str, bytes]:
    """Return path and content of the cached volume, after downloading it if missing."""
    kept = cache / "stent.npz"
    if not kept.exists():
        content = _checked(f"{MEMBER} of {REQUIREMENT}", _downloaded(), MEMBER_SHA256)
        cache.mkdir(parents=True, exist_ok=True)
        replace_whole(kept, lambda temporary: temporary.write_bytes(content))
    return str(kept), kept.read_bytes()


def _downloaded() -> bytes:
    """Return the volume, extracted from the downloaded package (a wheel)."""
    with tempfile.TemporaryDirectory(prefix="lumencut-") as folder:
        _download(Path(folder))
        wheels = list(Path(folder).glob("*.whl"))
        if len(wheels) != 1:
            raise UnreachableError(REQUIREMENT, f"{len(wheels)} wheels", "one wheel from the package index")
        wheel = _checked(wheels[0].name, wheels[0].read_bytes(), WHEEL_SHA256)
    with zipfile.ZipFile(BytesIO(wheel)) as archive:
        return archive.read(MEMBER)


def _download(folder: Path) -> None:
    command = [sys.executable, "-m", "pip", "download", "--no-deps", "--only-binary=:all:", "--quiet"]
    command += [
        "--disable-pip-version-check",
        "--retries=1",
        f"--timeout={_TIMEOUT_S}",
        "--dest",
        str(folder),
    ]
    done = subprocess.run([*command, REQUIREMENT], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        reasons = [
            line for line in done.stderr.splitlines() if line.startswith("ERROR")
        ] or done.stderr.splitlines()
        found = reasons[-1].removeprefix("ERROR: ") if reasons else f"exit code {done.returncode}"
        raise UnreachableError(REQUIREMENT, found, "a wheel from the package index")


def _checked(name: str, content: bytes, expected: str) -> bytes:
    found = hashlib.sha256(content).hexdigest()
    if found != expected:
        mend = "remove it and run the demo again" if Path(name).exists() else "check the package index in use"
        raise FormatError(name, f"sha256 {found}", f"sha256 {expected}", mend)
    return content

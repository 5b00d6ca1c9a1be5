"""Cohorts of small studies; some of them crash, hang, are damaged or missing."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

import nibabel as nib
import numpy as np
from click.testing import CliRunner

from lumencut.cli import main
from lumencut.cohort import engine
from lumencut.cohort.nursery import Nursery
from scene_files import write_lines, write_volume

#: Code that each child process runs first: files with certain names make it crash or hang.
BROKEN_READING = """
import os, sys, time
def hook(event, arguments):
    if event == "open" and isinstance(arguments[0], (str, bytes, os.PathLike)):
        path = os.fsdecode(arguments[0])
        name = os.path.basename(path)
        if name == "crashing.nii.gz":
            os.abort()
        if name == "hanging.nii.gz":
            time.sleep(1000)
        if name == "sub-full_vessels.csv" and not os.path.exists(path.partition(".lumencut")[0] + "room"):
            raise OSError(28, "No space left on device")
sys.addaudithook(hook)
"""

RECIPE = "[pictures]\nviews = []\n[measure]\nstep = 2.0\n"

#: The studies that must fail, with a part of the stated reason.
BAD = {
    "crashing": "crashed: SIGABRT",
    "greedy": "found voxels that need",
    "hanging": "took longer than",
    "corrupt": "corrupt.nii.gz",
    "missing": "no such file",
}


def write_cohort(folder: Path, good: int = 7, bad: bool = True) -> Path:
    """Write studies with their manifest and recipe into a folder, and return the manifest."""
    volume = write_volume(folder / "tube.nii.gz").read_bytes()
    write_lines(folder / "tube.vtk")
    endings = {"greedy": "nii"}
    names = [f"good-{n}" for n in range(good)]
    if bad:
        names = [name for pair in zip(names, [*BAD, *[""] * good], strict=False) for name in pair if name]
    rows = [["id", "volume", "centerlines", "age"]]
    for number, name in enumerate(names):
        rows.append(
            [
                name,
                f"{name}.{endings.get(name, 'nii.gz')}",
                "" if number == 0 else "tube.vtk",
                str(50 + number),
            ]
        )
        if name not in ("missing", "greedy"):
            (folder / f"{name}.nii.gz").write_bytes(
                volume[: len(volume) // 2] if name == "corrupt" else volume
            )
    if bad:
        write_greedy(folder / "greedy.nii")
    with (folder / "studies.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(rows)
    (folder / "recipe.toml").write_text(RECIPE, encoding="utf-8")
    write_site(folder)
    return folder / "studies.csv"


def write_site(folder: Path) -> None:
    """Write what makes processes crash or hang that have `environment`."""
    site = folder / "site"
    site.mkdir()
    (site / "sitecustomize.py").write_text(BROKEN_READING, encoding="utf-8")


def write_greedy(path: Path) -> None:
    """Write a volume of 4 GB that takes no space on disk, since the file is sparse."""
    header = nib.Nifti1Header()
    header.set_data_shape((1280, 1280, 1280))
    header.set_data_dtype(np.int16)
    header.set_sform(np.eye(4), code=1)
    header.set_xyzt_units("mm")
    header["magic"], header["vox_offset"] = b"n+1", 352
    with path.open("wb") as file:
        file.write(header.binaryblock + bytes(4))
        file.truncate(352 + 2 * 1280**3)


def command(manifest: Path, out: Path, *words: str) -> list[str]:
    """Return the command line of a batch of such a cohort."""
    recipe = manifest.with_name("recipe.toml")
    fixed = ("-o", str(out), "--recipe", str(recipe), "--device", "cpu")
    return [sys.executable, "-m", "lumencut", "batch", str(manifest), *fixed, *words]


def environment(manifest: Path) -> dict[str, str]:
    """Return the environment of such a batch, in whose child processes some files crash or hang."""
    path = os.pathsep.join([str(manifest.parent / "site"), os.environ.get("PYTHONPATH", "")])
    return {**os.environ, "PYTHONPATH": path}


@dataclass(frozen=True)
class Ended:
    returncode: int
    stdout: str
    stderr: str


def run_here(*words: str) -> Ended:
    """Run a command to its end in this process."""
    ended = CliRunner().invoke(main, words, catch_exceptions=False)
    return Ended(ended.exit_code, ended.stdout, ended.stderr)


class _KeptNursery(Nursery):
    """Forks the studies of many batches, since its start takes a second."""

    def close(self) -> None:
        """Do nothing, as other batches follow."""


_kept: list[Nursery] = []


@contextmanager
def kept_nursery(folder: Path):
    """Let the batches of `run` share the process that forks studies."""
    write_site(folder)
    with mock.patch.dict(os.environ, environment(folder / "studies.csv")):
        nursery = _KeptNursery()
    _kept.append(nursery)
    yield
    _kept.remove(nursery)
    Nursery.close(nursery)


def any_nursery() -> Nursery:
    """Return the shared process that forks studies, or a new one if a test does not use it."""
    return _kept[0] if _kept else Nursery()


def run(manifest: Path, out: Path, *words: str) -> Ended:
    """Run a batch to its end in this process; its studies have their own."""
    with (
        mock.patch.dict(os.environ, environment(manifest)),
        mock.patch.object(engine, "Nursery", any_nursery),
    ):
        return run_here(*command(manifest, out, *words)[3:])


@contextmanager
def process(words, **options):
    """Start a process; kill it and those it started when the context ends, also if the test fails."""
    with subprocess.Popen(words, start_new_session=True, **options) as begun:
        try:
            yield begun
        finally:
            # A process that ended by itself has ended its own; its id may already be that of another.
            if begun.poll() is None:
                os.killpg(begun.pid, signal.SIGKILL)


#: After this time a test counts as hanging (s).
HANGS = 300


def wait_for(is_so, process=None):
    """Wait until a condition holds, while a process works."""
    end = time.monotonic() + HANGS
    while not is_so():
        assert time.monotonic() < end, "it did not come"
        assert process is None or process.poll() is None
        time.sleep(0.02)


def table(path: Path) -> list[dict[str, str]]:
    """Return the rows of a table as mappings by column name."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))

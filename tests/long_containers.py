"""Runs the steps of the containers in a plain environment; packages are downloaded."""

from __future__ import annotations

import base64
import hashlib
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import lumencut
from container_steps import ROOT, apptainer_steps, docker_steps


def write_wheel(folder: Path) -> None:
    """Write the current package as a wheel; `make wheel` would take minutes."""
    package = Path(lumencut.__file__).parent
    version = lumencut.__version__
    info = f"lumencut-{version}.dist-info"
    files = {
        f"lumencut/{path.relative_to(package)}": path.read_bytes()
        for path in package.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and "page" not in path.parts
    }
    files[f"{info}/METADATA"] = f"Metadata-Version: 2.1\nName: lumencut\nVersion: {version}\n".encode()
    files[f"{info}/WHEEL"] = (
        b"Wheel-Version: 1.0\nGenerator: tests\nRoot-Is-Purelib: false\nTag: py3-none-any\n"
    )
    files[f"{info}/entry_points.txt"] = b"[console_scripts]\nlumencut = lumencut.cli:main\n"
    rows = [f"{name},sha256={_digest(content)},{len(content)}" for name, content in files.items()]
    files[f"{info}/RECORD"] = "\n".join([*rows, f"{info}/RECORD,,", ""]).encode()
    folder.mkdir()
    # The file name must be as the definitions expect, although the tag inside says any machine.
    with zipfile.ZipFile(folder / f"lumencut-{version}-1_x86_64-py3-none-any.whl", "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)


def _digest(content: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")


@pytest.mark.parametrize("steps", [docker_steps, apptainer_steps], ids=["docker", "apptainer"])
def test_the_steps_install_what_runs(tmp_path, steps):
    home = tmp_path / "opt"
    (home / "requirements").mkdir(parents=True)
    shutil.copy(ROOT / "requirements/runtime.lock", home / "requirements")
    write_wheel(home / "dist")
    plain = tmp_path / "plain"
    subprocess.run([sys.executable, "-m", "venv", plain], check=True)
    kept = {name: value for name, value in os.environ.items() if name.startswith(("PIP_", "SSL_", "HTTP"))}
    path = f"{plain}/bin:/usr/bin:/bin"
    for step in steps():
        words = step.replace("/opt/lumencut", str(home)).replace("*x86_64.whl", "*.whl")
        ended = subprocess.run(
            ["sh", "-ec", words], cwd=home, env={**kept, "PATH": path}, capture_output=True, text=True
        )
        assert ended.returncode == 0, f"{step}\n{ended.stderr}"
    assert ended.stdout == f"lumencut {lumencut.__version__}\n"
    looked = [f"{plain}/bin/lumencut", "info", "--json", str(tmp_path / "none.nii")]
    told = subprocess.run(looked, env={"PATH": path}, capture_output=True, text=True)
    assert "no such file" in told.stdout

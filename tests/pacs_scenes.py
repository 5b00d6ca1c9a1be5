"""A scan in a PACS on this machine, and a user without credentials for any PACS."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from dicom_phantom import save, single
from dicom_series import PLAIN_STACK
from lumencut.cli import main
from pacs_stub import Pacs, running


def write_scan(folder: Path, count: int = 24) -> Path:
    """Write a CT with this number of slices."""
    for k in range(count):
        save(single(PLAIN_STACK[k % len(PLAIN_STACK)], k + 1), folder / f"IM{k:03}.dcm")
    return folder


def forget_user(monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    """Hide the credentials and known addresses of the user who runs the tests."""
    for name in ("TOKEN", "TOKEN_FILE", "CA"):
        monkeypatch.delenv(f"LUMENCUT_DICOMWEB_{name}", raising=False)
    monkeypatch.setenv("NETRC", str(folder / "no-netrc"))
    monkeypatch.setenv("XDG_STATE_HOME", str(folder / "state"))


@contextmanager
def holding(scan: Path) -> Iterator[Pacs]:
    """Run a PACS that has a scan; yield the PACS, the study, the series and the address of the series."""
    with running(Pacs()) as pacs:
        pacs.study, pacs.series = pacs.add(scan)
        pacs.address = f"{pacs.base}/studies/{pacs.study}/series/{pacs.series}"
        yield pacs


def run(*arguments: object, **more: object) -> Result:
    """Run the command line."""
    return CliRunner().invoke(main, [*map(str, arguments)], **more)  # type: ignore[arg-type]


def files(folder: Path) -> list[Path]:
    """All files below a folder."""
    return sorted(path for path in folder.rglob("*") if path.is_file())

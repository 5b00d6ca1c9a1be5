"""SIGTERM and SIGHUP: a command ends at once, removes its files, exits with 128 + the signal's number."""

from __future__ import annotations

import itertools
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from functools import partial

import pytest

from lumencut.base.paths import write_text
from scene_files import write_lines, write_volume

pytestmark = pytest.mark.skipif(os.name != "posix", reason="these signals are those of POSIX")

#: Options of a run that would take many minutes.
LONG = ("--frames", "10000", "--size", "900x900", "--device", "cpu")
LARGE = ("--size", "4000x4000", "--samples", "4", "--device", "cpu", "--verbose")
ENDING = [signal.SIGTERM, signal.SIGHUP]


@pytest.fixture
def files(tmp_path):
    return [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]


@pytest.fixture
def folder(tmp_path):
    """The folder for output."""
    folder = tmp_path / "out"
    folder.mkdir()
    return folder


def handle(how):
    """Handle signals even if the process that started the tests ignores them."""
    for number in ENDING:
        signal.signal(number, how)


@contextmanager
def running(*words, how=signal.SIG_DFL):
    command = [sys.executable, "-m", "lumencut", *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, preexec_fn=partial(handle, how), **pipes) as process:
        try:
            yield process
        finally:
            process.kill()


def wait_for_a_hidden_folder(process, folder):
    for _ in itertools.count():
        if any(path.name.startswith(".lumencut.") for path in folder.iterdir()):
            return
        assert process.poll() is None, process.communicate()
        time.sleep(0.02)


def end(process, number):
    process.send_signal(number)
    _, told = process.communicate(timeout=60)
    assert process.returncode == 128 + number
    assert told.splitlines()[-1] == f"lumencut: ended by {signal.Signals(number).name}"
    assert "Traceback" not in told


@pytest.mark.parametrize("number", ENDING, ids=lambda number: number.name)
@pytest.mark.parametrize(
    ("command", "name"),
    [("turntable", "spin.webp"), ("turntable", "frame-%03d.png"), ("uncurl", "film.webp")],
)
def test_a_film_leaves_nothing_and_keeps_the_file_before(files, folder, command, name, number):
    old = folder / (name if "%" not in name else name % 0)
    old.write_bytes(b"old")
    with running(command, *files, "-o", str(folder / name), *LONG) as process:
        wait_for_a_hidden_folder(process, folder)
        end(process, number)
    assert list(folder.iterdir()) == [old]
    assert old.read_bytes() == b"old"


def test_a_signal_right_after_the_hidden_folder_is_made_leaves_none(folder, monkeypatch):
    made = os.mkdir

    def interrupted(*place, **words):
        made(*place, **words)
        assert [one.name.startswith(".lumencut.") for one in folder.iterdir()] == [True]
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "mkdir", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_text(folder / "out.csv", "text")
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize("number", ENDING, ids=lambda number: number.name)
def test_a_rendering_ends_at_once(files, folder, number):
    with running("render", *files, "-o", str(folder / "out.png"), *LARGE) as process:
        told = list(itertools.takewhile(lambda line: not line.startswith("read in"), process.stderr))
        assert any("VesselTree" in line for line in told), told
        end(process, number)
    assert list(folder.iterdir()) == []


def test_what_is_ignored_stays_ignored(files, folder):
    turning = ("turntable", *files, "-o", str(folder / "spin.webp"), *LONG)
    with running(*turning, how=signal.SIG_IGN) as process:
        wait_for_a_hidden_folder(process, folder)
        process.send_signal(signal.SIGHUP)
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(1)

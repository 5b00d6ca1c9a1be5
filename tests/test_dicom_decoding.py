"""Decoding of DICOM pixels: damaged and empty ones, in separate processes, and by several readers at once."""

from __future__ import annotations

import subprocess
import sys
import threading
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pydicom.uid import JPEG2000Lossless, RLELossless

import lumencut
from conftest import each_value
from dicom_codecs import gdcm_does, pydicom_does
from dicom_phantom import axial, images
from dicom_series import PLAIN_STACK, Stack
from lumencut.base.foreign_errors import refusing
from lumencut.errors import FormatError
from lumencut.files.volumes import read_volume

jpeg = gdcm_does("JPEGLosslessProcess14_1")


@each_value
@pytest.mark.parametrize("encoder", [pydicom_does(JPEG2000Lossless), pydicom_does(RLELossless), jpeg])
@pytest.mark.parametrize("count", [20, 60])
def test_damaged_pixels_are_named_alike_and_leave_no_process(tmp_path, encoder, count):
    Stack(images(axial(), (64, 48, count)), encoder=encoder)(tmp_path)
    path = tmp_path / "IM0018.dcm"
    data = bytearray(path.read_bytes())
    start = data.rfind(b"\xe0\x7f\x10\x00") + 100
    data[start:-10] = np.random.default_rng(1).bytes(len(data) - 10 - start)
    path.write_bytes(data)
    with pytest.raises(FormatError, match=r"IM0018\.dcm: found .*pixels.*; copy the file again") as caught:
        read_volume(tmp_path)
    assert "object has no attribute" not in str(caught.value)
    children = Path(f"/proc/self/task/{threading.get_native_id()}/children")
    assert not children.exists() or "worker" not in "".join(map(_command, children.read_text().split()))


def _command(process):
    return Path(f"/proc/{process}/cmdline").read_text()


@pytest.mark.parametrize("codec", ["JPEGLSLossless", "JPEG2000Lossless"])
def test_empty_slices_may_be_packed_to_nearly_nothing(tmp_path, codec):
    empty = [replace(one, values=np.zeros((1024, 1024), np.int32)) for one in PLAIN_STACK[:3]]
    Stack(empty, encoder=gdcm_does(codec))(tmp_path)
    assert (tmp_path / "IM0001.dcm").stat().st_size < 2000
    assert not read_volume(tmp_path).array.any()


def test_what_progress_raises_is_the_callers(tmp_path):
    class StoppedError(Exception):
        pass

    def progress(done, total):
        if done == 3:
            raise StoppedError

    Stack(PLAIN_STACK, encoder=jpeg)(tmp_path)
    with pytest.raises(StoppedError):
        read_volume(tmp_path, progress=progress)


def test_too_little_memory_is_no_damage():
    with pytest.raises(FormatError, match="more than the free memory holds"), refusing("x", "DICOM", []):
        np.empty(1 << 60, np.uint8)


def test_three_codecs_in_one_series(tmp_path):
    stack = images(axial(), (64, 48, 50))
    encoders = [pydicom_does(JPEG2000Lossless), lambda path: None, pydicom_does(RLELossless), jpeg]
    Stack(stack)(tmp_path)
    for k, path in enumerate(sorted(tmp_path.iterdir())):
        encoders[k % 4](path)
    np.testing.assert_array_equal(read_volume(tmp_path).array, np.stack([one.values for one in stack]))


def test_the_decoders_take_no_module_from_the_current_folder(tmp_path):
    (tmp_path / "scan").mkdir()
    Stack(PLAIN_STACK, encoder=jpeg)(tmp_path / "scan")
    for name in ("json", "numpy", "pydicom", "lumencut"):
        (tmp_path / f"{name}.py").write_text("open('was-here', 'w')")
    home = str(Path(lumencut.__file__).parents[1])
    code = f"import sys; sys.path[0] = {home!r}; import lumencut; print(lumencut.read_volume('scan').size)"
    run = [sys.executable, "-c", code]
    # The reader must not look there either, so its first search path was replaced above.
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["(64,", "48,", "24)"]
    assert not (tmp_path / "was-here").exists()


def test_readers_in_two_threads_leave_warnings_as_they_were():
    before = warnings.showwarning, list(warnings.filters)
    entered, left = threading.Barrier(2), threading.Event()
    found = {"a": [], "b": []}

    def reads(name):
        with refusing(Path(name), "DICOM", found[name]):
            entered.wait()
            warnings.warn(f"of the file {name}", stacklevel=1)
            if name == "b":
                left.wait()
        left.set()

    threads = [threading.Thread(target=reads, args=(name,)) for name in found]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (warnings.showwarning, list(warnings.filters)) == before
    assert found == {"a": ["of the file a"], "b": ["of the file b"]}


def test_warnings_of_others_pass_by_a_reader():
    notes = []
    entered, said = threading.Event(), threading.Event()

    def reads():
        with refusing(Path("x"), "DICOM", notes):
            warnings.warn("an old function of somebody", DeprecationWarning, stacklevel=1)
            entered.set()
            said.wait()

    thread = threading.Thread(target=reads)
    with warnings.catch_warnings(record=True) as told:
        thread.start()
        entered.wait()
        warnings.warn("said outside of readers", stacklevel=1)
        said.set()
        thread.join()
    assert [str(one.message) for one in told] == ["said outside of readers"]
    assert notes == []

"""The budget of the WebAssembly is kept by what a browser loads, and nothing too large passes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from script_modules import SCRIPTS, script

SCRIPT = SCRIPTS / "wasm_size.py"


@pytest.fixture(scope="module")
def wasm_size():
    yield from script("wasm_size")


def section(kind: int, *items: bytes) -> bytes:
    content = (bytes([len(items)]) if kind else b"") + b"".join(items)
    length = len(content)
    return bytes([kind, *(length >> shift & 127 | 128 for shift in (0, 7, 14)), length >> 21]) + content


def module(kept: bytes = b"", describing: bytes = b"", custom: bytes = b"") -> bytes:
    """One imported function, a memory, and two functions of their own: `run` and one that describes."""

    def body(data: bytes) -> bytes:
        # A block of data that is no code: nobody runs it.
        content = b"\0" + data + b"\x0b"
        return bytes([len(content) & 127 | 128, len(content) >> 7 & 127 | 128, len(content) >> 14]) + content

    return b"".join(
        [
            b"\0asm\1\0\0\0",
            section(1, b"\x60\0\0"),
            section(2, b"\x01a\x01f\0\0", b"\x01a\x01m\2\1\1\2", b"\x01a\x01t\1\x70\0\1"),
            section(3, b"\0", b"\0"),
            section(7, b"\x03run\0\1", b"\x17__wbindgen_describe_run\0\2"),
            section(10, body(kept), body(describing)),
            section(0, b"\x04name", custom),
        ]
    )


def judged(path: Path, data: bytes) -> subprocess.CompletedProcess:
    path.write_bytes(data)
    return subprocess.run([sys.executable, SCRIPT, path], capture_output=True, text=True, check=False)


@pytest.fixture
def file(tmp_path) -> Path:
    return tmp_path / "some.wasm"


NOISE = os.urandom(201_000)


def test_a_small_module_passes_with_its_size(file, wasm_size):
    told = judged(file, module())
    assert told.returncode == 0, told.stderr
    assert f"{wasm_size.packed(wasm_size.loaded(module()))} of at most 200,000 bytes" in told.stdout


def test_a_module_that_is_too_large_is_refused(file):
    told = judged(file, module(kept=NOISE))
    assert told.returncode == 1
    assert "expected at most 200,000" in told.stderr


def test_what_no_browser_loads_does_not_count(file, wasm_size):
    assert judged(file, module(describing=NOISE, custom=NOISE)).returncode == 0
    assert wasm_size.loaded(module(describing=NOISE, custom=NOISE)) == wasm_size.loaded(module())
    assert b"__wbindgen_describe" not in wasm_size.loaded(module())
    assert b"run" in wasm_size.loaded(module())


@pytest.mark.parametrize("data", [b"", b"\x7fELF" + bytes(60), module()[:-3], module()[:30]])
def test_what_is_no_module_is_refused(file, data):
    told = judged(file, data)
    assert told.returncode == 1
    assert "WebAssembly module" in told.stderr


def test_a_missing_file_is_refused(tmp_path):
    told = subprocess.run(
        [sys.executable, SCRIPT, tmp_path / "none.wasm"], capture_output=True, text=True, check=False
    )
    assert told.returncode == 1
    assert "none.wasm" in told.stderr

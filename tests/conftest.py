"""Fixtures of all tests."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from lumencut import DeviceError, Renderer
from scenes import wandering

# Other tests run on the CPU, with bit-identical results; `test_device.py` compares the GPU with the CPU.
os.environ.setdefault("LUMENCUT_AUTO_DEVICE", "cpu")

SHARED_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"

needs_shared_data = pytest.mark.skipif(
    not SHARED_DATA.is_dir(), reason="the data folder ../shared/data is not beside the repository"
)

#: For tests whose lines look doubtful on purpose or by chance: they rightly cause a warning.
odd_lines = pytest.mark.filterwarnings("ignore::lumencut.errors.LineWarning")


@pytest.fixture
def shared_data() -> Path:
    """The folder of real volumes and centerlines; for tests marked `needs_shared_data`."""
    return SHARED_DATA


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Make Ctrl-C raise KeyboardInterrupt, even if the process that started the tests ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="module")
def gpu():
    """The name of the GPU; without one these tests are skipped, or fail if LUMENCUT_REQUIRE_GPU is set."""
    try:
        return Renderer(None, wandering(1), "gpu").device
    except DeviceError as error:
        if os.environ.get("LUMENCUT_REQUIRE_GPU"):
            raise
        return pytest.skip(f"no GPU that can be used: {error}")


@pytest.fixture
def any_gpu(gpu, monkeypatch):
    """Let `auto` use a software GPU too."""
    monkeypatch.setenv("LUMENCUT_AUTO_DEVICE", "any")
    return gpu

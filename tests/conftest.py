"""What all tests share."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from lumencut import DeviceError, Renderer
from scenes import wandering

# The other tests are those of the CPU, to the bit; `test_device.py` compares the GPU with it.
os.environ.setdefault("LUMENCUT_AUTO_DEVICE", "cpu")

SHARED_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"

needs_shared_data = pytest.mark.skipif(
    not SHARED_DATA.is_dir(), reason="the data folder ../shared/data is not beside the repository"
)

#: For tests whose lines are odd on purpose or by chance: that they are doubted is right.
odd_lines = pytest.mark.filterwarnings("ignore::lumencut.errors.LineWarning")


@pytest.fixture
def shared_data() -> Path:
    """The folder of real volumes and centerlines; for tests marked `needs_shared_data`."""
    return SHARED_DATA


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Ctrl-C raises KeyboardInterrupt, even where whoever started the tests ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="module")
def gpu():
    """The name of the GPU; tests with it are left out where there is none, unless that is forbidden."""
    try:
        return Renderer(None, wandering(1), "gpu").device
    except DeviceError as error:
        if os.environ.get("LUMENCUT_REQUIRE_GPU"):
            raise
        return pytest.skip(f"no GPU that can be used: {error}")


@pytest.fixture
def any_gpu(gpu, monkeypatch):
    """Where `auto` takes a GPU of software too."""
    monkeypatch.setenv("LUMENCUT_AUTO_DEVICE", "any")
    return gpu

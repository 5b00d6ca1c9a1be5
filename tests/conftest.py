"""Fixtures of all tests."""

import os
import signal
import sys
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


#: In ``make test``, each value of each parameter is tried once; ``make test-long`` tries all combinations.
each_value = pytest.mark.each_value


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--wide", action="store_true", help="try all combinations of the tests marked each_value"
    )


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Of a test marked `each_value`, keep few combinations of its parameters, in which each value occurs."""
    cases: dict[str, list[pytest.Item]] = {}
    for item in items:
        if item.get_closest_marker("each_value") and not config.getoption("wide"):
            cases.setdefault(item.nodeid.partition("[")[0], []).append(item)
    left_out = [item for group in cases.values() for item in without_news(group)]
    config.hook.pytest_deselected(items=left_out)
    gone = set(map(id, left_out))
    items[:] = [item for item in items if id(item) not in gone]


def without_news(cases: list[pytest.Item]) -> list[pytest.Item]:
    """Return the cases whose values occur in other cases too, and those beyond the most asked for."""
    values = {id(case): {(name, id(one)) for name, one in case.callspec.params.items()} for case in cases}
    unseen, left = set().union(*values.values()), list(cases)
    while unseen:
        best = max(left, key=lambda case: len(values[id(case)] & unseen))
        left.remove(best)
        unseen -= values[id(best)]
    kept = [case for case in cases if not any(case is other for other in left)]
    most = cases[0].get_closest_marker("each_value").kwargs.get("most", len(kept))
    return left + kept[most:]


@pytest.fixture
def shared_data() -> Path:
    """The folder of real volumes and centerlines; for tests marked `needs_shared_data`."""
    return SHARED_DATA


@pytest.fixture
def one_decoder(monkeypatch: pytest.MonkeyPatch) -> None:
    """Start one process that decodes DICOM pixels; `test_dicom_decoding.py` tries several at once."""
    monkeypatch.setattr("lumencut.dicom.reading.workers._MOST", 1)


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Make Ctrl-C raise KeyboardInterrupt, even if the process that started the tests ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def nursery(tmp_path_factory):
    """One process that forks the studies of all batches of `cohort_scenes.run`; on Linux alone."""
    from cohort_scenes import kept_nursery

    if sys.platform != "linux":
        yield
        return
    with kept_nursery(tmp_path_factory.mktemp("nursery")):
        yield


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

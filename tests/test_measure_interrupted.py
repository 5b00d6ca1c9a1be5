"""Ctrl-C while a Python process measures, and its progress."""

import sys

import pytest

import lumencut
from interrupted import ends_by_ctrl_c
from lumencut import phantom

#: A process that measures without end; it prints when it starts, and what ended it.
MEASURES = """
import signal
import lumencut
from lumencut import phantom
signal.signal(signal.SIGINT, signal.default_int_handler)
made = phantom.stenosis()
kept = lumencut.Measurements(made.volume, made.tree, 0.004)
ways = {
    "measure": lambda told: lumencut.measure(made.volume, made.tree[0], 0.004, tree=made.tree, progress=told),
    "tree": lambda told: made.tree.measured(made.volume, 0.004, progress=told),
    "measurements": lambda told: kept.profile(0, progress=told),
}
def told(done, total):
    if 0 < done < total:
        print("measuring", flush=True)
try:
    while True:
        ways[WAY](told)
        kept = lumencut.Measurements(made.volume, made.tree, 0.004)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no signal of its own for a process here")
@pytest.mark.parametrize("way", ["measure", "tree", "measurements"])
def test_ctrl_c_ends_a_process_that_measures(way):
    ends_by_ctrl_c(MEASURES.replace("WAY", repr(way)), "measuring")


def test_measurements_tell_how_far_they_are():
    made, told = phantom.stenosis(), []
    kept = lumencut.Measurements(made.volume, made.tree, 0.1, 1.0)
    profile = kept.profile(0, progress=lambda done, total: told.append((done, total)))
    done = [part for part, _ in told]
    assert done == sorted(done)
    assert told[-1] == (1000, 1000)
    assert any(0 < part < 1000 for part in done)
    assert (profile.area == lumencut.Measurements(made.volume, made.tree, 0.1, 1.0).profile(0).area).all()

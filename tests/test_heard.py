"""Long calls of the extension module check for signals, so a signal handler runs during the call."""

from __future__ import annotations

import signal
import sys

import numpy as np
import pytest

import lumencut
from lumencut import phantom

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="no timers of the process there")

TUBE = phantom.straight_tube()
VESSEL = TUBE.tree[0]


def curved(mode, pixel_spacing):
    """Lay out a large CPR in the extension module."""
    return lumencut.cpr(TUBE.volume, VESSEL, mode, width=40, pixel_spacing=pixel_spacing)._core


def front(side):
    return lumencut.Camera.fitted(TUBE.tree, (0, 1, 0), (0, 0, 1), size=(side, side))


def depth(side):
    return np.zeros((side, side), np.float32)


#: For each name, a preparation and the call of the extension module that uses it; both take longer with the
#: number of steps along a side.
CALLS = {
    "phantom": (lambda n: 0.5 * n, lambda scale: phantom.aorta(scale=scale)),
    "position": (lambda n: curved("stretched", 0.02 / n), lambda core: core.position()),
    "folded": (lambda n: curved("straightened", 0.01 / n), lambda core: core.folded()),
    "spiral": (
        lambda n: lumencut.spiral(TUBE.volume, VESSEL, pixel_spacing=0.05 / n)._core,
        lambda c: c.position(),
    ),
    "map": (
        lambda n: lumencut.lumen_map(TUBE.volume, VESSEL, pixel_spacing=0.02 / n)._core,
        lambda c: c.shades(),
    ),
    "untangled": (
        lambda n: lumencut.untangled(TUBE.volume, TUBE.tree, pixel_spacing=0.02 / n)._core,
        lambda core: core.vessel(),
    ),
    "uncurl": (
        lambda n: lumencut.uncurl(TUBE.volume, VESSEL, front(2048 * n), 0.5)._core,
        lambda core: core.position(),
    ),
    "picture": (
        lambda n: (depth(4096 * n), lumencut.Settings(window=lumencut.Window(100, 500))._checked),
        lambda given: lumencut._lumencut.picture(*given),
    ),
    "positions": (
        lambda n: (front(2048 * n), depth(2048 * n)),
        lambda given: lumencut._lumencut.positions(*given),
    ),
    "sample": (
        lambda n: np.random.default_rng(1).uniform(-10, 10, (2_000_000 * n * n, 3)),
        lambda points: lumencut._lumencut.sample(TUBE.volume, points),
    ),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_signal_is_heard_in_the_midst_of_a_call(name):
    # Signals that arrive before the first check are handled once after the call, and perhaps once before.
    prepare, call = CALLS[name]
    heard = []
    before = signal.signal(signal.SIGALRM, lambda number, frame: heard.append(number))
    try:
        for n in (1, 1, 2, 3):
            # A fast machine needs a longer call.
            given = prepare(n)
            heard.clear()
            signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)
            call(given)
            signal.setitimer(signal.ITIMER_REAL, 0)
            if len(heard) > 2:
                return
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    pytest.fail(f"{len(heard)} times")

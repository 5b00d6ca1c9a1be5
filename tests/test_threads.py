"""Renderers next to other threads of Python, and Ctrl-C."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

from lumencut import Camera, Renderer, Settings, Vessel, VesselTree
from scenes import wandering

FINEST = Settings(levels=0, depth_filter=False)
#: How often another thread must run during the rendering before it sends the signal.
LOOKS = 5


def endless_tree():
    """A flat tree whose lumens cover everything: all pieces tie at all pixels, which takes minutes."""
    flat = [vessel.points * (1, 0, 1) for vessel in wandering(0, vessels=4000)]
    return VesselTree([Vessel(points, 1e5) for points in flat])


@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_ends_a_rendering_and_the_renderer_goes_on():
    renderer, fresh = (Renderer(None, endless_tree()) for _ in range(2))
    large = Camera.anterior(renderer.tree, (3000, 3000))
    main, ended, looks = threading.get_ident(), threading.Event(), []

    def interrupt_once_it_runs():
        # This thread runs only if the rendering lets other threads of Python run.
        while len(looks) < LOOKS and not ended.wait(0.02):
            if sys._current_frames()[main].f_code.co_name == "cut_surface":
                looks.append(True)
        if len(looks) == LOOKS:
            signal.raise_signal(signal.SIGINT)
            looks.append(ended.wait(10))

    thread = threading.Thread(target=interrupt_once_it_runs)
    thread.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            renderer.cut_surface(large, FINEST)
    finally:
        ended.set()
        thread.join()
    assert looks == [True] * (LOOKS + 1)
    small = Camera.anterior(renderer.tree, (9, 7))
    again, expected = (one.cut_surface(small, FINEST) for one in (renderer, fresh))
    for name in ("depth", "vessel", "distance"):
        np.testing.assert_array_equal(getattr(again, name), getattr(expected, name))


SHARED = """
from concurrent.futures import ThreadPoolExecutor
import numpy as np
from lumencut import Camera, Renderer, Settings, phantom
made = phantom.helix()
renderer = Renderer(made.volume, made.tree)
front = Camera.anterior(made.tree, (75, 65))
views = [(front.rotated(0.3 * n), Settings(levels=n % 7, lumen_first=n % 2 == 0)) for n in range(24)]
expected = [renderer.render(*view) for view in views]
with ThreadPoolExecutor(4) as pool:
    found = list(pool.map(lambda view: renderer.render(*view), views * 10))
for frame, other in zip(found, expected * 10, strict=True):
    for name in ("image", "depth", "vessel", "distance", "value"):
        np.testing.assert_array_equal(getattr(frame, name), getattr(other, name))
"""


def test_threads_may_share_a_renderer():
    # In a separate process, so that a deadlock of threads fails the test.
    subprocess.run([sys.executable, "-c", SHARED], check=True, timeout=120)


FORKED = """
import os, sys, warnings
import numpy as np
from lumencut import Camera, Renderer, Vessel, VesselTree, phantom
warnings.simplefilter("ignore")
renderer = Renderer(None, VesselTree([Vessel(np.random.default_rng(0).normal(0, 30, (90, 3)), 2.0)]))
camera = Camera.anterior(renderer.tree, size=(200, 200))
before = renderer.cut_surface(camera).depth
child = os.fork()
if child == 0:
    same = np.array_equal(before, renderer.cut_surface(camera).depth)
    phantom.straight_tube()
    os._exit(0 if same else 1)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_a_forked_process_renders_too():
    subprocess.run([sys.executable, "-c", FORKED], check=True, timeout=60)

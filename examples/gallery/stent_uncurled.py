"""Uncurl: a vessel becomes straight.

The path through the graft straightens step by step, with the tissue next to it. Lengths stay true.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
path = tree.path([0, 1, 2])
first = lumencut.uncurl(volume, path, lumencut.Camera.left(path, size=(320, 420)))
amounts = np.concatenate([np.zeros(6), np.linspace(0, 1, 24), np.ones(6)])
film = [Image.fromarray(first.changed(float(amount)).image) for amount in amounts]
film[0].save("stent_uncurled.webp", save_all=True, append_images=film[1:], duration=80, loop=0)

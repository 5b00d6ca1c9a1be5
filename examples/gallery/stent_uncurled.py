"""How a vessel becomes straight: uncurl.

The way through the graft and what lies beside it, straightened by degrees. Lengths are true all the while.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
way = tree.path([0, 1, 2])
first = lumencut.uncurl(volume, way, lumencut.Camera.left(way, size=(320, 420)))
amounts = np.concatenate([np.zeros(6), np.linspace(0, 1, 24), np.ones(6)])
film = [Image.fromarray(first.changed(float(amount)).image) for amount in amounts]
film[0].save("stent_uncurled.webp", save_all=True, append_images=film[1:], duration=80, loop=0)

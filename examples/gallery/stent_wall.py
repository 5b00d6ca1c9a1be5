"""Lumen map: the wall unrolled.

The wall of the same path, cut open along its length. Left: the largest values at the wall show every strut.
Right: the distance of the wall from the centerline. The hole is the opening of the other limb.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
wall = lumencut.lumen_map(volume, tree.path([0, 1, 2]), pixel_spacing=0.3, tree=tree)
Image.fromarray(np.hstack([wall.image, wall.changed("radius").image])).save("stent_wall.webp")

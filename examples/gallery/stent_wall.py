"""The wall unrolled: lumen map.

The wall of the same way, cut open along it: the largest values at the wall with every strut, and how far
the wall is from the centerline. The hole is the opening of the other limb.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
wall = lumencut.lumen_map(volume, tree.path([0, 1, 2]), pixel_spacing=0.3, tree=tree)
Image.fromarray(np.hstack([wall.image, wall.changed("radius").image])).save("stent_wall.webp")

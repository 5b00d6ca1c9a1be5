"""One path straightened, from all sides.

From the aorta through the graft into the left leg. Left: one cut. Middle: the largest values of each half
circle show all struts. Right: the smallest values show the lumen that is open on all sides.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
path = tree.path([0, 1, 2])
cut = lumencut.cpr(volume, path, "straightened", width=30, pixel_spacing=0.4)
around = [lumencut.cfa(volume, path, radius=15, feature=kind, pixel_spacing=0.4) for kind in ("max", "min")]
Image.fromarray(np.hstack([cut.image, *(one.image for one in around)])).save("stent_straightened.webp")

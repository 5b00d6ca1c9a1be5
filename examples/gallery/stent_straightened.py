"""One way straightened, and all around it.

From the aorta through the graft into the left leg: one cut (left), the largest values of each half circle,
all struts at once (middle), and the smallest ones, the lumen that is open on all sides (right).
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
way = tree.path([0, 1, 2])
cut = lumencut.cpr(volume, way, "straightened", width=30, pixel_spacing=0.4)
around = [lumencut.cfa(volume, way, radius=15, feature=kind, pixel_spacing=0.4) for kind in ("max", "min")]
Image.fromarray(np.hstack([cut.image, *(one.image for one in around)])).save("stent_straightened.webp")

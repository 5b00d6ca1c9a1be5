"""Endoscopy: the stent graft from inside.

The wall of the aorta and the stent graft, seen by an eye in the lumen. Left: above the graft, with the
opening of the mesenteric artery. Right: in the graft. Metal and calcium are white.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
above = lumencut.endoscopy(volume, tree.path([0, 1, 2]), 20.0, size=(384, 384), tree=tree)
Image.fromarray(np.hstack([above.image, above.changed(60.0).image])).save("stent_inside.webp")

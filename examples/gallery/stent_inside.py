"""Endoscopy: the stent graft from inside.

The wall of the aorta and the stent graft, seen by an eye in the lumen. Left: above the graft, with the opening of
the mesenteric artery. Right: in the graft, towards its two limbs. Metal and calcium are white.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
above = lumencut.endoscopy(volume, tree.path([0, 1, 2]), 10.0, size=(384, 384), tree=tree)
views = [above, above.changed(90.0)]
pictures = [view.annotated()[..., :3] for view in views]
Image.fromarray(np.hstack(pictures)).save("stent_inside.webp")

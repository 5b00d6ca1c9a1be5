"""Untangled CPR: a tree without overlap.

One map shows every vessel cut open, with true lengths and without overlap. Branches are rotated by the
smallest angle that separates them, so angles between vessels are not those of the body.
"""

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
camera = lumencut.Camera.left(tree)
made = lumencut.untangled(volume, tree, camera, pixel_spacing=0.45, slab=(4, "mean"))
made.save("stent_untangled.webp")

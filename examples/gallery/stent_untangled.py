"""A tree without overlap: untangled CPR.

Every vessel is cut open in one map, none before another, with true lengths. Branches are turned by as little
as that takes, so angles between vessels are not those of the body.
"""

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
camera = lumencut.Camera.left(tree)
made = lumencut.untangled(volume, tree, camera, pixel_spacing=0.45, slab=(4, "mean"))
made.save("stent_untangled.webp")

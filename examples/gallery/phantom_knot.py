"""A vessel that is knotted.

A phantom, made from a formula: a trefoil knot with a wall of calcium. Where two stretches cross, the nearer
one is in front.
"""

import lumencut
from lumencut import phantom

knot = phantom.trefoil()
camera = lumencut.Camera.anterior(knot.tree, size=(560, 560))
lumencut.render(knot.volume, knot.tree, camera).save("phantom_knot.webp")

"""A knotted vessel.

A phantom from a formula: a trefoil knot with a calcified wall. Where it crosses itself, the nearer part is
in front.
"""

import lumencut
from lumencut import phantom

knot = phantom.trefoil()
camera = lumencut.Camera.anterior(knot.tree, size=(560, 560))
lumencut.render(knot.volume, knot.tree, camera).save("phantom_knot.webp")

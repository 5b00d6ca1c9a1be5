"""A view that turns.

One view shows one diameter. Judge an eccentric stenosis from all sides.
"""

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
renderer = lumencut.Renderer(volume, tree)
camera = lumencut.fitted_turn(lumencut.Camera.anterior(tree, size=(320, 420)), tree)
lumencut.save_animation(lumencut.turntable(renderer, camera, frames=36), "stent_turning.webp")

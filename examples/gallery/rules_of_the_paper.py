"""The rules of the paper and those of Lumencut.

The graft from below, by the rules of the paper (left) and of Lumencut (right). With the latter,
surroundings of a near vessel never hide the lumen behind them.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
renderer = lumencut.Renderer(volume, tree)
camera = lumencut.Camera.inferior(tree, size=(420, 420))
rules = (lumencut.Settings.paper(), lumencut.Settings())
pictures = [renderer.render(camera, settings).image for settings in rules]
Image.fromarray(np.hstack(pictures)).save("rules_of_the_paper.webp")

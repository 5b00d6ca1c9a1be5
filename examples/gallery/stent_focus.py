"""The exact cut with the body around it.

The grey cut shows the exact inside of the vessels. The shaded body shows where each vessel lies.
"""

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
camera = lumencut.Camera.left(tree, size=(400, 560))
lumencut.render(volume, tree, camera, lumencut.Settings.focused()).save("stent_focus.webp")

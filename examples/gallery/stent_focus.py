"""The exact cut amid the body.

The grey cut shows the inside of the vessels exactly, and the body around them is shaded: where a vessel
lies is seen at once.
"""

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
camera = lumencut.Camera.left(tree, size=(400, 560))
lumencut.render(volume, tree, camera, lumencut.Settings.focused()).save("stent_focus.webp")

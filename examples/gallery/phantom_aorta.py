"""Fifty vessels in one picture.

A phantom of the aorta with the arteries of the bowel, the kidneys and the pelvis. Its tree is known
exactly.
"""

import lumencut
from lumencut import phantom

body = phantom.aorta(scale=0.5)
camera = lumencut.Camera.anterior(body.tree, size=(560, 560))
lumencut.render(body.volume, body.tree, camera, lumencut.Settings.focused()).save("phantom_aorta.webp")

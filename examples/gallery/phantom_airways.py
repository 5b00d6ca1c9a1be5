"""Airways, found and cut open.

A phantom of airways in lung: lumens darker than their walls, cut open amid the smallest values along each ray.
"""

import lumencut
from lumencut import phantom

airways = phantom.airways()
tree = lumencut.find_vessels(airways.volume, polarity="dark")
print(tree.notes[0])

settings = lumencut.Settings(focus=lumencut.Focus(), context="minip", window="lung")
renderer = lumencut.Renderer(airways.volume, tree)
renderer.render(lumencut.Camera.anterior(tree, size=(900, 700)), settings=settings).save("phantom_airways.webp")

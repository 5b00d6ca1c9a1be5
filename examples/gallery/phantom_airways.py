"""Airways, found and cut open.

A phantom of airways in lung, cut open amid the smallest values along each ray.
"""

import lumencut
from lumencut import phantom

airways = phantom.airways()
tree = lumencut.find_vessels(airways.volume, polarity="dark")
print(tree.notes[0])

settings = lumencut.Settings(focus=lumencut.Focus(), context="minip", window="lung")
camera = lumencut.Camera.anterior(tree, size=(900, 700))
lumencut.render(airways.volume, tree, camera, settings).save("phantom_airways.webp")

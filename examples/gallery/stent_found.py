"""From a scan alone.

Left: a maximum intensity projection of the scan. Right: the vessels that Lumencut found in it without any
point, cut open.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, _ = demo.stent_scene()
tree = lumencut.find_vessels(volume)
camera = lumencut.Camera.anterior(tree, size=(320, 560))
scan = lumencut.render(volume, None, camera, lumencut.Settings(context="mip"))
plain = lumencut.Settings(window=lumencut.Window(level=275, width=650), silhouettes=False)
cut = lumencut.render(volume, tree, camera, plain)
Image.fromarray(np.hstack([scan.image, cut.image])).save("stent_found.webp")

"""All vessels cut open in one view.

An aorta with a stent graft, from the front and obliquely from the left. Every lumen has its true width, and
stent struts are white. Yellow lines mark jumps in the depth of the cut.
"""

import numpy as np
from PIL import Image

import lumencut
from lumencut import demo

volume, tree = demo.stent_scene()
renderer = lumencut.Renderer(volume, tree)
anterior = lumencut.Camera.anterior(tree, size=(320, 560))
turned = anterior.rotated(degrees=55)
oblique = lumencut.Camera.fitted(tree, turned.direction, turned.up, size=(320, 560))
pictures = [renderer.render(camera).image for camera in (anterior, oblique)]
Image.fromarray(np.hstack(pictures)).save("stent_views.webp")

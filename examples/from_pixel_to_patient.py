"""What a pixel shows: its vessel, its depth, and its place in the patient.

Every picture comes with images of the same size that give the place of each pixel (LPS, mm).
"""

import lumencut
from lumencut import phantom

scene = phantom.crossing()
frame = lumencut.render(scene.volume, scene.tree, lumencut.Camera.anterior(scene.tree, size=(200, 200)))
row, column = 100, 60
left, posterior, superior = frame.position[row, column]
name = scene.tree[int(frame.vessel[row, column])].name
print(f"pixel {column}, {row}: {name}, {frame.depth[row, column]:.1f} mm deep")
print(f"in the patient: {left:.1f} mm to the left, {posterior:.1f} mm back, {superior:.1f} mm up")
frame.save("crossing.npz")

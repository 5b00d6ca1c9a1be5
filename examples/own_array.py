"""A picture from your own array.

Lumencut can show any array of voxels with known spacing. Vessels are points with radii (mm).
"""

import numpy as np

import lumencut

# A bright tube along z, 6 mm wide, in voxels of 0.5 mm; the array is indexed [z, y, x].
z, y, x = np.indices((120, 60, 60)) * 0.5
voxels = np.where(np.hypot(x - 15.0, y - 15.0) < 3.0, 300, 40).astype(np.int16)
volume = lumencut.Volume(voxels, spacing=(0.5, 0.5, 0.5), origin=(0.0, 0.0, 0.0))

line = np.column_stack([np.full(100, 15.0), np.full(100, 15.0), np.linspace(5.0, 55.0, 100)])
tree = lumencut.VesselTree([lumencut.Vessel(line, radius=3.0, name="tube")])

frame = lumencut.render(volume, tree)
frame.save("own_array.png", annotate=True)
height, width = frame.value.shape
print(f"the value in the middle is {frame.value[height // 2, width // 2]:.0f}")

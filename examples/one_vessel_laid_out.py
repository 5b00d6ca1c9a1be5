"""One straightened vessel.

The straightened CPR shows the trunk of a junction and one of its branches as one path. Every pixel has a
place in the patient.
"""

import lumencut
from lumencut import phantom

scene = phantom.y_junction()
path = scene.tree.path([0, 1])
made = lumencut.cpr(scene.volume, path, "straightened", slab=(2, "mean"))
made.save("path.png")
made.rotated(degrees=90).save("path-90.png")
[place] = made.world_from_pixel([[made.image.shape[1] / 2, 25.0]])
print(f"row 25 is {made.arc_length[25]:.1f} mm along the path, at {place.round(1).tolist()}")

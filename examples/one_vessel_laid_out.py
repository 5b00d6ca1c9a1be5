"""One vessel laid out, and which place of it each row shows.

The straightened CPR of a junction's trunk and one of its branches as one way, with the place in the patient
of any pixel.
"""

import lumencut
from lumencut import phantom

scene = phantom.y_junction()
way = scene.tree.path([0, 1])
made = lumencut.cpr(scene.volume, way, "straightened", slab=(2, "mean"))
made.save("way.png")
made.rotated(degrees=90).save("way-90.png")
[place] = made.world_from_pixel([[made.image.shape[1] / 2, 25.0]])
print(f"row 25 is {made.arc_length[25]:.1f} mm along the way, at {place.round(1).tolist()}")

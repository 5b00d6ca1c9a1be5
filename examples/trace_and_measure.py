"""From two points to a table of diameters.

`trace` follows the vessel between two points, and `measure` returns a row per section with its uncertainty.
"""

import lumencut
from lumencut import phantom

scan = phantom.helix()
ends = scan.tree[0].points[[10, -10]]
tree = lumencut.trace(scan.volume, ends)
lumencut.write_centerlines(tree, "helix.vtp")

profile = lumencut.measure(scan.volume, tree[0])
profile.save("helix.csv")
middle = len(profile.arc_length) // 2
diameter, deviation = profile.diameter_equivalent[middle], profile.uncertainty[middle]
print(f"{tree[0].length:.0f} mm long; in the middle {diameter:.2f} ± {deviation:.2f} mm wide")

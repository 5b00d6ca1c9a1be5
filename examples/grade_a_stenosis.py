"""Grade a stenosis.

The percentage always comes with its method. The narrowest place and the references are suggestions: check
the section before you rely on one.
"""

import lumencut
from lumencut import phantom

tube = phantom.stenosis(percent=60.0)
profile = lumencut.measure(tube.volume, tube.tree[0])
narrowest = profile.narrowest()
assert narrowest is not None, "no section is reliable"
at = narrowest.arc_length
references = [one.arc_length for one in profile.suggested_references(at) if one is not None]
print(profile.stenosis(at, references))
print(profile.stenosis(at, references, method="area"))

section = lumencut.cross_section(tube.volume, tube.tree[0], at, profile=profile)
middle = section.value[len(section.value) // 2]
print(f"{int((middle > 200).sum())} pixels of {section.pixel_spacing:.2f} mm across the stenosis")

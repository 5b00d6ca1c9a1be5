"""Errors that name a remedy.

An error states what was found, what was expected and what mends it. Each is a `LumencutError` and also one
of Python's own errors, so programs can distinguish them.
"""

import numpy as np

import lumencut

try:
    lumencut.Volume(np.zeros((8, 8, 8), np.int16), spacing=(0.5, 0.5, -1.0))
except lumencut.VolumeError as error:
    print(f"{error.subject}: found {error.found}, expected {error.expected}")
    print("remedy:", error.advice or "another value")
else:
    raise SystemExit("a negative spacing was accepted")

"""Errors say what was found, what was expected, and what mends it.

Each is a `LumencutError`, and one of Python's own errors too, so that programs can tell them apart.
"""

import numpy as np

import lumencut

try:
    lumencut.Volume(np.zeros((8, 8, 8), np.int16), spacing=(0.5, 0.5, -1.0))
except lumencut.VolumeError as error:
    print(f"{error.subject}: found {error.found}, expected {error.expected}")
    print("what mends it:", error.advice or "nothing but another value")
else:
    raise SystemExit("a spacing below zero was taken")

"""Compares frames of the GPU with frames of the CPU: how many pixels may differ, and by how much."""

from __future__ import annotations

from typing import Any

import numpy as np

from image_comparison import compare

#: For each image: the tolerance (mm, ids, HU, of 255), and the share of pixels that may exceed it.
LIMITS = {
    "depth": ((1e-3, 1e-3),),
    "distance": ((1e-3, 1e-3),),
    "vessel": ((0, 1e-3),),
    "value": ((0.1, 1e-3),),
    "context": ((1, 5e-4), (4, 1e-4)),
    "image": ((1, 5e-4), (4, 1e-4)),
}


def excess(found: Any, expected: Any) -> dict[str, str]:
    """Return in words what exceeds `LIMITS`, by the name of the image."""
    worse = {}
    for name, limits in LIMITS.items():
        if not expected.has(name):
            if found.has(name):
                worse[name] = "should not be there"
            continue
        one, other = getattr(found, name), getattr(expected, name)
        assert not np.shares_memory(one, other), f"{name} is compared with itself"
        pixels = one.shape[0] * one.shape[1]
        for tolerance, share in limits:
            result = compare(one, other, tolerance)
            if result.count > share * pixels:
                worse[name] = (
                    f"{result.count} of {pixels} pixels differ by more than {tolerance}, by {result.largest}"
                )
    return worse


def assert_alike(found: Any, expected: Any) -> None:
    """Fail if frames differ by more than `LIMITS` allow."""
    worse = excess(found, expected)
    assert not worse, worse

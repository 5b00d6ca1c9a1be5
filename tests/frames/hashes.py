"""Hashes of the arrays of frames, and the differences between two files of hashes."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Arrays = dict[str, npt.NDArray[Any]]
"""Arrays by their names."""
Hashes = dict[str, dict[str, Any]]
"""For each array its hash, its shape and its type."""


def hashed(arrays: Arrays) -> Hashes:
    """The hashes of some arrays."""
    return {
        name: {
            "sha256": hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest(),
            "shape": list(array.shape),
            "dtype": array.dtype.str,
        }
        for name, array in arrays.items()
    }


def unequal(one: Hashes, other: Hashes) -> dict[str, str]:
    """For each array that differs, the difference in words."""
    names = dict.fromkeys([*one, *other])
    return {
        name: _change(one.get(name), other.get(name)) for name in names if one.get(name) != other.get(name)
    }


def _change(one: Mapping[str, Any] | None, other: Mapping[str, Any] | None) -> str:
    if one is None or other is None:
        return "only in the first file" if one else "only in the second file"
    for key in ("shape", "dtype"):
        if one[key] != other[key]:
            return f"{key} {one[key]} and {other[key]}"
    return "bytes differ"


def compare_kind(kind: str, one: dict[str, Hashes], other: dict[str, Hashes]) -> bool:
    """Print the number of equal scenes or frames and each difference; return whether all are equal."""
    arrays, different_arrays, different = 0, 0, {}
    names = dict.fromkeys([*one, *other])
    for name in names:
        a, b = one.get(name, {}), other.get(name, {})
        arrays += len(a.keys() | b.keys())
        if found := unequal(a, b):
            different_arrays += len(found)
            different[name] = ", ".join(f"{array} ({words})" for array, words in found.items())
    print(
        f"{kind}: {len(names) - len(different)} of {len(names)} equal; "
        f"their arrays: {arrays - different_arrays} of {arrays} equal"
    )
    for name, words in different.items():
        print(f"DIFFERENT in {kind}: {name}: {words}")
    return bool(names) and not different


def compare(first: Path, second: Path) -> int:
    """Compare two files of hashes; the exit status is 1 if anything differs."""
    one, other = (json.loads(path.read_text("utf-8")) for path in (first, second))
    if one["device"] != other["device"]:
        print(f"devices: {one['device']} and {other['device']}")
    # If a scene differs, its frames may differ although rendering is the same.
    same = [compare_kind(kind, one[kind], other[kind]) for kind in ("scenes", "frames")]
    return 0 if all(same) else 1

"""The extension module: what the package itself calls."""

from typing import Any, TypedDict

import numpy as np
import numpy.typing as npt

__version__: str

class _Phantom(TypedDict):
    name: str
    array: npt.NDArray[np.int16]
    world_from_index: npt.NDArray[np.float64]
    vessels: list[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], str]]
    reference_radius: list[npt.NDArray[np.float64]]
    stenoses: list[dict[str, Any]]
    plaques: list[dict[str, Any]]

def make_phantom(name: str, *, percent: float = 50.0, seed: int = 0, scale: float = 1.0) -> _Phantom:
    """The phantom that the function of this name in `lumencut.phantom` returns, in plain parts."""

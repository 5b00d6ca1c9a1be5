"""The extension module: see the Rust crates for the method and the readers."""

import numpy as np
import numpy.typing as npt

__version__: str

def read_centerlines(
    content: bytes, name: str
) -> tuple[
    list[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None, str | None]], str | None, list[str]
]: ...

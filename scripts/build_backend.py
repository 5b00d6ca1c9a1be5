"""The build backend of the package: maturin's, which first builds the viewer's page where that is possible.

Without Node, Rust's wasm target or the network the package is built all the same; `lumencut view` then says
how to get the page. A packed source has the page in it and no sources of it, so nothing is built there. An
editable install serves the page that `make page` builds.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import maturin
from maturin import (
    build_editable,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
    get_requires_for_build_wheel,
    prepare_metadata_for_build_wheel,
)

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_wheel",
]

_WEB = Path(__file__).resolve().parent.parent / "web"


def build_wheel(
    wheel_directory: str,
    config_settings: Mapping[str, Any] | None = None,
    metadata_directory: str | None = None,
) -> str:
    """Build a wheel, with the page in it where that can be."""
    _build_page()
    return str(maturin.build_wheel(wheel_directory, config_settings, metadata_directory))


def build_sdist(sdist_directory: str, config_settings: Mapping[str, Any] | None = None) -> str:
    """Pack the sources, with the page in them where that can be."""
    _build_page()
    return str(maturin.build_sdist(sdist_directory, config_settings))


def _build_page() -> None:
    if _WEB.is_dir():
        # A packed source has neither `web/` nor the scripts that build it.
        from page import build_if_possible

        build_if_possible()

"""The build backend of the package: maturin's, after building the viewer's page if possible.

Without Node, Rust's wasm target or the network, the package has no page; `lumencut view` then explains how to
get it. A packed source contains the page instead of its sources. An editable install serves the page that
`make page` builds.
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
    """Build a wheel, with the page if possible."""
    _build_page()
    return str(maturin.build_wheel(wheel_directory, config_settings, metadata_directory))


def build_sdist(sdist_directory: str, config_settings: Mapping[str, Any] | None = None) -> str:
    """Pack the sources, with the page if possible."""
    _build_page()
    return str(maturin.build_sdist(sdist_directory, config_settings))


def _build_page() -> None:
    if _WEB.is_dir():
        # A packed source has neither `web/` nor its build scripts.
        from page import build_if_possible

        build_if_possible()

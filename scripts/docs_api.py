"""The pages of all public names of the Python package, grouped by subject."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
_CONTENTS = ROOT / "python/lumencut/__init__.py"

#: Page name, title, and the public names on it.
GROUPS: dict[str, tuple[str, tuple[str, ...]]] = {
    "scenes": (
        "Scans and vessels",
        (
            *("read_volume", "list_series", "SeriesReport", "ScanDetails", "Volume"),
            *("read_centerlines", "write_centerlines", "Vessel", "VesselTree", "Gap"),
        ),
    ),
    "pictures": (
        "Pictures",
        (
            *(
                "render",
                "Renderer",
                "Frame",
                "Camera",
                "VIEWS",
                "Settings",
                "Window",
                "Opacity",
                "Focus",
                "Slab",
            ),
            *("TransferFunction", "turntable", "fitted_turn", "flight", "save_animation"),
            *("show", "Device", "devices", "get_threads", "set_threads"),
        ),
    ),
    "reformations": (
        "Reformations",
        (
            *("Reformation", "cpr", "PlanarReformation", "TangentialReformation", "straightened_volume"),
            *("StraightenedVolume", "cfa", "FeatureAggregation", "lumen_map", "LumenMap", "Ostium", "spiral"),
            *("SpiralReformation", "uncurl", "Uncurled", "untangled", "UntangledTree", "mpcpr", "cr"),
        ),
    ),
    "tracing": (
        "Tracing",
        ("find_vessels", "trace", "Tracer", "trace_from", "trace_mask", "brightest"),
    ),
    "measuring": (
        "Measuring",
        ("measure", "Measurements", "Profile", "Flag", "Stenosis", "cross_section", "CrossSection"),
    ),
    "cohorts": (
        "Cohorts and evaluation",
        ("batch", "BatchSummary", "evaluate", "Evaluation", "compare_centerlines", "CenterlineComparison"),
    ),
    "errors": (
        "Errors",
        (
            *("LumencutError", "Mend", "VolumeError", "VesselTreeError", "CameraError", "SettingsError"),
            *("DeviceError", "TracingError", "MeasuringError", "FormatError", "SeriesError", "FileError"),
            *("PacsError", "MissingPackageError"),
            *("DeviceWarning", "LineWarning", "SpaceWarning", "StudyWarning"),
        ),
    ),
}
#: Public names that need no page.
UNTOLD = {"__version__"}

#: A Sphinx role: a name in a docstring that editors follow.
_ROLE = re.compile(r":(?:attr|class|data|func|meth):`~?(?:lumencut\.)?([\w.]+)`")
#: A line of a table of parameters, whose type is shown as code.
_TYPED = re.compile(r"^[\w, *]+ : .*$", re.MULTILINE)


@cache
def public_names() -> dict[str, str]:
    """Every public name of the package and its module; read from the source, not imported."""
    block = next(node for node in ast.parse(_CONTENTS.read_text("utf-8")).body if isinstance(node, ast.If))
    imports = [node for node in block.body if isinstance(node, ast.ImportFrom)]
    return {alias.name: f"{node.module}" for node in imports for alias in node.names}


def api_pages() -> dict[str, str]:
    """The pages by their paths in the site: a heading, and directives for mkdocstrings."""
    homes = public_names()
    pages = {}
    for page, (title, names) in GROUPS.items():
        listed = "\n\n".join(f"::: {homes[name]}.{name}" for name in names)
        pages[f"api/{page}.md"] = f"# {title}\n\nAll of these are names of `lumencut`.\n\n{listed}\n"
    return pages


def linked(text: str) -> str:
    """A docstring whose roles are links to the pages of public names."""
    return _ROLE.sub(_link, _TYPED.sub(lambda line: _ROLE.sub(r"\1", line[0]), text))


def _link(role: re.Match[str]) -> str:
    name = role[1].partition(".")[0]
    home = {} if name in UNTOLD else public_names()
    return f"[`{role[1]}`][{home[name]}.{name}]" if name in home else f"`{role[1]}`"

"""Facts about an installation for bug reports: versions, GPUs, the viewer's page, and what is missing.

Nothing here names a file of the user: paths in the home folder begin with `~`.
"""

from __future__ import annotations

import os
import platform
import re
import time
from dataclasses import asdict
from email.message import Message
from importlib import metadata
from pathlib import Path
from typing import Any, Literal, TypeAlias
from urllib.request import ProxyHandler, build_opener

from lumencut.errors import LumencutError

_VARIABLES = ("RAYON_NUM_THREADS", "VK_DRIVER_FILES", "VK_ICD_FILENAMES", "XDG_CACHE_HOME")
#: Headers with which browsers allow a page to share memory between its workers.
_ISOLATION = {"Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp"}
#: Side of the test picture (pixels), and timeout of the viewer's server (s).
_SIDE, _PATIENCE = 64, 10.0
_Device: TypeAlias = Literal["cpu", "gpu"]
_BOTH: tuple[_Device, _Device] = ("cpu", "gpu")


def examined() -> dict[str, Any]:
    """Examine this installation, and test its abilities.

    Returns
    -------
    dict
        `versions` and `environment` (text by name), `packages` (version by name, None where one is missing),
        `extras` (by name: the `missing` packages and the `mend`), `gpus` (the fields of `Device`), `auto`
        (what `device="auto"` takes), `pictures` (by device: ms of a picture of 64 x 64 pixels, None where it
        failed), `page` (`files`, `bytes`, `isolated`; None where it cannot be served), and `problems` (a
        sentence each).
    """
    problems: list[str] = []
    packages, extras = _packages(problems)
    gpus, auto = _gpus(problems)
    return {
        "versions": _versions(),
        "environment": _environment(),
        "packages": packages,
        "extras": extras,
        "gpus": gpus,
        "auto": auto,
        "pictures": {device: _tried(device, problems) for device in (_BOTH if gpus else _BOTH[:1])},
        "page": _page(problems),
        "problems": problems,
    }


def _versions() -> dict[str, str]:
    from lumencut import __version__
    from lumencut.base.threads import get_threads

    bits = platform.architecture()[0]
    return {
        "lumencut": __version__,
        "python": f"{platform.python_implementation()} {platform.python_version()}, {bits}",
        "system": platform.platform(),
        "machine": f"{platform.machine()}, {os.cpu_count()} cores, {get_threads()} threads used",
    }


def _environment() -> dict[str, str]:
    home = str(Path.home())
    return {
        name: value.replace(home, "~") if len(home) > 1 else value
        for name, value in sorted(os.environ.items())
        if name.startswith("LUMENCUT_") or name in _VARIABLES
    }


def _packages(problems: list[str]) -> tuple[dict[str, str | None], dict[str, dict[str, Any]]]:
    """Return the versions of the required packages, and the state of the extras."""
    packages: dict[str, str | None] = {}
    extras: dict[str, dict[str, Any]] = {}
    try:
        wanted = metadata.requires("lumencut") or []
    except metadata.PackageNotFoundError:
        problems.append("lumencut: found no installed package, only its sources; expected an installed wheel")
        return packages, extras
    for requirement in wanted:
        name = re.split(r"[^\w.-]", requirement, maxsplit=1)[0]
        extra = re.search(r"extra == ['\"]([\w-]+)['\"]", requirement)
        if extra is None:
            packages[name] = _version(name)
            continue
        found = extras.setdefault(extra[1], {"missing": [], "mend": f"pip install 'lumencut[{extra[1]}]'"})
        if _version(name) is None:
            found["missing"].append(name)
    if missing := [name for name, version in packages.items() if version is None]:
        problems.append(f"packages: found no {', no '.join(missing)}; expected all; pip install lumencut")
    return packages, extras


def _version(name: str) -> str | None:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None


def _gpus(problems: list[str]) -> tuple[list[dict[str, Any]], str]:
    """Return the GPUs, and the default device."""
    try:
        from lumencut import _lumencut
        from lumencut.scene.device import devices

        return [asdict(device) for device in devices()], _lumencut.Renderer(None, "auto").device
    except LumencutError as error:
        problems.append(str(error))
        return [], "cpu"


def _tried(device: _Device, problems: list[str]) -> float | None:
    """Return the time of a second small picture (ms); the first one includes preparation."""
    from lumencut.phantom import straight_tube
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera

    try:
        tube = straight_tube()
        renderer = Renderer(tube.volume, tube.tree, device)
        camera = Camera.anterior(tube.tree, (_SIDE, _SIDE))
        for _ in range(2):
            start = time.perf_counter()
            frame = renderer.render(camera)
            taken = 1000 * (time.perf_counter() - start)
    except (LumencutError, ImportError) as error:
        problems.append(f"a picture by {device}: {error}")
        return None
    if not (frame.vessel >= 0).any():
        problems.append(f"a picture by {device}: found no vessel in it; expected that of a phantom")
        return None
    return taken


def _page(problems: list[str]) -> dict[str, Any] | None:
    """Return facts about the viewer's page; only if browsers may isolate it, it can use all cores."""
    try:
        from lumencut.viewer.page import FOLDER, Page
        from lumencut.viewer.server import ViewerServer

        page = Page.of(FOLDER)
        with ViewerServer(page) as server:
            headers = _headers(server.place.address)
    except (LumencutError, ImportError, OSError) as error:
        problems.append(str(error))
        return None
    isolated = all(headers.get(name) == value for name, value in _ISOLATION.items())
    if not isolated:
        problems.append(
            "the viewer's page: found other headers than its server sends; expected that browsers isolate it"
        )
    size = sum(path.stat().st_size for path in page.files.values())
    return {"files": len(page.files) + 1, "bytes": size + len(page.index.encode()), "isolated": isolated}


def _headers(address: str) -> Message:
    """Return the headers that the server sends with the page, requested without proxies."""
    with build_opener(ProxyHandler({})).open(address, timeout=_PATIENCE) as answer:
        headers: Message = answer.headers
        return headers

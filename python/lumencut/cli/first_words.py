"""Output of ``lumencut`` without arguments: three things to try."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path


def program() -> str:
    """Return how to call this program, which may not be on the search path."""
    called = Path(sys.argv[0])
    on_path = shutil.which("lumencut")
    if called.name != "lumencut" or (on_path and Path(on_path).resolve() == called.resolve()):
        return "lumencut"
    return str(called)


def first_words() -> str:
    """Return commands that a new user can try at once with this installation."""
    from lumencut import __version__
    from lumencut.viewer.page import FOLDER

    name = program()
    has_page = (FOLDER / "index.html").is_file()
    scan = "your own scan: DICOM folder or zip, NIfTI, NRRD, MetaImage"
    details = "what your own file holds, and anything unusual about it"
    tries = (
        (f"{name} view --demo", "a CT of an aorta with a stent graft, in your browser")
        if has_page
        else (f"{name} demo", "pictures of a CT of an aorta with a stent graft, in the folder demo"),
        (f"{name} view SCAN", scan) if has_page else (f"{name} info SCAN", details),
        (f"{name} render SCAN --find -o vessels.png", "a picture of all vessels that are found in it"),
    )
    width = max(len(command) for command, _ in tries)
    return "\n".join(
        (
            f"Lumencut {__version__}: the lumen of all vessels of a CT or MR angiography in one view.",
            "",
            "Three things to try:",
            *(f"  {command:<{width}}   {what}" for command, what in tries),
            "",
            f"All commands: {name} --help. If something does not work: {name} doctor.",
            "Files stay on this machine. Lumencut is not a medical device.",
        )
    )

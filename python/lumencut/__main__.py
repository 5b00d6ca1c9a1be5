"""``python -m lumencut`` is the command ``lumencut``."""

from __future__ import annotations

from lumencut.cli import main

if __name__ == "__main__":
    main(prog_name="lumencut")

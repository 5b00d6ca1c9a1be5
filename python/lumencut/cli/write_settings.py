"""``lumencut settings``: a file of settings to keep."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from lumencut.cli import options
from lumencut.cli.report import say, verbose_option
from lumencut.cli.settings import paper_option, setting_options, settings_from


@click.command(short_help="Write a file of settings.")
@click.option("-o", "--output", type=options.FILE, help="The file, such as look.toml; default: print.")
@paper_option
@setting_options
@verbose_option
def settings(output: Path | None, **chosen: Any) -> None:
    """Write all settings with their values, units and meaning as a TOML file.

    The values are the defaults, or those of the options. Edit the file, and pass it to render, turntable or
    evaluate with --settings.

    \b
    lumencut settings --window 900/300 --no-silhouettes -o look.toml
    lumencut render ct.nii.gz centerlines.vtp --settings look.toml -o out.png
    """  # noqa: D301 - click needs the control character itself
    from lumencut.scene.settings_file import settings_text

    found = settings_from(chosen)
    if output is None:
        say(settings_text(found).rstrip("\n"))
        return
    options.check_folder(output)
    found.save(output)
    say(str(output))

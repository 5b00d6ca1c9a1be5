"""``lumencut push``: DICOM objects to a PACS over DICOMweb."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from lumencut.cli.options import FILE
from lumencut.cli.pull import server_options
from lumencut.cli.report import INCOMPLETE, bar, busy, complain, detail, inform, say, verbose_option, warn
from lumencut.errors import PacsError

if TYPE_CHECKING:
    from lumencut.dicom.web.address import Address
    from lumencut.dicom.web.client import Client
    from lumencut.dicom.web.objects import Outgoing

_NO_TERMINAL = "no terminal in which to confirm the first push to this address"
_NOT_BACK = "objects in a PACS cannot be removed from here"


@click.command(short_help="Send DICOM objects to a PACS.")
@click.argument("files", type=FILE, nargs=-1, required=True, metavar="FILES... ADDRESS")
@click.option("--dry-run", is_flag=True, help="List the objects and the address; contact no server.")
@click.option("--new-study", is_flag=True, help="Also send objects of studies that the PACS does not have.")
@click.option("--yes", is_flag=True, help="Do not ask before the first push to an address.")
@server_options
@verbose_option
@click.pass_context
def push(
    ctx: click.Context,
    files: tuple[Path, ...],
    dry_run: bool,
    new_study: bool,
    yes: bool,
    token_file: Path | None,
    ca: Path | None,
) -> None:
    """Send the DICOM objects in FILES to the PACS at ADDRESS.

    FILES are files, folders or zip archives; ADDRESS names a DICOMweb server: https://HOST/ROOT.
    Sent objects cannot be removed from here. Results belong to the study of their scan, so push rejects
    studies that the PACS does not have. It also rejects objects whose PatientID differs from that of their
    study.

    Each object that the PACS rejects is reported with the reason; afterwards push asks for all others. The
    exit code is 3 if an object is missing in the PACS.

    \b
    lumencut push results/ https://pacs.example/dicom-web --dry-run
    lumencut push results/ https://pacs.example/dicom-web
    """  # noqa: D301 - click needs the control character itself
    from lumencut.dicom.web.address import parsed_address
    from lumencut.dicom.web.client import Client
    from lumencut.dicom.web.objects import outgoing_objects
    from lumencut.dicom.web.patients import check_objects

    if len(files) < 2:
        raise click.UsageError("found one argument; expected FILES, then the ADDRESS of the PACS")
    address = parsed_address(files[-1])
    if address.study:
        raise click.UsageError("ADDRESS names a study; objects know theirs, so leave /studies/… out")
    with busy("reading files"):
        objects, left_out = outgoing_objects(files[:-1])
    if left_out:
        inform(f"left out, no DICOM: {len(left_out)} files, such as {left_out[0]}")
    _list(objects, address, is_all=dry_run)
    _warn(check_objects(objects))
    if dry_run:
        say("nothing was sent")
        return
    with Client(address, token_file, ca) as client:
        _check_studies(client, address, objects, is_new_allowed=new_study)
        _ask(address, is_sure=yes)
        if not _push(client, address, objects):
            ctx.exit(INCOMPLETE)


def _list(objects: list[Outgoing], address: Address, *, is_all: bool) -> None:
    size = sum(one.size for one in objects) / 1e6
    say(f"{len(objects)} objects, {size:.1f} MB, to {address.base}")
    for one in objects:
        line = f"  {one.kind}: {one.source} ({one.description}), study {one.study}, {one.patient}"
        if is_all:
            say(line)
        else:
            detail(line)


def _check_studies(
    client: Client, address: Address, objects: list[Outgoing], *, is_new_allowed: bool
) -> None:
    """Reject objects of another patient, and of studies that the PACS lacks: usually it is the wrong PACS."""
    from lumencut.dicom.web.patients import check_pacs

    unknown, doubts = check_pacs(client, address.base, objects)
    _warn(doubts)
    if unknown and not is_new_allowed:
        found = f"{len(unknown)} studies that it does not have, such as {unknown[0]}"
        mend = "check the address, or give --new-study to let the PACS make them"
        raise PacsError(address.base, found, "studies that it has", mend)


def _warn(doubts: list[str]) -> None:
    for words in doubts:
        warn(words)


def _ask(address: Address, *, is_sure: bool) -> None:
    from lumencut.dicom.web.pushing import is_known, remember

    if not is_sure and not is_known(address.base):
        if not sys.stdin.isatty():
            mend = "give --yes to send without confirmation"
            raise PacsError(address.base, _NO_TERMINAL, "a confirmation", mend)
        click.confirm(f"Send them to {address.base}, for the first time? {_NOT_BACK}.", abort=True)
    remember(address.base)


def _push(client: Client, address: Address, objects: list[Outgoing]) -> bool:
    from lumencut.dicom.web.pushing import push_objects

    with bar(f"sending {len(objects)} objects", "object") as progress:
        done = push_objects(client, address, objects, progress)
    if done.before:
        inform(f"{done.before} of them were there before; a PACS keeps what it had under their UIDs")
    say(f"{done.confirmed} of {len(objects)} objects are in {address.base}; {_NOT_BACK}")
    sources = {one.uid: one.source for one in objects}
    for uid, refusal in done.failed.items():
        complain(f"{sources[uid]}: {refusal.words}")
    if done.failed:
        warn(f"{len(done.failed)} objects are not there; run it again with their files")
    return not done.failed

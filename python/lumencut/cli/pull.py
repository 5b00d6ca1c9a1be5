"""``lumencut pull``: studies and series of a PACS over DICOMweb, into a folder."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import click

from lumencut.cli.options import FILE, Command, added
from lumencut.cli.report import INCOMPLETE, bar, inform, say, verbose_option, warn

if TYPE_CHECKING:
    from lumencut.dicom.web.address import Address
    from lumencut.dicom.web.client import Client
    from lumencut.dicom.web.queries import Found

#: Default number of studies in a table.
_MOST_STUDIES = 100
_STUDY_COLUMNS = ("date", "patient", "modalities", "description", "series", "instances")
_SERIES_COLUMNS = ("number", "modality", "description", "instances")


def server_options(command: Command) -> Command:
    """Add the options for credentials and certificates of a PACS."""
    parts = (
        click.option(
            "--token-file",
            type=FILE,
            metavar="FILE",
            help="A file that holds a token; it is read again after the token expires. Default: the "
            "environment's LUMENCUT_DICOMWEB_TOKEN, or name and password from ~/.netrc.",
        ),
        click.option(
            "--ca",
            type=FILE,
            metavar="FILE",
            help="The certificate of a private authority (PEM), trusted instead of the usual ones.",
        ),
    )
    return added(parts, command)


@click.command(short_help="Fetch a study or series from a PACS, or list its studies.")
@click.argument("address")
@click.option("-o", "--output", type=FILE, help="The folder for the files: SERIES/INSTANCE.dcm.")
@click.option(
    "--patient", metavar="NAME", help="List studies of a patient; * stands for the rest of the name."
)
@click.option("--date", metavar="DATE", help="List studies of a date: 20260131, 20260101-20260131.")
@click.option("--modality", metavar="CT", help="List studies with this modality.")
@click.option(
    "--most",
    type=click.IntRange(1),
    default=_MOST_STUDIES,
    show_default=True,
    metavar="N",
    help="The largest number of studies to list.",
)
@server_options
@verbose_option
@click.pass_context
def pull(
    ctx: click.Context,
    address: str,
    output: Path | None,
    patient: str | None,
    date: str | None,
    modality: str | None,
    most: int,
    token_file: Path | None,
    ca: Path | None,
) -> None:
    """Fetch the study or series at ADDRESS from a PACS, or list what is there.

    ADDRESS names a DICOMweb server, a study or a series: https://HOST/ROOT/studies/UID
    or https://HOST/ROOT/studies/UID/series/UID. Without a study the studies are listed with their addresses;
    with one and without -o its series.

    Each file appears only when it is complete. Run pull again to fetch only what is missing. The exit code is
    3 if something is still missing.

    \b
    lumencut pull https://pacs.example/dicom-web --patient 'Doe*' --modality CT
    lumencut pull https://pacs.example/dicom-web/studies/1.2.3/series/1.2.3.4 -o scan
    """  # noqa: D301 - click needs the control character itself
    from lumencut.dicom.web.address import parsed_address
    from lumencut.dicom.web.client import Client

    place = parsed_address(address)
    match = {"PatientName": patient, "StudyDate": date, "ModalitiesInStudy": modality}
    wanted = {name: value for name, value in match.items() if value}
    if wanted and place.study:
        raise click.UsageError(
            "--patient, --date and --modality list studies; leave the study out of ADDRESS"
        )
    if output is not None and not place.study:
        raise click.UsageError("-o needs a study in ADDRESS: …/studies/UID; without -o studies are listed")
    with Client(place, token_file, ca) as client:
        if output is None:
            _list(client, place, wanted, most)
        elif not _pull(client, place, output):
            ctx.exit(INCOMPLETE)


def _list(client: Client, place: Address, wanted: dict[str, str], most: int) -> None:
    from lumencut.dicom.web.queries import find_series, find_studies

    if place.study:
        _table(find_series(client, place), _SERIES_COLUMNS, "series")
        return
    found = find_studies(client, place, wanted, most + 1)
    _table(found[:most], _STUDY_COLUMNS, "studies")
    if len(found) > most:
        inform(f"there are more than {most}: --patient, --date and --modality narrow them down")


def _table(found: list[Found], columns: tuple[str, ...], what: str) -> None:
    """Print a table whose last column holds the addresses: they are long, and users copy them."""
    if not found:
        inform(f"no {what} found")
        return
    rows = [columns, *(tuple(one.texts[name] for name in columns) for one in found)]
    widths = [min(max(len(row[n]) for row in rows), 40) for n in range(len(columns))]
    addresses = ["address", *(str(one.address) for one in found)]
    for row, address in zip(rows, addresses, strict=True):
        cells = [cell[:width].ljust(width) for cell, width in zip(row, widths, strict=True)]
        say("  ".join([*cells, address]))


def _pull(client: Client, place: Address, folder: Path) -> bool:
    from lumencut.dicom.web.pulling import pull_instances
    from lumencut.dicom.web.queries import find_instances

    instances = find_instances(client, place)
    _warn_of_patients(client, place)
    with bar(f"fetching {len(instances)} instances", "instance") as progress:
        done = pull_instances(client, instances, folder, progress)
    already = f", {done.before} existed before" if done.before else ""
    say(f"{folder}: {done.fetched} of {done.listed} instances fetched{already}")
    if not done.is_complete:
        warn(f"{len(done.missing)} instances are missing: {done.reasons}; run pull again to fetch only these")
    return done.is_complete


def _warn_of_patients(client: Client, place: Address) -> None:
    """Warn if the PACS lists the study under several patients; if it cannot be asked, continue."""
    from lumencut.dicom.web.queries import find_patients
    from lumencut.errors import PacsError

    with suppress(PacsError):
        patients = find_patients(client, place.study)
        others = [one for one in patients[1:] if one.differs_from(patients[0])]
        if others:
            first, other = patients[0], others[0]
            found = f"two patients, {first} and {other}"
            warn(f"study {place.study}: the PACS has it for {found}; check each series")

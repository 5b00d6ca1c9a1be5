"""``lumencut convert``: write a volume in another format."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from lumencut.cli import options
from lumencut.cli.mistakes import check_reading
from lumencut.cli.report import busy, say, verbose_option
from lumencut.cli.scene import volume_of


@click.command(short_help="Write a volume as OME-Zarr, NIfTI or NRRD.")
@click.argument("volume", type=options.FILE)
@click.argument("output", type=options.FILE)
@options.series_option
@options.phase_option
@options.fill_gaps_option
@options.resample_slices_option
@options.zarr_options
@verbose_option
def convert(volume: Path, output: Path, **chosen: Any) -> None:
    """Write VOLUME as OUTPUT: an OME-Zarr folder (.ome.zarr), .nii, .nii.gz or .nrrd.

    An OME-Zarr image holds the volume at several resolutions, each half as fine as the one before, in
    chunks; of these, Lumencut reads only what a view or a measurement needs. OUTPUT has no patient data.

    \b
    lumencut convert scan.nii.gz scan.ome.zarr
    """  # noqa: D301 - click needs the control character itself
    from lumencut.files.ome_zarr.writing import is_zarr_name, write_ome_zarr
    from lumencut.files.volume_writers import write_volume

    check_reading(chosen, [volume], has_centerlines=True)
    voxels = volume_of(volume, chosen)
    with busy(f"writing {output.name}"):
        if is_zarr_name(output):
            levels = write_ome_zarr(voxels, output)
            say(f"{output}: {levels} levels, the finest of {voxels!r}")
            return
        write_volume(voxels, output)
    say(f"{output}: {voxels!r}")

"""Every compression of grey pixels that DICOM allows, by free encoders."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gdcm
import numpy as np
import pydicom
from PIL import Image as Picture
from pydicom.dataset import Dataset
from pydicom.encaps import encapsulate

CODESTREAMS = Path(__file__).parent / "htj2k.npz"
Encoder = Callable[[Path], None]
"""Replaces a plain file by a compressed one."""


def pydicom_does(uid: str, lossy: bool = False, **options: Any) -> Encoder:
    """Compress a file with pydicom (and its plugin for OpenJPEG)."""

    def encode(path: Path) -> None:
        data = pydicom.dcmread(path)
        data.compress(uid, generate_instance_uid=False, **options)
        _saved(data, path, lossy)

    return encode


def _saved(data: Dataset, path: Path, lossy: bool) -> None:
    if lossy:
        data.LossyImageCompression = "01"
    data.save_as(path, enforce_file_format=True)


def rewritten(uid: str) -> Encoder:
    """Write the same values with implicit types or as a deflated file."""

    def encode(path: Path) -> None:
        data = pydicom.dcmread(path)
        data.file_meta.TransferSyntaxUID = pydicom.uid.UID(uid)
        data.save_as(path, enforce_file_format=True)

    return encode


def gdcm_does(name: str, codec: Callable[[], Any] | None = None) -> Encoder:
    """Compress a file with GDCM; a given codec defines how much may be lost."""

    def encode(path: Path) -> None:
        reader = gdcm.ImageReader()
        reader.SetFileName(str(path))
        assert reader.Read()
        change = gdcm.ImageChangeTransferSyntax()
        change.SetTransferSyntax(gdcm.TransferSyntax(getattr(gdcm.TransferSyntax, name)))
        own = codec() if codec else None
        if own is not None:
            change.SetUserCodec(own)
        change.SetInput(reader.GetImage())
        assert change.Change()
        writer = gdcm.ImageWriter()
        writer.SetFileName(str(path))
        writer.SetFile(reader.GetFile())
        writer.SetImage(change.GetOutput())
        assert writer.Write()
        if own is not None:
            _saved(pydicom.dcmread(path), path, lossy=True)

    return encode


def lossy_jpeg() -> Any:
    """JPEG with loss; for more than 8 bits JPEG Extended."""
    codec = gdcm.JPEGCodec()
    codec.SetLossless(False)
    codec.SetQuality(100)
    return codec


def near_lossless() -> Any:
    """JPEG-LS with errors of at most 2."""
    codec = gdcm.JPEGLSCodec()
    codec.SetLossless(False)
    codec.SetLossyError(2)
    return codec


def frames_by(uid: str, encode_one: Callable[[Any], bytes], lossy: bool = False) -> Encoder:
    """Compress every frame of a file by a function."""

    def encode(path: Path) -> None:
        data: Dataset = pydicom.dcmread(path)
        array = data.pixel_array
        stack = array if array.ndim == 3 else array[None]
        data.PixelData = encapsulate([encode_one(frame) for frame in stack])
        data["PixelData"].VR = "OB"
        data.file_meta.TransferSyntaxUID = pydicom.uid.UID(uid)
        _saved(data, path, lossy)

    return encode


def baseline(frame: Any) -> bytes:
    """JPEG of 8 bits."""
    stream = io.BytesIO()
    Picture.fromarray(frame).save(stream, "JPEG", quality=98)
    return stream.getvalue()


def jpeg_2000(frame: Any) -> bytes:
    """JPEG 2000 without loss, in the transfer syntax that also allows loss."""
    from openjpeg.utils import encode_array

    return bytes(encode_array(frame))


def high_throughput(reversible: bool) -> Callable[[Any], bytes]:
    """High-throughput JPEG 2000 (progression RPCL), from the file of stored codestreams."""

    def encode(frame: Any) -> bytes:
        with np.load(CODESTREAMS) as kept:
            return bytes(kept[_key(frame, reversible)].tobytes())

    return encode


def _key(frame: Any, reversible: bool) -> str:
    return f"{'without' if reversible else 'with'} loss {hashlib.sha256(frame.tobytes()).hexdigest()[:16]}"


def codestream(frame: Any, reversible: bool) -> tuple[str, bytes]:
    """Encode a frame for the file of stored codestreams.

    Needs imagecodecs, because no package that Lumencut needs can write HTJ2K. It has crashed on
    the second frame of a process, so results are stored.
    """
    import imagecodecs

    return _key(frame, reversible), bytes(imagecodecs.htj2k_encode(frame, reversible=reversible))


_JPEG, _RLE = "1.2.840.10008.1.2.4", "1.2.840.10008.1.2.5"

LOSSLESS: dict[str, Encoder | None] = {
    "explicit little-endian": None,
    "implicit little-endian": rewritten("1.2.840.10008.1.2"),
    "explicit big-endian": gdcm_does("ExplicitVRBigEndian"),
    "deflated": rewritten("1.2.840.10008.1.2.1.99"),
    "RLE": pydicom_does(_RLE),
    "JPEG lossless .57": gdcm_does("JPEGLosslessProcess14"),
    "JPEG lossless .70": gdcm_does("JPEGLosslessProcess14_1"),
    "JPEG-LS": gdcm_does("JPEGLSLossless"),
    "JPEG 2000 .90": pydicom_does(f"{_JPEG}.90"),
    "JPEG 2000 .91 without loss": frames_by(f"{_JPEG}.91", jpeg_2000),
    "HTJ2K .201": frames_by(f"{_JPEG}.201", high_throughput(True)),
    "HTJ2K .202": frames_by(f"{_JPEG}.202", high_throughput(True)),
}
LOSSY: dict[str, Encoder] = {
    "JPEG extended, 12 bits": gdcm_does("JPEGExtendedProcess2_4", lossy_jpeg),
    "JPEG-LS near-lossless": gdcm_does("JPEGLSNearLossless", near_lossless),
    "JPEG 2000 .91": pydicom_does(f"{_JPEG}.91", lossy=True, j2k_psnr=[100]),
    "HTJ2K .203": frames_by(f"{_JPEG}.203", high_throughput(False), lossy=True),
}
BASELINE = frames_by(f"{_JPEG}.50", baseline, lossy=True)

"""Addresses of a PACS: a server of DICOMweb, and a study or a series of it."""

from __future__ import annotations

import ipaddress
import os
import re
from dataclasses import dataclass
from urllib.parse import urlsplit

from lumencut.errors import FormatError

#: Prefix of an address if a file name would be accepted too.
SCHEME = "dicomweb:"
_FORM = "dicomweb:https://HOST/ROOT/studies/UID[/series/UID]"
_UID = re.compile(r"[0-9]+(\.[0-9]+)*")
_PATH = re.compile(r"(?P<root>.*?)/?(/studies/(?P<study>[^/]*)(/series/(?P<series>[^/]*))?)?/*")


@dataclass(frozen=True)
class Address:
    """The address of a PACS, or of a study or series in it.

    Attributes
    ----------
    base : str
        The address of the server, such as ``https://pacs.example/dicom-web``.
    study, series : str
        The UIDs of a study and of one of its series; empty if not named.
    """

    base: str
    study: str = ""
    series: str = ""

    def __str__(self) -> str:
        return f"{SCHEME}{self.base}{self.path}"

    @property
    def path(self) -> str:
        """The path within the server, such as ``/studies/1.2.3``."""
        study = f"/studies/{self.study}" if self.study else ""
        return f"{study}/series/{self.series}" if self.series else study

    @property
    def host(self) -> str:
        """The host and the port, for messages."""
        return urlsplit(self.base).netloc


def is_address(given: str | os.PathLike[str]) -> bool:
    """Return whether a text is an address of a PACS, not the name of a file."""
    return isinstance(given, (str, os.PathLike)) and str(given).startswith(SCHEME)


def parsed_address(given: str | os.PathLike[str]) -> Address:
    """Parse an address.

    Parameters
    ----------
    given : str or path
        ``dicomweb:https://HOST/ROOT``, followed by ``/studies/UID`` and ``/series/UID``; the prefix
        ``dicomweb:`` is optional.

    Raises
    ------
    FormatError
        For addresses that contain a name or a password, http to other hosts, and other invalid addresses.
    """
    # A path object turns two consecutive slashes into one; here the second is added again.
    text = re.sub(r"^(https?):/+", r"\1://", str(given).removeprefix(SCHEME))
    try:
        parts = urlsplit(text)
        host, _ = parts.hostname, parts.port
    except ValueError:
        raise FormatError("address", f"{text!r:.200}", _FORM) from None
    if "@" in parts.netloc:
        found = f"a name or a password in the address of {host}"
        mend = "put them into ~/.netrc, or a token into the environment as LUMENCUT_DICOMWEB_TOKEN"
        raise FormatError("address", found, "an address without them", mend)
    path = _PATH.fullmatch(parts.path)
    if parts.scheme not in ("http", "https") or not host or path is None or parts.query or parts.fragment:
        raise FormatError("address", f"{text!r:.200}", _FORM)
    if parts.scheme == "http" and not is_loopback(host):
        found = f"http to {host}, which anybody on the network can read"
        raise FormatError("address", found, "https, or http only to this machine")
    study, series = path["study"] or "", path["series"] or ""
    if "/studies" in path["root"] or not all(is_uid(uid) for uid in (study, series) if uid):
        raise FormatError("address", f"{text!r:.200}", _FORM)
    return Address(f"{parts.scheme}://{parts.netloc}{path['root'].rstrip('/')}", study, series)


def is_uid(text: str) -> bool:
    """Return whether a text is a DICOM UID, which is also safe as a file name."""
    return len(text) <= 64 and _UID.fullmatch(text) is not None


def is_loopback(host: str) -> bool:
    """Return whether a host is this machine."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False

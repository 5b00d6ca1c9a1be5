"""Credentials for a PACS: a token from the environment or a file, or netrc; no message ever shows them."""

from __future__ import annotations

import base64
import netrc
import os
from pathlib import Path

from lumencut.errors import FileError

TOKEN = "LUMENCUT_DICOMWEB_TOKEN"
TOKEN_FILE = "LUMENCUT_DICOMWEB_TOKEN_FILE"
CERTIFICATES = "LUMENCUT_DICOMWEB_CA"
_WAYS = f"the environment as {TOKEN}, a file by --token-file or {TOKEN_FILE}, or ~/.netrc"


class Credentials:
    """The Authorization header for one host.

    A token file takes precedence over the environment, and the environment over netrc.

    Parameters
    ----------
    host : str
        The host to look up in netrc.
    token_file : path, optional
        A file that contains only a token; default: the file in the environment.

    Raises
    ------
    FileError
        For unreadable and empty files.
    """

    def __init__(self, host: str, token_file: Path | None = None) -> None:
        named = os.environ.get(TOKEN_FILE)
        self._host = host
        self._token_file = token_file if token_file is not None else Path(named) if named else None
        self._header = self._read()

    def __repr__(self) -> str:
        return f"Credentials({'some' if self._header else 'none'})"

    @property
    def header(self) -> str:
        """The value of the header Authorization; empty without credentials for the host."""
        return self._header

    @property
    def mend(self) -> str:
        """The remedy for rejected credentials."""
        return f"give a valid token in {_WAYS}"

    def renewed(self) -> bool:
        """Read the credentials again; return whether they changed."""
        before, self._header = self._header, self._read()
        return self._header != before

    def _read(self) -> str:
        if self._token_file is not None:
            return f"Bearer {_token_in(self._token_file)}"
        if token := os.environ.get(TOKEN, "").strip():
            return f"Bearer {token}"
        return self._of_netrc()

    def _of_netrc(self) -> str:
        place = Path(os.environ.get("NETRC") or Path.home() / ".netrc")
        if not place.is_file():
            return ""
        try:
            found = netrc.netrc(place).authenticators(self._host)
        except (netrc.NetrcParseError, UnicodeDecodeError):
            # The parser's own message would quote the line with the password.
            raise FileError(
                str(place), "a line that netrc does not allow", "lines with machine, login and password"
            ) from None
        except OSError as error:
            raise FileError(str(place), error.strerror or str(error), "a readable file") from None
        if found is None:
            return ""
        login, _, password = found
        return "Basic " + base64.b64encode(f"{login}:{password}".encode()).decode()


def _token_in(path: Path) -> str:
    try:
        token = path.read_text("utf-8").strip()
    except (OSError, UnicodeDecodeError) as error:
        found = (error.strerror if isinstance(error, OSError) else None) or "no text"
        raise FileError(str(path), found, "a file with a token") from None
    if not token or not token.isprintable() or not token.isascii():
        raise FileError(str(path), "no token, or one with invalid characters", "a file with only a token")
    return token

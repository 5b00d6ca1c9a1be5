"""Requests to a PACS: who asks, whom it trusts, where it may be led, and what goes wrong, in words."""

from __future__ import annotations

import os
import ssl
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlencode, urljoin, urlsplit

import httpx

from lumencut.dicomweb.address import Address
from lumencut.dicomweb.credentials import CERTIFICATES, Credentials
from lumencut.errors import FileError, PacsError

#: How many requests are under way at once.
AT_ONCE = 4
_TIMEOUT = httpx.Timeout(60.0, connect=10.0, pool=None)
_MOST_REDIRECTS = 5
_JSON = "application/dicom+json"


class Client:
    """A connection to one PACS; a context that ends it. Several threads may use it.

    Parameters
    ----------
    address : Address
        The PACS.
    token_file : path, optional
        A file that holds a token, read anew where the PACS refuses the token it had.
    certificates : path, optional
        A file of the certificates (PEM) that are trusted in place of those of the machine; by default what
        LUMENCUT_DICOMWEB_CA names.

    Raises
    ------
    FileError
        For files that cannot be read, or hold no certificates or token.
    """

    def __init__(
        self, address: Address, token_file: Path | None = None, certificates: Path | None = None
    ) -> None:
        self._base, self._host = address.base, address.host
        parts = urlsplit(address.base)
        self._credentials = Credentials(parts.hostname or "", token_file)
        is_secure = parts.scheme == "https"
        self._http = httpx.Client(
            verify=_trusted(certificates) if is_secure else False,
            # Proxies of the environment are for other machines; netrc and certificates are read here.
            trust_env=is_secure,
            timeout=_TIMEOUT,
            limits=httpx.Limits(max_connections=AT_ONCE),
            follow_redirects=False,
            # Servers pack what does not shrink, which takes twenty times as long as to send it.
            headers={"Accept-Encoding": "identity"},
        )

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End all connections, those in use too."""
        self._http.close()

    def json(self, path: str, params: Mapping[str, str] | None = None) -> list[dict[str, Any]]:
        """Return the list that the PACS answers a search with; empty where it finds nothing.

        Raises
        ------
        PacsError
            Where it refuses, cannot be reached, or answers with something else.
        """
        with self.answered("GET", path, params, {"Accept": _JSON}) as answer:
            if answer.status_code == 204:
                return []
            self.require(answer, 200)
            return self._listed(answer)

    def post(self, path: str, content: bytes, content_type: str) -> tuple[int, dict[str, Any]]:
        """Send content; return the status and what was answered as JSON, empty where it is none."""
        headers = {"Accept": _JSON, "Content-Type": content_type}
        with self.answered("POST", path, None, headers, content) as answer:
            if answer.status_code in (401, 403):
                self.require(answer, 200)
            try:
                answer.read()
                told = answer.json()
            except ValueError:
                told = {}
            told = told[0] if isinstance(told, list) and told else told
            return answer.status_code, told if isinstance(told, dict) else {}

    @contextmanager
    def answered(
        self,
        method: str,
        path: str,
        params: Mapping[str, str] | None = None,
        headers: Mapping[str, str] | None = None,
        content: bytes | None = None,
    ) -> Iterator[httpx.Response]:
        """Yield the answer to a request, its body not read yet; redirects are followed within a host.

        Raises
        ------
        PacsError
            Where the PACS cannot be reached, the connection breaks, or it leads to another host.
        """
        url = f"{self._base}{path}"
        if params:
            # Some servers know wildcards and lists only where they are not written as %2A and %2C.
            url += "?" + urlencode(params, safe="*,", quote_via=quote)
        is_renewed = False
        with self._in_words():
            for _ in range(_MOST_REDIRECTS):
                sent = self._credentials.header
                known = {**(headers or {}), **({"Authorization": sent} if sent else {})}
                request = self._http.build_request(method, url, headers=known, content=content)
                answer = self._http.send(request, stream=True)
                try:
                    if answer.status_code == 401 and not is_renewed:
                        is_renewed = True
                        # Another thread may have read the new ones meanwhile.
                        if self._credentials.header != sent or self._credentials.renewed():
                            continue
                    elif answer.is_redirect:
                        url = self._followed(url, answer, method)
                        continue
                    yield answer
                    return
                finally:
                    answer.close()
        raise PacsError(self._host, f"more than {_MOST_REDIRECTS} redirects", "an answer")

    def require(self, answer: httpx.Response, *expected: int) -> None:
        """Refuse an answer of another status than expected, with what would mend it."""
        status = answer.status_code
        if status in expected:
            return
        mend = "check the address" if status == 404 else ""
        found = f"status {status}"
        if status == 401:
            has_some = bool(self._credentials.header)
            found += ": the credentials are refused, wrong or expired" if has_some else ": no credentials"
            mend = self._credentials.mend
        elif status == 403:
            found, mend = (
                f"{found}: it may not be read or written with these credentials",
                self._credentials.mend,
            )
        elif status == 206:
            found = f"{found}: a part of what was asked for"
        raise PacsError(self._host, found, f"status {expected[0]}", mend)

    def _listed(self, answer: httpx.Response) -> list[dict[str, Any]]:
        try:
            answer.read()
            listed = answer.json()
        except ValueError:
            listed = None
        if not isinstance(listed, list) or not all(isinstance(one, dict) for one in listed):
            kind = answer.headers.get("content-type", "no type")[:60]
            raise PacsError(
                self._host, f"an answer that is no list in JSON ({kind})", _JSON, "check the address"
            )
        return listed

    def _followed(self, url: str, answer: httpx.Response, method: str) -> str:
        """Where a redirect leads; to another host nobody is led, and no token either."""
        target: str = urljoin(url, answer.headers.get("location", ""))
        here, there = urlsplit(url), urlsplit(target)
        if (here.scheme, here.netloc) != (there.scheme, there.netloc):
            found = f"a redirect to {there.scheme}://{there.hostname}"
            mend = "give that address, if you trust it with your credentials and data"
            raise PacsError(self._host, found, f"answers of {here.scheme}://{here.netloc}", mend)
        if method != "GET" and answer.status_code not in (307, 308):
            raise PacsError(
                self._host, f"a redirect of what is sent ({answer.status_code})", "that it is taken"
            )
        return target

    @contextmanager
    def _in_words(self) -> Iterator[None]:
        """Turn what the client below raises into an error that names the host, and quotes nothing."""
        try:
            yield
        except httpx.TimeoutException:
            found, mend = "no answer in time", "check the network, or try again"
            raise PacsError(self._host, found, "an answer", mend) from None
        except httpx.ConnectError as error:
            raise self._unreachable(error) from None
        except (httpx.HTTPError, httpx.InvalidURL, httpx.StreamError):
            found = "a connection that broke off"
            raise PacsError(self._host, found, "a whole answer", "run it again") from None

    def _unreachable(self, error: BaseException) -> PacsError:
        words = str(error)
        if "CERTIFICATE_VERIFY_FAILED" in words or "certificate" in words.lower():
            mend = f"name the certificate of your private authority by --ca FILE or {CERTIFICATES}"
            return PacsError(
                self._host, "a certificate that is not trusted", "one of a known authority", mend
            )
        if "SSL" in words or "TLS" in words:
            return PacsError(self._host, "no TLS that both sides speak", "https", "check the address")
        mend = "check the address, the network and that the server runs"
        return PacsError(self._host, "no connection", "a server of DICOMweb", mend)


def _trusted(certificates: Path | None) -> ssl.SSLContext:
    """Whom to trust: the authorities of a file alone, else those of the machine and of common browsers."""
    named = os.environ.get(CERTIFICATES)
    place = certificates if certificates is not None else Path(named) if named else None
    try:
        if place is not None:
            return ssl.create_default_context(cafile=str(place))
        import certifi

        context = ssl.create_default_context()
        context.load_verify_locations(certifi.where())
    except ssl.SSLError:
        raise FileError(str(place), "no certificates", "a file of certificates (PEM)") from None
    except OSError as error:
        found = error.strerror or type(error).__name__
        raise FileError(str(place), found, "a file of certificates (PEM)") from None
    return context

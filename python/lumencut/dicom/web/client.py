"""Requests to a PACS: credentials, certificates, redirects and errors."""

from __future__ import annotations

import os
import ssl
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlencode, urljoin, urlsplit

import httpx

from lumencut.dicom.web.address import Address
from lumencut.dicom.web.credentials import CERTIFICATES, Credentials
from lumencut.errors import FileError, PacsError

AT_ONCE = 4
_TIMEOUT = httpx.Timeout(60.0, connect=10.0, pool=None)
_MOST_REDIRECTS = 5
_JSON = "application/dicom+json"


class Client:
    """A connection to one PACS, closed at the end of its context; several threads may use it.

    Parameters
    ----------
    address : Address
        The PACS.
    token_file : path, optional
        A file that holds a token; it is read again if the PACS rejects the token.
    certificates : path, optional
        A file of certificates (PEM) to trust instead of those of the machine; default: the file in
        LUMENCUT_DICOMWEB_CA.

    Raises
    ------
    FileError
        For unreadable files, and files without certificates or a token.
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
            # No proxies on this machine; this class reads netrc and certificates itself.
            trust_env=is_secure,
            timeout=_TIMEOUT,
            limits=httpx.Limits(max_connections=AT_ONCE),
            follow_redirects=False,
            # Servers would compress the pixels, which takes twenty times as long as sending them.
            headers={"Accept-Encoding": "identity"},
        )

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close all connections, including those in use."""
        self._http.close()

    def json(self, path: str, params: Mapping[str, str] | None = None) -> list[dict[str, Any]]:
        """Return the results of a search; empty if it finds nothing.

        Raises
        ------
        PacsError
            If the PACS rejects the search, cannot be reached, or answers with something else.
        """
        with self.answered("GET", path, params, {"Accept": _JSON}) as answer:
            if answer.status_code == 204:
                return []
            self.require(answer, 200)
            return self._listed(answer)

    def post(self, path: str, content: bytes, content_type: str) -> tuple[int, dict[str, Any]]:
        """Send content; return the status and the JSON answer, empty if it is not JSON."""
        headers = {"Accept": _JSON, "Content-Type": content_type}
        with self.answered("POST", path, None, headers, content) as answer:
            if answer.status_code in (401, 403):
                self.require(answer, 200)
            try:
                answer.read()
                parsed = answer.json()
            except ValueError:
                parsed = {}
            parsed = parsed[0] if isinstance(parsed, list) and parsed else parsed
            return answer.status_code, parsed if isinstance(parsed, dict) else {}

    @contextmanager
    def answered(
        self,
        method: str,
        path: str,
        params: Mapping[str, str] | None = None,
        headers: Mapping[str, str] | None = None,
        content: bytes | None = None,
    ) -> Iterator[httpx.Response]:
        """Yield the answer to a request before its body is read; redirects are followed within a host.

        Raises
        ------
        PacsError
            If the PACS cannot be reached, the connection breaks, or it redirects to another host.
        """
        url = f"{self._base}{path}"
        if params:
            # Some servers accept wildcards and lists only unescaped, not as %2A and %2C.
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
                        # Another thread may already have read the new credentials.
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
        """Reject an answer with an unexpected status; the error states the remedy."""
        status = answer.status_code
        if status in expected:
            return
        mend = "check the address" if status == 404 else ""
        found = f"status {status}"
        if status == 401:
            has_some = bool(self._credentials.header)
            found += ": the credentials are rejected, wrong or expired" if has_some else ": no credentials"
            mend = self._credentials.mend
        elif status == 403:
            found, mend = (
                f"{found}: these credentials may not read or write it",
                self._credentials.mend,
            )
        elif status == 206:
            found = f"{found}: only a part of the request"
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
                self._host, f"an answer that is not a JSON list ({kind})", _JSON, "check the address"
            )
        return listed

    def _followed(self, url: str, answer: httpx.Response, method: str) -> str:
        """Return the target of a redirect; another host is rejected, because it would get the token."""
        target: str = urljoin(url, answer.headers.get("location", ""))
        here, there = urlsplit(url), urlsplit(target)
        if (here.scheme, here.netloc) != (there.scheme, there.netloc):
            found = f"a redirect to {there.scheme}://{there.hostname}"
            mend = "give that address, if you trust it with your credentials and data"
            raise PacsError(self._host, found, f"answers of {here.scheme}://{here.netloc}", mend)
        if method != "GET" and answer.status_code not in (307, 308):
            raise PacsError(
                self._host, f"a redirect of sent objects ({answer.status_code})", "acceptance of the objects"
            )
        return target

    @contextmanager
    def _in_words(self) -> Iterator[None]:
        """Convert errors of httpx into an error that names the host and quotes nothing of the answer."""
        try:
            yield
        except httpx.TimeoutException:
            found, mend = "no answer in time", "check the network, or try again"
            raise PacsError(self._host, found, "an answer", mend) from None
        except httpx.ConnectError as error:
            raise self._unreachable(error) from None
        except (httpx.HTTPError, httpx.InvalidURL, httpx.StreamError):
            found = "an interrupted connection"
            raise PacsError(self._host, found, "a complete answer", "run it again") from None

    def _unreachable(self, error: BaseException) -> PacsError:
        words = str(error)
        if "CERTIFICATE_VERIFY_FAILED" in words or "certificate" in words.lower():
            mend = f"name the certificate of your private authority by --ca FILE or {CERTIFICATES}"
            return PacsError(
                self._host, "an untrusted certificate", "a certificate of a known authority", mend
            )
        if "SSL" in words or "TLS" in words:
            return PacsError(self._host, "no common TLS version", "https", "check the address")
        mend = "check the address, the network and that the server runs"
        return PacsError(self._host, "no connection", "a server of DICOMweb", mend)


def _trusted(certificates: Path | None) -> ssl.SSLContext:
    """Return the trusted certificate authorities: those of a file, or else of the machine and certifi."""
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

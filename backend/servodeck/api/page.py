"""Serves the built page from the folder `static`. Knows files, caching and encodings, nothing of boards.

A file whose name carries its hash may be cached for ever; all others are requested again each time. The build
wrote compressed files beside the plain ones. A file that was requested once stays in memory: on this loop
STOP waits, for no disk and no thread of a thousand unknown clients that load the page.
"""

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from mimetypes import guess_type
from pathlib import Path

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.responses import PlainTextResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from servodeck.threads import in_thread

STATIC = Path(__file__).parents[1] / "static"
INDEX = "index.html"
HASHED_FOLDER = "assets/"  # where Vite puts files named by their content
FOR_EVER = "public, max-age=31536000, immutable"
ASK_AGAIN = "no-cache"
NOT_BUILT = (
    "The gateway runs, but its page is not built: `npm run build` does it, `npm start` does everything.\n"
)
# The smallest first; what the build writes, see vite.config.ts. Browsers take `br` at secure addresses only.
ENCODINGS = {"br": ".br", "gzip": ".gz"}
METHODS = ("GET", "HEAD")


@dataclass(frozen=True)
class CachedFile:
    body: bytes
    etag: str


class Page:
    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._index = folder / INDEX
        self._version: tuple[int, ...] | None = None
        # What there is, and of that what was requested, by its path in the folder.
        self._files: dict[str, Path] = {}
        self._cached: dict[str, CachedFile] = {}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["method"] not in METHODS:
            raise HTTPException(405, headers={"Allow": ", ".join(METHODS)})
        await self._notice_builds()
        answer = await self._answer(scope["path"].removeprefix("/") or INDEX, Headers(scope=scope))
        await answer(scope, receive, send)

    async def _notice_builds(self) -> None:
        """The page may be built while we run. Its index changes with all that it names."""
        version = version_of(self._index)
        if version != self._version:
            self._files = {} if version is None else await in_thread(lambda: files_in(self._folder))
            self._cached = {}
            self._version = version

    async def _answer(self, path: str, request: Headers) -> Response:
        if path == INDEX and path not in self._files:
            return PlainTextResponse(NOT_BUILT, 503)
        coded = {name: path + suffix for name, suffix in ENCODINGS.items() if path + suffix in self._files}
        encoding = next((name for name in taken(request.get("accept-encoding", "")) if name in coded), None)
        cached = await self._read(path if encoding is None else coded[encoding])
        headers = {
            "ETag": cached.etag,
            "Cache-Control": FOR_EVER if path.startswith(HASHED_FOLDER) else ASK_AGAIN,
        }
        if coded:
            headers["Vary"] = "Accept-Encoding"
        if cached.etag in request.get("if-none-match", "").replace("W/", "").split(", "):
            return Response(None, 304, headers)
        if encoding is not None:
            headers["Content-Encoding"] = encoding
        return Response(cached.body, 200, headers, media_type=guess_type(path)[0])

    async def _read(self, path: str) -> CachedFile:
        here = self._cached  # the page may be built again meanwhile
        if path not in here:
            try:
                body = await in_thread(self._files[path].read_bytes)
            except (KeyError, FileNotFoundError):
                raise HTTPException(404) from None
            # Never of size and time: an upgrade may leave them as they were.
            here[path] = CachedFile(body, f'"{hashlib.blake2s(body).hexdigest()}"')
        return here[path]


def version_of(index: Path) -> tuple[int, ...] | None:
    """None where there is none."""
    try:
        found = index.stat()
    except OSError:
        return None
    return (found.st_ino, found.st_size, found.st_mtime_ns, found.st_ctime_ns)


def files_in(folder: Path) -> dict[str, Path]:
    return {file.relative_to(folder).as_posix(): file for file in folder.rglob("*") if file.is_file()}


def taken(accept_encoding: str) -> Iterator[str]:
    """Of our encodings those that the client takes, ours first. RFC 9110, 12.5.3."""
    weights = dict(_weighed(part) for part in accept_encoding.split(",") if part.strip())
    return (name for name in ENCODINGS if weights.get(name, weights.get("*", 0.0)) > 0)


def _weighed(part: str) -> tuple[str, float]:
    name, _, weight = part.partition(";")
    try:
        return name.strip().lower(), float(weight.strip().lower().removeprefix("q=") or 1)
    except ValueError:
        return name.strip().lower(), 0.0


def page(folder: Path) -> ASGIApp:
    return Page(folder)

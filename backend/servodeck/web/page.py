"""Serves the built page from the folder `static`. Knows files, caching and encodings, nothing of boards.

A file whose name carries its hash may be kept for ever; all others are asked for again each time. The
build wrote compressed files beside the plain ones: nothing is compressed on this loop, on which STOP waits.
"""

import hashlib
import os
from collections.abc import Iterator
from mimetypes import guess_type
from pathlib import Path

from starlette.datastructures import Headers
from starlette.responses import FileResponse, PlainTextResponse, Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles
from starlette.types import ASGIApp, Scope

STATIC = Path(__file__).parents[1] / "static"
HASHED_FOLDER = "assets"  # where Vite puts files named by their content
FOR_EVER = "public, max-age=31536000, immutable"
ASK_AGAIN = "no-cache"
NOT_BUILT = (
    "The gateway runs, but its page is not built: `npm run build` does it, `npm start` does everything.\n"
)
# The smallest first; what the build writes, see vite.config.ts. Browsers take `br` at secure addresses only.
ENCODINGS = {"br": ".br", "gzip": ".gz"}


class Page(StaticFiles):
    def __init__(self, folder: Path) -> None:
        super().__init__(directory=folder, html=True, check_dir=False)
        self._index = folder / "index.html"

    async def check_config(self) -> None:
        """Nothing: the folder may come while we run, when the page is built."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        if path == "." and not self._index.exists():
            return PlainTextResponse(NOT_BUILT, 503)
        response = await super().get_response(path, scope)
        hashed = Path(path).parts[:1] == (HASHED_FOLDER,)
        response.headers["Cache-Control"] = FOR_EVER if hashed else ASK_AGAIN
        return response

    def file_response(
        self,
        full_path: str | os.PathLike[str],
        stat_result: os.stat_result,
        scope: Scope,
        status_code: int = 200,
    ) -> Response:
        asked = Headers(scope=scope)
        plain = Path(full_path)
        coded = {
            name: found for name, suffix in ENCODINGS.items() if (found := beside(plain, suffix)).is_file()
        }
        encoding = next((name for name in taken(asked.get("accept-encoding", "")) if name in coded), None)
        path = plain if encoding is None else coded[encoding]
        response = FileResponse(
            path,
            status_code=status_code,
            media_type=guess_type(plain)[0],
            stat_result=stat_result if encoding is None else path.stat(),
        )
        if coded:
            response.headers["Vary"] = "Accept-Encoding"
        if encoding is not None:
            response.headers["Content-Encoding"] = encoding
        if plain == self._index:
            # An upgrade may leave size and time as they were, and names files that the old one does not.
            response.headers["ETag"] = f'"{hashlib.blake2s(path.read_bytes()).hexdigest()}"'
        if self.is_not_modified(response.headers, asked):
            return NotModifiedResponse(response.headers)
        return response


def beside(path: Path, suffix: str) -> Path:
    return path.with_name(path.name + suffix)


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

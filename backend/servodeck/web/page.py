"""Serves the built page from the folder `static`. Knows files and caching, nothing of boards.

A file whose name carries its hash may be kept for ever; all others are asked for again each time.
"""

from pathlib import Path

from starlette.middleware.gzip import GZipMiddleware
from starlette.responses import PlainTextResponse, Response
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Scope

STATIC = Path(__file__).parents[1] / "static"
HASHED_FOLDER = "assets"  # where Vite puts files named by their content
FOR_EVER = "public, max-age=31536000, immutable"
ASK_AGAIN = "no-cache"
NOT_BUILT = (
    "The gateway runs, but its page is not built: `npm run build` does it, `npm start` does everything.\n"
)
# Little compression for little time on the event loop, on which STOP waits too.
COMPRESS_LEVEL = 4


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


def page(folder: Path) -> ASGIApp:
    return GZipMiddleware(Page(folder), minimum_size=1024, compresslevel=COMPRESS_LEVEL)

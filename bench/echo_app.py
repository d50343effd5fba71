"""The least that could answer a page over a WebSocket: the gateway's server, and an application that echoes.

What a round trip through it takes is what browser, loopback and server take. Usage: echo_app.py HOST PORT
"""

import sys

import uvicorn
from starlette.types import Receive, Scope, Send

# A page that is isolated has a clock of 5 µs steps.
HEADERS = [
    (b"content-type", b"text/html"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-embedder-policy", b"require-corp"),
]


async def app(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "http":
        await send({"type": "http.response.start", "status": 200, "headers": HEADERS})
        await send({"type": "http.response.body", "body": b"<title>echo</title>"})
    elif scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.accept"})
        while (message := await receive())["type"] == "websocket.receive":
            await send({"type": "websocket.send", "text": message["text"]})


if __name__ == "__main__":
    uvicorn.run(
        app,
        host=sys.argv[1],
        port=int(sys.argv[2]),
        log_level="warning",
        lifespan="off",
        ws="websockets-sansio",
        ws_per_message_deflate=False,
    )

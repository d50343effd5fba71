"""The command that lets an assistant in: a server of the Model Context Protocol on standard input and output,
as the programs of assistants start it.

Loads the SDK only when it runs. Everything that it prints goes to stderr, because stdout is the protocol's.
"""

from importlib.util import find_spec
from typing import Annotated

import typer

from servodeck.cli.options import FAILURE, Token, TokenFile, Url, fail
from servodeck.cli.remote import HERE
from servodeck.errors import GatewayError

MISSING = "The parts for assistants are not installed: pip install 'servodeck[mcp]'."


def mcp(
    url: Url = HERE,
    token: Token = "",
    token_file: TokenFile = None,
    drive: Annotated[
        bool,
        typer.Option("--drive", help="On the gateway's own computer: the assistant may move the robot, too."),
    ] = False,
) -> None:
    """Serve tools to an assistant (Model Context Protocol): look at the robot, propose groups, stop; with the
    token of a driver also move it.
    """
    import asyncio  # other commands need none

    if find_spec("mcp") is None or find_spec("PIL") is None:
        fail(MISSING, FAILURE)
    secret = token or (token_file.read_text("utf-8").strip() if token_file else "")
    try:
        asyncio.run(serve(url, secret, drive))
    except (GatewayError, ValueError) as error:
        fail(f"No tools at {url}: {error}", FAILURE)


async def serve(url: str, token: str, drive: bool) -> None:
    """Until the assistant closes its side. What it has in motion is stopped then."""
    from servodeck.assistant.gateway import Requests
    from servodeck.assistant.server import make_server
    from servodeck.client.asynchronous import AsyncRobot
    from servodeck.client.opening import TIMEOUT_S, gateway_at

    requests = Requests(gateway_at(url, token, None, None, TIMEOUT_S))
    me = await requests.me()
    # Who starts a program on the gateway's computer owns the robot; an assistant drives only when told so.
    drives = drive if me.is_owner_here else me.role in ("driver", "owner")
    async with AsyncRobot(url, token=token) as robot:
        await make_server(robot, requests, drives=drives).run_stdio_async()

"""One line for whoever runs the gateway: who was not let in, where, and why. Knows a request's head and the
error; how often such lines are written is the log's.
"""

import logging

from starlette.types import Scope

from servodeck.access.gate import asks_for_socket
from servodeck.errors import GatewayError

LOGGER = "servodeck.access"
# Of what somebody unknown has written.
MAX_CHARACTERS = 100
log = logging.getLogger(LOGGER)


def log_refusal(scope: Scope, error: GatewayError) -> None:
    client = scope.get("client")
    facts = {
        "from": client[0] if client else None,
        "type": "websocket" if asks_for_socket(scope["headers"]) else scope["type"],
        "path": scope["path"][:MAX_CHARACTERS],
        "code": error.code,
        "reason": error.detail[:MAX_CHARACTERS],
    }
    log.info("refused", extra={"facts": facts})

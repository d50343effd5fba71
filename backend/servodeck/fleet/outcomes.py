"""How a request to a robot of the fleet may end. Knows no broker."""

from collections.abc import Collection

from servodeck.fleet.messages import RefusalCode
from servodeck.value import value


class FleetError(Exception):
    """A request that was not done."""


class RefusedError(FleetError):
    def __init__(self, gateway: str, code: RefusalCode, detail: str) -> None:
        super().__init__(f"{gateway}: {detail}")
        self.gateway = gateway
        self.code = code
        self.detail = detail


class NoAnswerError(FleetError):
    """It was not sent, or nothing came back in time: whether it was done is unknown."""


@value
class StopReport:
    """Those that latched, those that latched but have no port to stop, with the reason, and those that were
    there and did not answer.
    """

    stopped: tuple[str, ...]
    refused: tuple[tuple[str, str], ...]
    missing: tuple[str, ...]


def report_of(stopped: Collection[str], refused: dict[str, str], missing: Collection[str]) -> StopReport:
    return StopReport(tuple(sorted(stopped)), tuple(sorted(refused.items())), tuple(sorted(missing)))

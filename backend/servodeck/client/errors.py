"""The gateway's errors for a program: its codes as the classes of servodeck.errors, and two of this side of
the line. Knows no transport.
"""

from collections.abc import Iterator

from servodeck.errors import GatewayError, NoAnswerError, PortBusyError, TooManyError


class UnreachableError(NoAnswerError):
    """No gateway answers there, or its answer was lost: the outcome is unknown."""


class TimedOutError(NoAnswerError, TimeoutError):
    """The end did not come in the time that was allowed; what this program had begun is stopped."""


def classes_below(root: type[GatewayError]) -> Iterator[type[GatewayError]]:
    for each in root.__subclasses__():
        yield each
        yield from classes_below(each)


OF_THIS_SIDE = (UnreachableError, TimedOutError)
# The first class of a code is the most general one; `busy` has two, with a status each.
BY_CODE: dict[tuple[str, int | None], type[GatewayError]] = {}
for _each in classes_below(GatewayError):
    if _each not in OF_THIS_SIDE:
        BY_CODE.setdefault((_each.code, _each.status), _each)
        BY_CODE.setdefault((_each.code, None), _each)


def error_of(
    code: str,
    detail: str,
    status: int | None = None,
    *,
    wait_s: float = 1.0,
    held_by: tuple[str, ...] = (),
) -> GatewayError:
    """`status` is None for what ended later than its request."""
    found = BY_CODE.get((code, status)) or BY_CODE.get((code, None))
    if found is None:  # of a newer gateway
        return GatewayError(f"{detail} ({code})")
    if issubclass(found, TooManyError):
        return found(detail, wait_s)
    if issubclass(found, PortBusyError):
        return found(detail, held_by)
    return found(detail)

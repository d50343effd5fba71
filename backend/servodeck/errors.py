"""All errors as one tree: each class has its code on the wire and its HTTP status.

Has no sentences of its own; the code that raises says what happened and what to do about it.
"""

import math
from collections.abc import Sequence
from typing import ClassVar, Literal

ErrorCode = Literal[
    "closed",
    "lost",
    "portMissing",
    "portBusy",
    "portDenied",
    "hidDenied",
    "otherDevice",
    "boardUnknown",
    "wrongBoard",
    "echo",
    "boardSilent",
    "noAnswer",
    "notSupported",
    "notOnThisCable",
    "latched",
    "notDriving",
    "expired",
    "busy",
    "slotBroken",
    "slotChanged",
    "batteryLow",
    "cancelled",
    "outOfRange",
    "malformed",
    "forbidden",
    "notPaired",
    "pairingFailed",
    "pairingLocked",
    "wrongType",
    "notFound",
    "methodNotAllowed",
    "conflict",
    "tooLarge",
    "tooMany",
    "cameraFailed",
    "storageFull",
    "storageBusy",
    "storageFailed",
    "damaged",
    "internal",
]


class GatewayError(Exception):
    """The root; raised itself only for a defect of ours."""

    code: ClassVar[ErrorCode] = "internal"
    status: ClassVar[int] = 500

    def __init__(self, detail: str) -> None:
        super().__init__(detail)
        self.detail = detail
        self.headers: dict[str, str] = {}


class PortError(GatewayError):
    """The serial port cannot be used; the link tries again by itself."""

    code: ClassVar[ErrorCode] = "lost"
    status: ClassVar[int] = 503


class PortLostError(PortError):
    """It went away while open."""


class PortMissingError(PortError):
    code: ClassVar[ErrorCode] = "portMissing"


class PortBusyError(PortError):
    """`held_by`: the programs that have it, so far as this account may see: "name (process number)"."""

    code: ClassVar[ErrorCode] = "portBusy"

    def __init__(self, detail: str, held_by: Sequence[str] = ()) -> None:
        super().__init__(detail)
        self.held_by = tuple(held_by)


class PortDeniedError(PortError):
    code: ClassVar[ErrorCode] = "portDenied"


class HidDeniedError(PortDeniedError):
    """A board on its own USB cable, which takes a rule of its own on Linux."""

    code: ClassVar[ErrorCode] = "hidDenied"


class OtherDeviceError(PortError):
    """The name leads to another device now, or perhaps: a person must choose."""

    code: ClassVar[ErrorCode] = "otherDevice"


class ClosedError(GatewayError):
    """No port is open and none was requested, or it was closed on request."""

    code: ClassVar[ErrorCode] = "closed"
    status: ClassVar[int] = 409


class BoardError(GatewayError):
    """The line is open, and the board at its end cannot be driven."""

    status: ClassVar[int] = 409


class BoardUnknownError(BoardError):
    """The board has not been named."""

    code: ClassVar[ErrorCode] = "boardUnknown"


class WrongBoardError(BoardError):
    """Its answers are not those of the board it is taken for."""

    code: ClassVar[ErrorCode] = "wrongBoard"


class EchoError(BoardError):
    """The line sends back what it is given."""

    code: ClassVar[ErrorCode] = "echo"


class BoardSilentError(BoardError):
    """It does not answer what such a board always answers: it may be off. It is queried again."""

    code: ClassVar[ErrorCode] = "boardSilent"
    status: ClassVar[int] = 504


class LatchedError(GatewayError):
    """Stopped: motion waits for Resume."""

    code: ClassVar[ErrorCode] = "latched"
    status: ClassVar[int] = 409


class NotDrivingError(GatewayError):
    """Another client drives, or none does."""

    code: ClassVar[ErrorCode] = "notDriving"
    status: ClassVar[int] = 409


class ExpiredError(GatewayError):
    """It was requested too long ago to be done now."""

    code: ClassVar[ErrorCode] = "expired"
    status: ClassVar[int] = 409


class BusyError(GatewayError):
    """Too much is waiting already."""

    code: ClassVar[ErrorCode] = "busy"
    status: ClassVar[int] = 429


class TooManyError(GatewayError):
    """Requested more often than this caller may."""

    code: ClassVar[ErrorCode] = "tooMany"
    status: ClassVar[int] = 429

    def __init__(self, detail: str, wait_s: float) -> None:
        super().__init__(detail)
        self.headers = {"Retry-After": str(math.ceil(wait_s))}


class MovingError(GatewayError):
    """The robot is not at rest, or may not be, or its board is at work: that has to end first."""

    code: ClassVar[ErrorCode] = "busy"
    status: ClassVar[int] = 409


class SlotBrokenError(GatewayError):
    """The slot holds half a group (S35)."""

    code: ClassVar[ErrorCode] = "slotBroken"
    status: ClassVar[int] = 409


class SlotChangedError(GatewayError):
    """The slot does not hold any more what the caller has seen there."""

    code: ClassVar[ErrorCode] = "slotChanged"
    status: ClassVar[int] = 409


class BatteryLowError(GatewayError):
    """The battery is at its alarm, and the robot refuses new runs then. A person may run it anyway."""

    code: ClassVar[ErrorCode] = "batteryLow"
    status: ClassVar[int] = 409


class CancelledError(GatewayError):
    """Taken out of the queue before it left."""

    code: ClassVar[ErrorCode] = "cancelled"
    status: ClassVar[int] = 409


class NoAnswerError(GatewayError):
    code: ClassVar[ErrorCode] = "noAnswer"
    status: ClassVar[int] = 504


class NotSupportedError(GatewayError):
    """This board has no such command."""

    code: ClassVar[ErrorCode] = "notSupported"
    status: ClassVar[int] = 409


class NotOnThisCableError(GatewayError):
    """The board has it, and no hardware has confirmed how this cable carries it."""

    code: ClassVar[ErrorCode] = "notOnThisCable"
    status: ClassVar[int] = 409


class OutOfRangeError(GatewayError):
    code: ClassVar[ErrorCode] = "outOfRange"
    status: ClassVar[int] = 422


class MalformedError(GatewayError):
    code: ClassVar[ErrorCode] = "malformed"
    status: ClassVar[int] = 422


class ForbiddenError(GatewayError):
    """Requested from an address or a page that may not do so."""

    code: ClassVar[ErrorCode] = "forbidden"
    status: ClassVar[int] = 403


class NotPairedError(GatewayError):
    """An unauthenticated caller requested what only paired devices get."""

    code: ClassVar[ErrorCode] = "notPaired"
    status: ClassVar[int] = 401


class TokenExpiredError(NotPairedError):
    """The time for which it was made is over."""


class PairingError(GatewayError):
    """That link or code is not valid."""

    code: ClassVar[ErrorCode] = "pairingFailed"
    status: ClassVar[int] = 403


class PairingLockedError(PairingError):
    """Too many wrong codes."""

    code: ClassVar[ErrorCode] = "pairingLocked"
    status: ClassVar[int] = 429


class TooLargeError(GatewayError):
    """The request is larger than its route allows."""

    code: ClassVar[ErrorCode] = "tooLarge"
    status: ClassVar[int] = 413


class WrongTypeError(GatewayError):
    """A body that does not call itself JSON: a page of another site could send it without asking."""

    code: ClassVar[ErrorCode] = "wrongType"
    status: ClassVar[int] = 415


class NotFoundError(GatewayError):
    code: ClassVar[ErrorCode] = "notFound"
    status: ClassVar[int] = 404


class MethodNotAllowedError(GatewayError):
    """That address takes other methods."""

    code: ClassVar[ErrorCode] = "methodNotAllowed"
    status: ClassVar[int] = 405


class ConflictError(GatewayError):
    """Another client has changed it since it was read."""

    code: ClassVar[ErrorCode] = "conflict"
    status: ClassVar[int] = 412


class CameraError(GatewayError):
    """A camera at the gateway does not answer, or sends no picture that a page shows."""

    code: ClassVar[ErrorCode] = "cameraFailed"
    status: ClassVar[int] = 502


class StorageError(GatewayError):
    """The library cannot be read or written; what it holds is unharmed, and each request tries again."""

    code: ClassVar[ErrorCode] = "storageFailed"
    status: ClassVar[int] = 503


class DamagedTextError(GatewayError):
    """The disk returns other data than was written."""

    code: ClassVar[ErrorCode] = "damaged"
    status: ClassVar[int] = 500


class StorageFullError(StorageError):
    code: ClassVar[ErrorCode] = "storageFull"
    status: ClassVar[int] = 507


class StorageBusyError(StorageError):
    code: ClassVar[ErrorCode] = "storageBusy"

"""The messages between a page and the gateway that serves it while a person drives one robot of a fleet.

`python -m servodeck.fleet.drive_messages` prints their JSON schema, from which the page's types are made.
Knows no socket and no broker.
"""

import json
import sys
from typing import Annotated, Literal

from pydantic import Field, TypeAdapter

from servodeck.fleet.messages import RefusalCode
from servodeck.intents import Nonce, Slot, Target
from servodeck.schema import Message, schema_of
from servodeck.snapshots import MotionState


class DriveBeat(Message):
    """The page is there: its answer to each report, with the nonce of that. The robot counts the beat from
    when it issued the nonce, so one that was held up on the way is no sign of life.
    """

    type: Literal["beat"]
    nonce: Nonce | None


class DriveMove(Message):
    """As the `move` of a page at its own robot. `nonce`: the newest that the page has got."""

    type: Literal["move"]
    targets: Annotated[list[Target], Field(min_length=1, max_length=253)]
    duration_ms: Annotated[int, Field(ge=0, le=30_000)]
    nonce: Nonce


class DriveRun(Message):
    """Run the group in `slot`, once."""

    type: Literal["run"]
    slot: Slot
    nonce: Nonce


class DriveRequest(Message):
    """Request the lease again, after it was refused or has passed to somebody else."""

    type: Literal["request"]


class DriveRelease(Message):
    """Give the lease back; the connection ends."""

    type: Literal["release"]


AnyDriveWish = DriveBeat | DriveMove | DriveRun | DriveRequest | DriveRelease
DriveWish = Annotated[AnyDriveWish, Field(discriminator="type")]
drive_wish: TypeAdapter[AnyDriveWish] = TypeAdapter(DriveWish)

Lease = Literal["requested", "driving", "none"]


class DriveLease(Message):
    """`driver`: who has the lease; null for nobody and for an unknown one."""

    type: Literal["lease"] = "lease"
    lease: Lease
    driver: str | None


class DriveLive(Message):
    """The newest report of the robot, at most 20 a second while it is driven. `motion` is null where it was a
    state, which has none.
    """

    type: Literal["live"] = "live"
    nonce: Nonce
    latch: bool
    motion: MotionState | None


class DriveRefused(Message):
    """A wish was not carried out. `code` is null where no answer has come."""

    type: Literal["refused"] = "refused"
    code: RefusalCode | None
    detail: str


AnyDriveNews = DriveLease | DriveLive | DriveRefused
DriveNews = Annotated[AnyDriveNews, Field(discriminator="type")]


if __name__ == "__main__":
    schema = schema_of("DriveMessage", {"DriveWish": DriveWish}, {"DriveNews": DriveNews})
    json.dump(schema, sys.stdout, indent=2)
    sys.stdout.write("\n")

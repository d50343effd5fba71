"""What people do with the robot, noted where all of it passes, whichever door it came through: commands that
leave the wire, the lease, plays, downloads, STOP and resume.

Knows commands and names of people; stores nothing and decides nothing.
"""

from typing import Literal, Protocol

from servodeck.protocol.values import Command, Erase, Move, Release, Run, SetSpeed, Stop
from servodeck.robot.hub import Session
from servodeck.snapshots import JobState, PlayState

RobotAct = Literal[
    "tookLease",
    "leftLease",
    "moved",
    "ran",
    "endedGroup",
    "played",
    "downloaded",
    "downloadFailed",
    "erased",
    "setSpeed",
    "unpowered",
    "stopped",
    "resumed",
    "calibrated",
    "allowedUnattended",
    "boardChosen",
]
ACT_OF: dict[type[Command], RobotAct] = {
    Move: "moved",
    Run: "ran",
    Stop: "endedGroup",
    Erase: "erased",
    SetSpeed: "setSpeed",
    Release: "unpowered",
}


class Witness(Protocol):
    def __call__(self, act: RobotAct, who: str | None, about: str = "") -> None:
        """`who` by the present name; None where no person did it. `about`: a slot, a servo or a cause."""


def unseen(act: RobotAct, who: str | None, about: str = "") -> None:
    """Where no list is kept."""


class Acts:
    def __init__(self) -> None:
        self.note: Witness = unseen
        self._driver: Session | None = None
        self._latest: dict[type, str] = {}

    def left(self, command: Command, who: str) -> None:
        """A command of that person leaves; frames of a download are noted as one."""
        if act := ACT_OF.get(type(command)):
            slot = getattr(command, "slot", None)
            self.note(act, who, "" if slot is None else str(slot))

    def driver_is(self, driver: Session | None) -> None:
        if driver is self._driver:
            return
        if self._driver:
            self.note("leftLease", self._driver.caller.name)
        if driver:
            self.note("tookLease", driver.caller.name)
        self._driver = driver

    def job_is(self, job: JobState) -> None:
        """Noted at its end, because it may fail."""
        if job.status != "running" and self._is_new(job):
            act: RobotAct = "downloaded" if job.status == "done" else "downloadFailed"
            self.note(act, job.by, ", ".join(map(str, job.slots)))

    def play_is(self, play: PlayState) -> None:
        if self._is_new(play):
            self.note("played", play.by)

    def _is_new(self, state: JobState | PlayState) -> bool:
        before, self._latest[type(state)] = self._latest.get(type(state)), state.id
        return before != state.id

"""What a program may say to a robot, step by step: the requests of each method, and how their end is waited
for. Robot and AsyncRobot carry out the same steps.

Knows routes and their bodies; no transport, thread or event loop.
"""

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from math import inf
from typing import Any, Literal, get_args
from urllib.parse import quote

from servodeck.client.errors import TimedOutError, UnreachableError, error_of
from servodeck.client.gateway import Call, Pause, Steps, Welcome
from servodeck.client.values import Json, Servo, Servos, Snapshot, robot_in, servos_of, snapshot_of
from servodeck.errors import (
    CancelledError,
    ClosedError,
    ForbiddenError,
    GatewayError,
    LatchedError,
    NotDrivingError,
    NotFoundError,
    NotPairedError,
    OutOfRangeError,
)
from servodeck.protocol.timings import ERASE, LEASE, MOVE, PROGRAM

Units = Literal["deg", "board"]
"""Degrees from home, or the board's unit."""
Positions = Mapping[str, float] | Mapping[int, float] | Mapping[str | int, float]
Outcome = Literal["acknowledged", "silent", "sent"]
"""Of a run: the board has taken it; it should have said so and has not; such a board never says."""
Frames = Iterable[tuple[float, Positions]]
"""Each: the seconds that it takes, and where servos are at its end."""

KNOWN_UNITS = get_args(Units)
POSE_S = PROGRAM.move_ms / 1000
# The gateway stops motion two seconds after the last one.
BEAT_S = LEASE.silent_ms / 2000
LOOK_S = PROGRAM.look_ms / 1000
UNKNOWN_END_S = PROGRAM.unknown_end_ms / 1000
AFTER_END_S = PROGRAM.after_end_ms / 1000
IDENTIFIED_S = PROGRAM.identified_ms / 1000
# A download and an erase also wait until the longest frame that others can have begun has ended.
SETTLED_S = IDENTIFIED_S + MOVE.longest_ms / 1000
ERASE_S = ERASE.timeout_ms / 1000
START_S = PROGRAM.first_move_ms / 1000
# The gateway by itself stops what its program leaves moving.
LEAVE_S = LEASE.silent_ms / 1000
REMEMBERED_S = PROGRAM.names_ms / 1000
LATE_S = PROGRAM.late_ms / 1000


class Vocabulary:
    def __init__(self, now: Callable[[], float], *, take: bool) -> None:
        """`take`: an owner's, from any other driver."""
        self._now = now
        self._take = take
        self._servos: tuple[float, Servos] | None = None
        self.may_drive = False
        """This program has requested motion or the lease, and has not released it since."""
        self._moves_until_s = -inf
        """Until then a move of this program may be under way, which needs heartbeats."""
        self._is_closed = False

    def judge_open(self) -> None:
        """Raises ClosedError."""
        if self._is_closed:
            raise ClosedError("This robot was closed: its program makes a new one.")

    def close(self, most_s: float = inf) -> Steps[None]:
        """As `release`; the program may do nothing else any more."""
        self._is_closed = True
        yield from self.release(most_s)

    # Motion

    def move(
        self, positions: Positions, units: Units, seconds: float, *, wait: bool, timeout: float | None
    ) -> Steps[None]:
        until_s = self._until(timeout if wait else None)
        wanted = yield from self._positions(positions, units)
        body = {"timeMs": round(seconds * 1000), "positions": wanted}
        yield from self._move("/api/move", body, len(wanted), until_s, wait=wait)

    def pose(self, pose: str | int, seconds: float, *, wait: bool, timeout: float | None) -> Steps[None]:
        path = f"/api/poses/{quote(str(pose), safe='')}/apply"
        until_s = self._until(timeout if wait else None)
        yield from self._move(path, {"timeMs": round(seconds * 1000)}, 32, until_s, wait=wait)

    def _move(self, path: str, body: Json, servos: int, until_s: float, *, wait: bool) -> Steps[None]:
        more_s = IDENTIFIED_S + START_S * servos
        begun = yield from self._begin(path, {**body, "beats": True}, more_s, until_s)
        over_s = self._now() + begun["overInMs"] / 1000 + LATE_S
        self._moves_until_s = max(self._moves_until_s, over_s)
        if wait:
            yield from self._ended(self._moved(over_s), until_s)

    def _moved(self, until_s: float) -> Steps[None]:
        while (left_s := until_s - self._now()) > 0:
            yield Pause(min(left_s, BEAT_S))
            yield from self._look()
            yield from self._beat()

    def run(
        self,
        group: str | int,
        times: int,
        *,
        wait: bool,
        timeout: float | None,
        alone: float | None,
        anyway: bool = False,
    ) -> Steps[Outcome]:
        if wait and times == 0 and timeout is None:
            raise ValueError("times=0 repeats until stopped: add a timeout, or wait=False.")
        until_s = self._until(timeout if wait else None)
        slot = group if isinstance(group, int) else (yield from self._slot_of(group))
        body: dict[str, Any] = {"times": times, "anyway": anyway}
        if alone is not None:
            body["continueForMs"] = round(alone * 1000)
        begun = yield from self._begin(f"/api/slots/{slot}/run", body, IDENTIFIED_S + AFTER_END_S, until_s)
        if wait:
            yield from self._ended(self._ran(slot, timeout), until_s)
        outcome: Outcome = begun["outcome"]
        return outcome

    def _slot_of(self, name: str) -> Steps[int]:
        groups = (yield from self.snapshot()).groups
        found = [slot for slot, known in groups.items() if known == name]
        if len(found) != 1:
            known = ", ".join(sorted(set(groups.values()) - {""})) or "no names"
            problem = "Several slots hold" if found else "No slot is known to hold"
            raise NotFoundError(f"{problem} {name}. Known groups: {known}. Use a slot's number, or download.")
        return found[0]

    def _ran(self, slot: int, timeout: float | None) -> Steps[None]:
        begun_s = beaten_s = self._now()
        while running := (yield from self._look())["running"]:
            if running["slot"] != slot:
                raise CancelledError(f"Another group runs now: slot {running['slot']}.")
            ends_in_ms = running["endsInMs"]
            if timeout is None and ends_in_ms is not None:
                timeout = self._now() - begun_s + ends_in_ms / 1000 + AFTER_END_S
            if self._now() - begun_s > (UNKNOWN_END_S if timeout is None else timeout):
                raise TimedOutError(f"The end of slot {slot} was not reported in time, so it was stopped.")
            if self._now() - beaten_s >= BEAT_S:
                beaten_s = self._now()
                yield from self._beat()
            yield Pause(LOOK_S)

    def play(
        self,
        frames: Frames,
        units: Units,
        times: int,
        loop_from: int,
        *,
        wait: bool,
        timeout: float | None,
        alone: float | None,
        anyway: bool = False,
    ) -> Steps[None]:
        if wait and times == 0 and timeout is None:
            raise ValueError("times=0 repeats until stopped: add a timeout, or wait=False.")
        until_s = self._until(timeout if wait else None)
        bodies = yield from self._frames(frames, units)
        body: dict[str, Any] = {"frames": bodies, "times": times, "loopFrom": loop_from, "anyway": anyway}
        if alone is not None:
            body["continueForMs"] = round(alone * 1000)
        begun = yield from self._begin("/api/play", body, IDENTIFIED_S, until_s)
        if wait:
            yield from self._ended(self._played(begun["id"]), until_s)

    def _played(self, play_id: str) -> Steps[None]:
        beaten_s = self._now()
        while True:
            play = (yield from self._look())["play"]
            if play is None or play["id"] != play_id:
                raise CancelledError("Another group is played now.")
            if play["status"] == "ended":
                raise error_of(play["code"], play["detail"])
            if play["status"] == "done":
                return
            if self._now() - beaten_s >= BEAT_S:
                beaten_s = self._now()
                yield from self._beat()
            yield Pause(LOOK_S)

    def beats(self) -> Steps[None]:
        """For what moves, runs or is played and is not waited for: heartbeats until it has ended."""
        while True:
            status = yield Call("GET", "/api/status", is_safe=True)
            play = status["play"]
            is_played = play is not None and play["status"] == "playing"
            may_move = self._now() < self._moves_until_s and not status["latch"]
            if not (is_played or status["running"] or may_move):
                return
            if not (yield from self._beat()):
                return
            yield Pause(BEAT_S)

    def download(
        self,
        slot: int,
        frames: Frames,
        units: Units,
        name: str,
        replaces: str | None,
        *,
        wait: bool,
        timeout: float | None,
    ) -> Steps[Json]:
        bodies = yield from self._frames(frames, units)
        group: dict[str, Any] = {"slot": slot, "name": name, "frames": bodies}
        if replaces is not None:
            group["replaces"] = replaces
        until_s = self._until(timeout if wait else None)
        job: Json = yield from self._begin("/api/download", {"groups": [group]}, SETTLED_S, until_s)
        path = f"/api/jobs/{job['id']}"
        try:
            while wait and job["status"] == "running":
                self._judge_time(until_s, "The download did not end in time, so it was cancelled.")
                yield Pause(min(LOOK_S, max(0.0, until_s - self._now())))
                job = yield Call("GET", path, is_safe=True)
        except BaseException as error:
            if not isinstance(error, GeneratorExit):
                yield Call("DELETE", path, is_safe=True)
            raise
        if job["status"] in ("failed", "cancelled"):
            raise error_of(job["code"], job["detail"])
        return job

    def erase(self) -> Steps[None]:
        self.may_drive = True
        yield Call("POST", "/api/erase", {"take": self._take}, more_s=SETTLED_S + ERASE_S)

    # The right to drive

    def stop(self) -> Steps[Json | None]:
        stopped = yield Call("POST", "/api/stop", is_safe=True)
        unheld: Json | None = stopped["unheld"]
        return unheld

    def resume(self) -> Steps[None]:
        yield Call("POST", "/api/resume")

    def request_lease(self) -> Steps[bool]:
        self.may_drive = True
        action = "take" if self._take else "request"
        lease = yield Call("POST", "/api/lease", {"action": action}, is_safe=True)
        return bool(lease["drives"])

    def release(self, most_s: float = inf) -> Steps[None]:
        """Ends what this program has in motion, without a latch; no other client's motion."""
        if self.may_drive:
            # A caller who may not drive has nothing in motion: the gateway has seen to that.
            with suppress(ForbiddenError, NotPairedError):
                yield Call("POST", "/api/lease", {"action": "release"}, is_safe=True, most_s=most_s)
            self.may_drive = False
            self._moves_until_s = -inf

    # Looking

    def snapshot(self) -> Steps[Snapshot]:
        return snapshot_of((yield Welcome()))

    def status(self) -> Steps[Json]:
        status: Json = yield Call("GET", "/api/status", is_safe=True)
        return status

    def battery(self) -> Steps[int]:
        return int((yield Call("GET", "/api/battery", is_safe=True))["batteryMv"])

    def poses(self) -> Steps[dict[int, str]]:
        book = yield Call("GET", "/api/poses", is_safe=True)
        return {pose["id"]: pose["name"] for pose in book["poses"]}

    def servos(self) -> Steps[list[Servo]]:
        return (yield from self._described(is_new=True)).all()

    # Inside

    def _until(self, timeout: float | None) -> float:
        return inf if timeout is None else self._now() + timeout

    def _begin(self, path: str, body: Json, more_s: float, until_s: float) -> Steps[Any]:
        self.may_drive = True
        most_s = max(0.0, until_s - self._now())
        whole = {**body, "take": self._take}
        try:
            return (yield Call("POST", path, whole, is_keyed=True, more_s=more_s, most_s=most_s))
        except UnreachableError:
            if self._now() >= until_s:  # it may have begun
                yield from self.release()
                self._judge_time(until_s, LATE_WORDS)
            raise
        except (GatewayError, GeneratorExit):
            raise
        except BaseException:  # the program ends while the motion begins
            yield from self.release()
            raise

    def _ended(self, waiting: Steps[None], until_s: float) -> Steps[None]:
        """Whatever ends the waiting early ends the motion. A gateway that is not there any more ends it by
        itself, because no heartbeat follows.
        """
        try:
            answer: Any = None
            while True:
                try:
                    step = waiting.send(answer)
                except StopIteration:
                    return
                self._judge_time(until_s, LATE_WORDS)
                answer = yield within(step, until_s - self._now())
        except UnreachableError:
            waiting.close()
            if self._now() >= until_s:
                yield from self.release()
                self._judge_time(until_s, LATE_WORDS)
            raise
        except BaseException as error:
            waiting.close()
            if not isinstance(error, LatchedError | NotDrivingError | GeneratorExit):
                yield from self.release()
            raise

    def _judge_time(self, until_s: float, words: str) -> None:
        if self._now() >= until_s:
            raise TimedOutError(words)

    def _look(self) -> Steps[Json]:
        """Raises LatchedError or NotDrivingError where the motion of this program has ended with that."""
        status = yield from self.status()
        if status["latch"]:
            raise LatchedError("Stopped: motion is refused until a person resumes.")
        return status

    def _beat(self) -> Steps[bool]:
        lease = yield Call("POST", "/api/lease", {"action": "heartbeat"}, is_safe=True)
        if lease["driver"] and not lease["drives"]:
            raise NotDrivingError(f"{lease['driver']} drives now, and motion was stopped first.")
        return bool(lease["drives"])

    def _positions(self, positions: Positions, units: Units) -> Steps[dict[str, float]]:
        if units not in KNOWN_UNITS:
            raise OutOfRangeError(f"units is {units}, allowed: {', '.join(KNOWN_UNITS)}")
        if units == "board" and all(isinstance(servo, int) for servo in positions):
            return {str(servo): whole(at) for servo, at in positions.items()}
        servos = yield from self._described()
        try:
            numbers = {servo: servos.number_of(servo) for servo in positions}
        except NotFoundError:
            servos = yield from self._described(is_new=True)
            numbers = {servo: servos.number_of(servo) for servo in positions}
        wanted: dict[str, float] = {}
        for servo, at in positions.items():
            number = numbers[servo]
            if str(number) in wanted:
                raise OutOfRangeError(f"Servo {number} is named twice, the second time as {servo}.")
            wanted[str(number)] = servos.position_at(number, at) if units == "deg" else whole(at)
        return wanted

    def _frames(self, frames: Frames, units: Units) -> Steps[list[Json]]:
        bodies: list[Json] = []
        for seconds, positions in frames:
            wanted = yield from self._positions(positions, units)
            bodies.append({"durationMs": round(seconds * 1000), "positions": wanted})
        return bodies

    def _described(self, *, is_new: bool = False) -> Steps[Servos]:
        """As the robot on the board was a few seconds ago at most: its home may have been changed since."""
        if self._servos and not is_new and self._now() - self._servos[0] < REMEMBERED_S:
            return self._servos[1]
        welcome = yield Welcome()
        robot, known = welcome["robot"], []
        if robot:
            document = yield Call("GET", f"/api/library/{quote(robot['id'])}", is_safe=True)
            known = servos_of(robot_in(document["text"]))
        servos = Servos(known, welcome["board"])
        self._servos = self._now(), servos
        return servos


LATE_WORDS = "It did not end in time, so it was stopped."


def within(step: Call | Pause | Welcome, left_s: float) -> Call | Pause | Welcome:
    """The same, which takes no longer."""
    match step:
        case Call():
            return replace(step, most_s=min(step.most_s, left_s))
        case Pause():
            return Pause(min(step.seconds, left_s))
        case _:
            return step


def whole(at: float) -> float:
    """As the board counts; the gateway refuses what is between two."""
    return int(at) if at == int(at) else at

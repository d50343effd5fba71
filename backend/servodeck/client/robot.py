"""`Robot`: each method returns when its request is done. Carries out the steps of vocabulary.py one by one.

Knows the clock and one thread for heartbeats; no route and no transport.
"""

import threading
import time
from collections.abc import Generator
from contextlib import closing, suppress
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

from servodeck.client.ending import at_exit
from servodeck.client.errors import UnreachableError
from servodeck.client.gateway import FIRST_PAUSE_S, LONGEST_PAUSE_S, Call, Gateway, Pause, Steps
from servodeck.client.opening import TIMEOUT_S, gateway_at
from servodeck.client.values import Event, Json, Servo, Snapshot
from servodeck.client.vocabulary import LEAVE_S, POSE_S, Frames, Outcome, Positions, Units, Vocabulary
from servodeck.errors import BusyError, GatewayError

T = TypeVar("T")


class Robot:
    """A robot at a gateway (`Robot("http://servodeck.local", token="…")`; by default SERVODECK_URL and
    SERVODECK_TOKEN or the gateway on this computer), or on a port of this computer without a gateway
    (`Robot("/dev/ttyUSB0", board="xarm")`; `robot` is a file of the page's export, with names and limits).

    At the end of `with`, also by an exception, what this program has in motion is stopped and its lease
    released. Every method raises a GatewayError with the gateway's `code` and sentence; `timeout` is for each
    request, in seconds. `take`: an owner's, from any other driver.
    """

    def __init__(
        self,
        where: str | None = None,
        *,
        token: str | None = None,
        board: str | None = None,
        robot: str | Path | None = None,
        take: bool = False,
        timeout: float = TIMEOUT_S,
    ) -> None:
        self._gateway = gateway_at(where, token, board, robot, timeout)
        self._vocabulary = Vocabulary(time.monotonic, take=take)
        self._ended = threading.Event()
        self._beating: threading.Thread | None = None
        self._begun = 0
        self._lock = threading.Lock()
        at_exit(self._leave)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(*(() if error is None else (GatewayError,))):
            self.close()

    def close(self) -> None:
        """Stops what this program has in motion, and releases its lease. May be called twice."""
        self._ended.set()
        try:
            carry_out(self._gateway, self._vocabulary.close())
        finally:
            self._gateway.close()

    # Motion

    def move(
        self,
        positions: Positions,
        *,
        units: Units,
        seconds: float = POSE_S,
        wait: bool = True,
        timeout: float | None = None,
    ) -> None:
        """Moves servos together, by name or number: `{"Base": 30}`. `units`: "deg" from home, or "board".
        The first move of a servo takes at least 1.5 s. `wait`: until they have arrived; after `timeout`
        seconds they are stopped. Not waited for, it continues until this program ends.
        """
        self._do(self._vocabulary.move(positions, units, seconds, wait=wait, timeout=timeout))
        if not wait:
            self._beat()

    def pose(
        self, pose: str | int, *, seconds: float = POSE_S, wait: bool = True, timeout: float | None = None
    ) -> None:
        """Moves to a pose of the robot, by name or number; "home" is number 0."""
        self._do(self._vocabulary.pose(pose, seconds, wait=wait, timeout=timeout))
        if not wait:
            self._beat()

    def run(
        self,
        group: str | int,
        *,
        times: int = 1,
        wait: bool = True,
        timeout: float | None = None,
        alone: float | None = None,
        anyway: bool = False,
    ) -> Outcome:
        """Runs a group of the board, by its name or slot; `times` 0: until stopped. Not waited for, it
        continues until this robot is closed, or for `alone` seconds without this program. `anyway`:
        although the battery is at its alarm, because a person wants it.
        """
        outcome = self._do(
            self._vocabulary.run(group, times, wait=wait, timeout=timeout, alone=alone, anyway=anyway)
        )
        if not wait and alone is None:
            self._beat()
        return outcome

    def play(
        self,
        frames: Frames,
        *,
        units: Units,
        times: int = 1,
        loop_from: int = 0,
        wait: bool = True,
        timeout: float | None = None,
        alone: float | None = None,
        anyway: bool = False,
    ) -> None:
        """Plays frames by the gateway's clock: `[(0.5, {"Base": 30}), …]`. Otherwise as `run`; each pass but
        the first begins with frame `loop_from`.
        """
        steps = self._vocabulary.play(
            frames, units, times, loop_from, wait=wait, timeout=timeout, alone=alone, anyway=anyway
        )
        self._do(steps)
        if not wait and alone is None:
            self._beat()

    def download(
        self,
        slot: int,
        frames: Frames,
        *,
        units: Units,
        name: str = "",
        replaces: str | None = None,
        wait: bool = True,
        timeout: float | None = None,
    ) -> Json:
        """Stores a group in a slot of the board; returns the gateway's job. Not waited for, it continues at
        the gateway. `replaces`: only if the slot holds that version.
        """
        steps = self._vocabulary.download(slot, frames, units, name, replaces, wait=wait, timeout=timeout)
        return self._do(steps)

    def erase(self) -> None:
        """Erases every slot of the board, for good. Owners only."""
        self._do(self._vocabulary.erase())

    # The right to drive

    def stop(self) -> Json | None:
        """Stops the robot, also while another client drives, and refuses motion until `resume`. Returns the
        motion that could not be held, `servos` and `forMs`; None: all is held.
        """
        return self._do(self._vocabulary.stop())

    def resume(self) -> None:
        """Allows motion again. Moves nothing. Look at the robot first."""
        self._do(self._vocabulary.resume())

    def request_lease(self) -> bool:
        """Whether this program drives now; otherwise the driver has 5 s to refuse. Motion does it by
        itself.
        """
        return self._do(self._vocabulary.request_lease())

    def release(self) -> None:
        """Stops what this program has in motion, without a latch, and releases its lease."""
        self._do(self._vocabulary.release())

    # Looking

    def snapshot(self) -> Snapshot:
        """The state of gateway, board and motion."""
        return self._do(self._vocabulary.snapshot())

    def status(self) -> Json:
        """As `GET /api/status` has it."""
        return self._do(self._vocabulary.status())

    def battery(self) -> int:
        """In millivolts: queries the board now."""
        return self._do(self._vocabulary.battery())

    def poses(self) -> dict[int, str]:
        """The names of the robot's poses, by number."""
        return self._do(self._vocabulary.poses())

    def servos(self) -> list[Servo]:
        """Those that the robot on the board describes."""
        return self._do(self._vocabulary.servos())

    def events(self, *, seconds: float | None = None) -> Generator[Event, None, None]:
        """Every change as an event, for so long; the first one, `welcome`, has the whole state. A lost
        stream is opened again: then `gap` and `welcome` come.
        """
        self._vocabulary.judge_open()
        until_s = None if seconds is None else time.monotonic() + seconds
        last_id, pause_s, was_open = None, FIRST_PAUSE_S, False
        while (left_s := left(until_s)) > 0:
            try:
                with closing(self._gateway.events(last_id)) as stream:
                    was_open, pause_s = True, FIRST_PAUSE_S
                    while (left_s := left(until_s)) > 0:
                        event = stream.next(left_s)
                        last_id = stream.last_id
                        yield event
            except (UnreachableError, BusyError):
                if not was_open:
                    raise
            if self._ended.wait(min(pause_s, max(0.0, left(until_s)))):
                return
            pause_s = min(2 * pause_s, LONGEST_PAUSE_S)

    # Inside

    def _leave(self) -> None:
        """The program ends without having closed it."""
        self._ended.set()
        carry_out(self._gateway, self._vocabulary.close(LEAVE_S))

    def _do(self, steps: Steps[T]) -> T:
        self._vocabulary.judge_open()
        return carry_out(self._gateway, steps)

    def _beat(self) -> None:
        with self._lock:
            self._begun += 1
            if self._beating is None:
                self._beating = threading.Thread(target=self._beat_until_ended, daemon=True)
                self._beating.start()

    def _beat_until_ended(self) -> None:
        """Again where another motion has begun meanwhile."""
        begun = 0
        while self._is_new(begun):
            begun = self._begun
            self._do_beats()

    def _is_new(self, begun: int) -> bool:
        with self._lock:
            if begun != self._begun and not self._ended.is_set():
                return True
            self._beating = None
            return False

    def _do_beats(self) -> None:
        steps = self._vocabulary.beats()
        answer: Any = None
        with suppress(StopIteration, GatewayError):
            while not self._ended.is_set():
                step = steps.send(answer)
                if isinstance(step, Pause):
                    self._ended.wait(step.seconds)
                    answer = None
                elif isinstance(step, Call):
                    answer = self._gateway.call(step)


def carry_out(gateway: Gateway, steps: Steps[T]) -> T:
    answer: Any = None
    try:
        step = next(steps)
        while True:
            try:
                if isinstance(step, Pause):
                    time.sleep(step.seconds)
                    answer = None
                elif isinstance(step, Call):
                    answer = gateway.call(step)
                else:
                    answer = gateway.welcome()
            except BaseException as error:  # noqa: BLE001 (the steps judge it)
                step = steps.throw(error)
            else:
                step = steps.send(answer)
    except StopIteration as ended:
        result: T = ended.value
        return result


def left(until_s: float | None) -> float:
    return float("inf") if until_s is None else until_s - time.monotonic()

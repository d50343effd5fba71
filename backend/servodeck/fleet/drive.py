"""One person drives one robot of the fleet from a page (docs/adr/0052): takes the lease, passes on the newest
move and the beats of that page, and gives the lease back.

Nothing here beats by itself: a page that is hidden, frozen or gone is a driver that is gone, and its robot's
gateway stops what moves. Knows the console, the driver of the fleet and messages; no socket.
"""

import asyncio
from collections import deque
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from contextlib import suppress
from typing import Any

from servodeck.fleet.console import Console
from servodeck.fleet.drive_messages import (
    AnyDriveNews,
    AnyDriveWish,
    DriveBeat,
    DriveLease,
    DriveLive,
    DriveMove,
    DriveRefused,
    DriveRelease,
    DriveRequest,
    DriveRun,
)
from servodeck.fleet.driving import FleetDriver
from servodeck.fleet.heard import Robot
from servodeck.fleet.messages import Done, MoveRequest, RefusalCode
from servodeck.fleet.outcomes import FleetError, RefusedError
from servodeck.intents import Target
from servodeck.robot.lease import GONE_S

# Between two moves, and between two beats that are passed on, at least: a page answers each report with one.
MOVE_S, BEAT_S = 0.05, 0.2
# Between two looks at what the robot has said.
LOOK_S = 0.05
MOST_REFUSALS = 8
NOT_DRIVING = "This page does not drive the robot."


class DriveSession:
    def __init__(
        self, robot: str, name: str, console: Console, driver: FleetDriver, now: Callable[[], float]
    ) -> None:
        """`name` of the person, for others at this gateway."""
        self.name = name
        self._robot = robot
        self._console = console
        self._driver = driver
        self._now = now
        self._heard_s = now()
        self._beat_s = self._moved_s = self._heard_s - 1
        self._wants_lease, self._has_asked, self._drove, self._leaves = True, False, False, False
        # By this page: a lease that is there may be of somebody who has gone without giving it back.
        self._has_obtained = False
        # Of each servo: when its target came, and with which move.
        self._waiting: dict[int, tuple[float, Target, DriveMove]] = {}
        self._moves = 0
        self._timer: asyncio.TimerHandle | None = None
        self._working: set[asyncio.Task[None]] = set()
        self._has_ended = asyncio.Event()
        self._lease: DriveLease | None = None
        self._live: DriveLive | None = None
        self._unsent: dict[str, AnyDriveNews] = {}
        self._refused: deque[DriveRefused] = deque(maxlen=MOST_REFUSALS)
        self._news = asyncio.Event()

    async def run(self) -> None:
        """Until the page gives the lease back, or is not heard for too long."""
        try:
            while not self._has_ended.is_set() and self._now() - self._heard_s <= GONE_S:
                self._look()
                with suppress(TimeoutError):
                    async with asyncio.timeout(LOOK_S):
                        await self._has_ended.wait()
        finally:
            self._leaves = True
            if self._timer:
                self._timer.cancel()
            if self._waits:
                self._begin(self._driver.give_back(self._robot))
            self._driver.drop(self._robot, self)

    async def next(self) -> AnyDriveNews:
        """For the page: of the lease and of the position only the newest."""
        while not self._refused and not self._unsent:
            self._news.clear()
            await self._news.wait()
        return self._refused.popleft() if self._refused else self._unsent.pop(next(iter(self._unsent)))

    def take(self, wish: AnyDriveWish) -> None:
        """From the page."""
        if self._leaves:
            return
        match wish:
            case DriveBeat(nonce=nonce):
                self._take_beat(nonce)
            case DriveRequest():
                self._wants_lease, self._has_asked = True, False
            case DriveRelease():
                self._leaves = True
                self._begin(self._leave())
            case _ if not self._drives:
                self._refuse(RefusedError(self._robot, "notDriving", NOT_DRIVING))
            case DriveMove():
                self._take_move(wish)
            case DriveRun(slot=slot, nonce=nonce):
                self._follow(self._console.request(self._robot, "run", slot=slot, nonce=nonce))

    @property
    def _drives(self) -> bool:
        is_ours = self._driver.claim(self._robot, self) is None
        return is_ours and self._has_obtained and self._console.drives(self._robot)

    @property
    def _waits(self) -> bool:
        """For the lease, of which its driver may let it pass."""
        return self._has_asked and self._wants_lease and not self._has_obtained

    def _take_beat(self, nonce: str | None) -> None:
        self._heard_s = self._now()
        if nonce is not None and self._drives and self._heard_s - self._beat_s >= BEAT_S:
            self._beat_s = self._heard_s
            self._console.beat_for(self._robot, nonce)

    def _take_move(self, move: DriveMove) -> None:
        now = self._now()
        self._waiting |= {target.servo: (now, target, move) for target in move.targets}
        if self._timer is None:
            wait_s = max(0.0, self._moved_s + MOVE_S - now)
            self._timer = asyncio.get_running_loop().call_later(wait_s, self._send_move)

    def _send_move(self) -> None:
        """The newest target of each servo, unless that is too old, too; with the nonce that it came with,
        which shows its age.
        """
        now = self._now()
        waiting, self._waiting, self._timer = self._waiting, {}, None
        by_nonce: dict[str, tuple[list[Target], DriveMove]] = {}
        for at_s, target, move in waiting.values():
            if now - at_s <= MoveRequest.WITHIN_S:
                targets, _ = by_nonce.get(move.nonce, ([], move))
                by_nonce[move.nonce] = [*targets, target], move
        if not self._drives or self._leaves:
            return
        self._moves += 1
        for nonce, (targets, move) in by_nonce.items():
            self._moved_s = now
            fields = {"targets": targets, "duration_ms": move.duration_ms, "nonce": nonce}
            self._follow(self._console.request(self._robot, "move", **fields), self._moves)

    def _follow(self, answered: "Future[Done]", number: int | None = None) -> None:
        """Says why it was refused, unless it is a move behind which a newer one came."""

        async def answer() -> None:
            try:
                await self._driver.answer(self._robot, answered)
            except FleetError as error:
                if number in (None, self._moves):
                    self._refuse(error)

        self._begin(answer())

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        self._working.add(task)
        task.add_done_callback(self._working.discard)

    def _refuse(self, error: FleetError) -> None:
        code: RefusalCode | None = error.code if isinstance(error, RefusedError) else None
        detail = error.detail if isinstance(error, RefusedError) else str(error)
        self._refused.append(DriveRefused(code=code, detail=detail))
        self._news.set()

    def _look(self) -> None:
        """At what the robot has said, and at whose it is."""
        robot = self._console.robot(self._robot)
        other = self._driver.claim(self._robot, self)
        drives = self._drives
        if self._drove and not drives:
            # It has passed to somebody else: a person asks for it again.
            self._wants_lease = self._has_obtained = False
        elif other is None and self._wants_lease and not self._has_asked and not drives:
            self._has_asked = True
            self._begin(self._ask())
        self._drove = drives
        said = robot.state.driver if robot and robot.state else None
        lease = DriveLease(
            lease="driving" if drives else "requested" if self._wants_lease else "none",
            driver=self.name if drives else other or said,
        )
        if lease != self._lease:
            self._lease = lease
            self._say("lease", lease)
        live = live_of(robot, drives=drives) if robot else None
        if live and live != self._live:
            self._live = live
            self._say("live", live)

    def _say(self, kind: str, news: AnyDriveNews) -> None:
        self._unsent[kind] = news
        self._news.set()

    async def _leave(self) -> None:
        """Others get the robot once it is free."""
        has_asked = self._drives or self._waits
        self._wants_lease = False
        if has_asked:
            await self._driver.give_back(self._robot)
        self._has_ended.set()

    async def _ask(self) -> None:
        try:
            if self._console.drives(self._robot):  # for who has gone: their motion ends
                await self._driver.give_back(self._robot)
            await self._driver.obtain(self._robot)
            self._has_obtained = True
        except FleetError as error:
            self._wants_lease = False
            self._refuse(error)


def live_of(robot: Robot, *, drives: bool) -> DriveLive | None:
    """Of a lease that has passed there may be a report that nothing replaces."""
    state, live = robot.state, robot.live
    if drives and live and (state is None or live.epoch >= state.epoch):
        return DriveLive(nonce=live.nonce, latch=live.latch, motion=live.motion)
    return DriveLive(nonce=state.nonce, latch=state.latch, motion=None) if state else None

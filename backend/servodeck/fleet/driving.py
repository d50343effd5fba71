"""Drives several robots for the people at a fleet's page: takes the lease of each robot that is asked to do
something, beats while a person watches, and gives the lease back when it is over.

Knows a console; no HTTP. Nothing here decides whether a robot may move: its gateway does.
"""

import asyncio
import threading
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from functools import partial
from typing import Any, Protocol

from servodeck.fleet.console import Console
from servodeck.fleet.heard import Robot
from servodeck.fleet.messages import Done
from servodeck.fleet.outcomes import FleetError, NoAnswerError, RefusedError, StopReport
from servodeck.fleet.stopping import stop_robots
from servodeck.fleet.together import new_name, spread_ms, start_together
from servodeck.intents import GroupBody
from servodeck.snapshots import JobState
from servodeck.threads import in_thread

BEAT_S = 0.25
LOOK_S = 0.5
ANSWER_S = 2.0
# The driver of a robot may refuse for five seconds.
LEASE_S = 7.0
# Between a report that a group runs or a download is in progress, and the request before it.
BEGUN_S = 3.0

# Who has a robot that a task of this page moves.
TASK = "A task of this page"

Share = Callable[[float | None], None]
"""Is told how much of the work is done, 0 to 1."""


class Claimant(Protocol):
    @property
    def name(self) -> str: ...


class FleetDriver:
    def __init__(self, console: Console, is_watched: Callable[[], bool]) -> None:
        """`is_watched`: a person looks at the page. Without one, groups are stopped after two seconds."""
        self._console = console
        self._is_watched = is_watched
        # At the latest beat; for threads.
        self._was_watched = True
        self._beating: asyncio.Task[None] | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._news = asyncio.Event()
        # Robots that tasks move now, and those that people drive: neither takes one from the other.
        self._tasks: Counter[str] = Counter()
        self._claims: dict[str, Claimant] = {}
        # The name of the start together that each robot has yet to finish.
        self._starts: dict[str, str] = {}
        # How often each robot was stopped here, and all of them.
        self._stops: Counter[str] = Counter()
        self._stops_of_all = 0

    def start(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._beating = asyncio.create_task(self._beat())

    def heard(self) -> None:
        """The console has heard something; from any thread."""
        if self._loop and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._tell)

    def _tell(self) -> None:
        self._news.set()
        self._news = asyncio.Event()

    async def end(self) -> None:
        if self._beating:
            self._beating.cancel()
            with suppress(asyncio.CancelledError):
                await self._beating

    async def stop(self, robots: Sequence[str] | None) -> StopReport:
        """None: of all. What waits to ask them for something does not do so any more."""
        if robots is None:
            self._stops_of_all += 1
        else:
            self._stops.update(robot for robot in robots if self._console.robot(robot))
        return await in_thread(lambda: stop_robots(self._console, robots))

    async def run(self, robot: str, slot: int, times: int) -> None:
        """Until it has ended. Raises a FleetError."""
        await self._lease(robot)
        try:
            await self._ask(robot, "run", slot=slot, times=times)
            await self._over(robot)
        finally:
            await self._release(robot)

    async def start_together(self, slots: Mapping[str, int], times: int) -> Callable[[], float | None]:
        """All at the same time, or none. Raises a FleetError that names whom it failed at; `finish` follows
        for each where it has started. Answers with what knows how many ms apart they have begun.
        """
        name, has_ended = new_name(), threading.Event()
        stops = {robot: self._stops_of(robot) for robot in slots}
        leased: list[str] = []

        def judge_wanted() -> None:
            for robot, before in stops.items():
                judge_not_stopped(robot, before, self._stops_of(robot))
            if not self._was_watched or has_ended.is_set():
                raise FleetError("It was given up before it started.")

        def start() -> float:
            return start_together(
                self._console,
                list(slots),
                slots,
                times,
                name=name,
                judge_wanted=judge_wanted,
            )

        try:
            for robot in slots:
                await self._lease(robot)
                leased.append(robot)
            await in_thread(start)
        except BaseException:
            has_ended.set()  # its thread goes on
            await self._release(*leased)
            raise
        self._starts |= dict.fromkeys(slots, name)
        return lambda: spread_ms(self._console, list(slots), name)

    async def finish(self, robot: str) -> None:
        """Until what was started has ended. Raises a FleetError, also where it did not start."""
        try:
            await self._over(robot, self._starts.pop(robot, None))
        finally:
            await self._release(robot)

    async def download(
        self,
        robot: str,
        messages: Sequence[Sequence[GroupBody]],
        progress: Callable[[int, JobState], None],
    ) -> None:
        """Until the groups of all these messages are stored; `progress` gets the place of a message and each
        state of its job. Raises a FleetError.
        """
        await self._lease(robot)
        try:
            for place, groups in enumerate(messages):
                # In a thread: to write a large one takes milliseconds, in which a stop would wait.
                sent = await in_thread(partial(self._console.request, robot, "download", groups=groups))
                job = (await self.answer(robot, sent)).job
                assert job is not None  # the answer to a download has one
                await self._stored(robot, job.id, partial(progress, place))
        finally:
            await self._release(robot)

    def claim(self, robot: str, claimant: "Claimant") -> str | None:
        """From now on, or still, it is this page that drives the robot: else the name of the one who does."""
        if self._tasks[robot] > 0:
            return TASK
        holder = self._claims.setdefault(robot, claimant)
        return None if holder is claimant else holder.name

    def drop(self, robot: str, claimant: "Claimant") -> None:
        """Its claim ends; its lease does when its robot's gateway hears no beat any more."""
        if self._claims.get(robot) is claimant:
            del self._claims[robot]

    async def obtain(self, robot: str) -> None:
        """The lease. Raises a FleetError where another driver keeps it."""
        if (await self._ask(robot, "ask", action="request")).drives:
            return
        if not await self._until(robot, lambda heard: self._console.drives(heard.name), LEASE_S):
            heard = self._console.robot(robot)
            driver = heard.state.driver if heard and heard.state else None
            raise RefusedError(robot, "notDriving", f"{driver or 'Another client'} drives it.")
        await self._ask(robot, "report")  # whose answer has a nonce that is new enough

    async def give_back(self, robot: str) -> None:
        """The lease, if it is there."""
        with suppress(FleetError):
            await self._ask(robot, "ask", action="release")

    async def resume(self, robot: str) -> None:
        """Robots that come later are not stopped any more, either. Raises a FleetError."""
        stops = self._stops_here(robot)
        self._console.withdraw_holds()
        await self._ask(robot, "report")  # whose answer has a nonce that is new enough
        judge_not_stopped(robot, stops, self._stops_here(robot))
        await self._ask(robot, "resume")

    def _stops_here(self, robot: str) -> int:
        return self._stops_of_all + self._stops[robot]

    def _stops_of(self, robot: str) -> int:
        """Here, at its own page or anywhere else."""
        heard = self._console.robot(robot)
        return self._stops_here(robot) + (heard.stops if heard else 0)

    async def _lease(self, robot: str) -> None:
        """For a task. Raises a FleetError where another driver keeps it."""
        claimant = self._claims.get(robot)
        if claimant:
            raise RefusedError(robot, "notDriving", f"{claimant.name} drives it.")
        stops = self._stops_of(robot)
        self._tasks[robot] += 1
        try:
            await self.obtain(robot)
            judge_not_stopped(robot, stops, self._stops_of(robot))
        except BaseException:
            await self._release(robot)  # a request that waits is withdrawn
            raise

    async def _release(self, *robots: str) -> None:
        """After `_lease` of each. All are asked before an answer is awaited, in which it may be cancelled."""
        self._tasks.subtract(robots)
        free = [robot for robot in robots if self._tasks[robot] == 0]
        for robot in free:
            del self._tasks[robot]
        sent = [(robot, self._console.request(robot, "ask", action="release")) for robot in free]
        await asyncio.gather(*(self.answer(*each) for each in sent), return_exceptions=True)

    async def _stored(self, robot: str, job_id: str, progress: Callable[[JobState], None]) -> None:
        while True:
            heard = self._present(robot)
            job = heard.state.job if heard.state else None
            if job is not None and job.id == job_id:
                progress(job)
                if job.status == "done":
                    return
                if job.status != "running":
                    raise RefusedError(robot, job.code or "cancelled", job.detail or "It was cancelled.")
            await self._next()

    async def _over(self, robot: str, start: str | None = None) -> None:
        """`start`: the name of the one that it has promised to take part in."""
        has_begun = await self._until(robot, is_running, BEGUN_S)
        while is_running(heard := self._present(robot)):
            if heard.state and heard.state.link.status == "lost":
                raise RefusedError(robot, "lost", "The link to the robot was lost: what it does is unknown.")
            await self._next()
        state = self._present(robot).state
        if state and state.latch:
            raise RefusedError(robot, "latched", f"It was stopped by {state.stopped_by or 'its gateway'}.")
        was_short = state is not None and state.started is not None and state.started.name == start
        if start and not has_begun and not was_short:
            raise RefusedError(robot, "cancelled", "It did not start.")

    async def _until(self, robot: str, is_so: Callable[[Robot], bool], within_s: float) -> bool:
        with suppress(TimeoutError):
            async with asyncio.timeout(within_s):
                while not is_so(self._present(robot)):
                    await self._next()
                return True
        return False

    async def _next(self) -> None:
        """Until something was heard, or for a moment: silence is no news."""
        with suppress(TimeoutError):
            async with asyncio.timeout(LOOK_S):
                await self._news.wait()

    def _present(self, robot: str) -> Robot:
        heard = self._console.robot(robot)
        if heard is None or heard.presence == "silent":
            raise NoAnswerError(f"{robot} does not answer any more: what it does is unknown.")
        return heard

    async def _ask(self, robot: str, verb: Any, **fields: Any) -> Done:
        return await self.answer(robot, self._console.request(robot, verb, **fields))

    async def answer(self, robot: str, answered: "Future[Done]") -> Done:
        """To a request to that robot. Raises a FleetError, also where none comes in time."""
        try:
            async with asyncio.timeout(ANSWER_S):
                return await asyncio.wrap_future(answered)
        except TimeoutError:
            raise NoAnswerError(f"{robot} did not answer in {ANSWER_S:g} s.") from None

    async def _beat(self) -> None:
        while True:
            self._was_watched = self._is_watched()
            if self._was_watched:
                self._console.beat([robot for robot, count in self._tasks.items() if count])
            await asyncio.sleep(BEAT_S)


def is_running(heard: Robot) -> bool:
    return heard.state is not None and heard.state.running is not None


def judge_not_stopped(robot: str, stops_before: int, stops: int) -> None:
    """Raises RefusedError where it was stopped in between."""
    if stops != stops_before:
        raise RefusedError(robot, "cancelled", "It was stopped.")

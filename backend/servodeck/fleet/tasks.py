"""What a person asks of several robots at once: each robot gets its request at the same time, and has an
outcome of its own. The failed ones can be asked again.

Knows tasks and their view; not what is asked, no HTTP.
"""

import asyncio
import itertools
import logging
from collections.abc import Awaitable, Callable, Sequence
from typing import Literal

from servodeck.errors import ConflictError, NotFoundError
from servodeck.fleet.driving import Share
from servodeck.fleet.outcomes import FleetError, RefusedError
from servodeck.fleet.view import FleetView
from servodeck.fleet.view_messages import FleetTask, FleetTaskPart, PartStatus
from servodeck.value import value

MOST_TASKS = 20
Spread = Callable[[], float | None]
"""How many ms apart robots have started together, as far as they have said."""
STOPPED = "It was stopped."
MISTAKE = "The gateway made a mistake; its log says more."
log = logging.getLogger("servodeck.fleet")


@value
class Order:
    """`carry_out` asks one robot, after `begin`, if there is one, has asked all of them. Both raise a
    FleetError where that fails.
    """

    verb: Literal["run", "download", "resume"]
    names: Sequence[str]
    by: str
    carry_out: Callable[[str, Share], Awaitable[None]]
    begin: Callable[[Sequence[str]], Awaitable[Spread]] | None = None


class Tasks:
    def __init__(self, view: FleetView) -> None:
        self._view = view
        self._orders: dict[str, Order] = {}
        self._tasks: dict[str, FleetTask] = {}
        self._running: dict[str, asyncio.Task[None]] = {}
        self._numbers = itertools.count(1)

    def begin(self, order: Order, robots: Sequence[str]) -> FleetTask:
        """Returns at once; the view shows what becomes of it."""
        task_id = str(next(self._numbers))
        parts = [FleetTaskPart(robot=robot, status="waiting") for robot in dict.fromkeys(robots)]
        self._orders[task_id] = order
        self._set(FleetTask(id=task_id, verb=order.verb, names=[*order.names], by=order.by, parts=parts))
        self._forget_old()
        self._start(task_id, [part.robot for part in parts])
        return self._tasks[task_id]

    def retry(self, task_id: str) -> FleetTask:
        """Asks those again that failed. Raises NotFoundError and ConflictError."""
        task = self._tasks.get(task_id)
        if task is None:
            raise NotFoundError("There is no such task any more.")
        if task_id in self._running:
            raise ConflictError("This task is still in progress.")
        failed = [part.robot for part in task.parts if part.status == "failed"]
        for robot in failed:
            self._part(task_id, robot, "waiting")
        self._start(task_id, failed)
        return self._tasks[task_id]

    def cancel_all(self) -> None:
        """A STOP of all robots ends what still waits; what a board was told is stopped by the STOP itself."""
        for running in self._running.values():
            running.cancel()

    def _start(self, task_id: str, robots: Sequence[str]) -> None:
        work = asyncio.create_task(self._work(task_id, robots))
        self._running[task_id] = work
        work.add_done_callback(lambda _: self._ended(task_id))

    def _ended(self, task_id: str) -> None:
        """What was cancelled before its first step has not failed by itself."""
        self._running.pop(task_id, None)
        task = self._tasks.get(task_id)
        for part in task.parts if task else ():
            if part.status in ("waiting", "busy"):
                self._part(task_id, part.robot, "failed", detail=STOPPED)

    async def _work(self, task_id: str, robots: Sequence[str]) -> None:
        begin, spread = self._orders[task_id].begin, no_spread
        if begin:
            try:
                spread = await begin(robots)
            except (FleetError, asyncio.CancelledError) as error:
                # Of one that may be another than this: the sentence names it.
                detail = STOPPED if isinstance(error, asyncio.CancelledError) else str(error)
                for robot in robots:
                    self._part(task_id, robot, "failed", detail=detail)
                return
        parts = [asyncio.create_task(self._one(task_id, robot)) for robot in robots]
        try:
            await asyncio.sleep(0)  # one that is cancelled before its first step would give nothing back
            await asyncio.gather(*parts)
        except asyncio.CancelledError:
            for part in parts:
                part.cancel()
            await asyncio.gather(*parts, return_exceptions=True)
            raise
        self._set(self._tasks[task_id].model_copy(update={"spread_ms": spread()}))

    async def _one(self, task_id: str, robot: str) -> None:
        self._part(task_id, robot, "busy")
        try:
            await self._orders[task_id].carry_out(
                robot, lambda share: self._part(task_id, robot, "busy", share)
            )
        except FleetError as error:
            self._part(task_id, robot, "failed", detail=reason_of(error))
        except asyncio.CancelledError:
            self._part(task_id, robot, "failed", detail=STOPPED)
            raise
        except Exception:  # a defect of ours: a STOP has to end the others nevertheless
            log.exception("a task has failed")
            self._part(task_id, robot, "failed", detail=MISTAKE)
        else:
            self._part(task_id, robot, "done")

    def _part(
        self,
        task_id: str,
        robot: str,
        status: PartStatus,
        share: float | None = None,
        detail: str | None = None,
    ) -> None:
        task = self._tasks.get(task_id)
        if task is None:
            return
        part = FleetTaskPart(robot=robot, status=status, share=share, detail=detail)
        parts = [part if one.robot == robot else one for one in task.parts]
        self._set(task.model_copy(update={"parts": parts}))

    def _set(self, task: FleetTask) -> None:
        self._tasks[task.id] = task
        self._view.put_task(task)

    def _forget_old(self) -> None:
        for old in list(self._tasks)[:-MOST_TASKS]:
            if old not in self._running:
                del self._tasks[old], self._orders[old]
                self._view.forget_task(old)


def reason_of(error: FleetError) -> str:
    """Without the robot's name, beside which it stands."""
    return error.detail if isinstance(error, RefusedError) else str(error)


def no_spread() -> float | None:
    return None

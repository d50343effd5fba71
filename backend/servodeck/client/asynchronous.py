"""`AsyncRobot`: the methods of Robot for asyncio. Requests wait in threads, pauses on the event loop.

Knows tasks and threads; no route and no transport.
"""

import asyncio
import time
from collections.abc import AsyncGenerator
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

from servodeck.client.ending import at_exit
from servodeck.client.errors import UnreachableError
from servodeck.client.gateway import (
    FIRST_PAUSE_S,
    LONGEST_PAUSE_S,
    Call,
    EventStream,
    Gateway,
    Pause,
    Steps,
    Welcome,
)
from servodeck.client.opening import TIMEOUT_S, gateway_at
from servodeck.client.robot import carry_out, left
from servodeck.client.values import Event, Json, Servo, Snapshot
from servodeck.client.vocabulary import LEAVE_S, POSE_S, Frames, Outcome, Positions, Units, Vocabulary
from servodeck.errors import BusyError, GatewayError
from servodeck.threads import in_thread

T = TypeVar("T")


class AsyncRobot:
    """As Robot, with the same methods: `async with AsyncRobot(…) as robot: await robot.move(…)`. A method
    that is cancelled stops the motion that it waits for.
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
        self._open = lambda: gateway_at(where, token, board, robot, timeout)
        self._vocabulary = Vocabulary(time.monotonic, take=take)
        self._beating: asyncio.Task[None] | None = None
        self._begun = 0
        self._opening: asyncio.Task[Gateway] | None = None
        at_exit(self._leave)

    async def __aenter__(self) -> Self:
        try:
            await self._opened()
        except BaseException:
            await self.close()
            raise
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(*(() if error is None else (GatewayError,))):
            await self.close()

    async def close(self) -> None:
        """Stops what this program has in motion, and releases its lease. May be called twice."""
        if self._beating:
            self._beating.cancel()
            await asyncio.wait([self._beating])
        try:
            await self._carry_out(self._vocabulary.close())
        finally:
            if self._opening:
                await self._close(self._opening)

    async def _close(self, opening: asyncio.Task[Gateway]) -> None:
        await asyncio.wait([opening])
        if opening.exception() is None:
            await in_thread(opening.result().close)

    # Motion

    async def move(
        self,
        positions: Positions,
        *,
        units: Units,
        seconds: float = POSE_S,
        wait: bool = True,
        timeout: float | None = None,  # noqa: ASYNC109 (as Robot has it)
    ) -> None:
        await self._do(self._vocabulary.move(positions, units, seconds, wait=wait, timeout=timeout))
        if not wait:
            self._beat()

    async def pose(
        self,
        pose: str | int,
        *,
        seconds: float = POSE_S,
        wait: bool = True,
        timeout: float | None = None,  # noqa: ASYNC109
    ) -> None:
        await self._do(self._vocabulary.pose(pose, seconds, wait=wait, timeout=timeout))
        if not wait:
            self._beat()

    async def run(
        self,
        group: str | int,
        *,
        times: int = 1,
        wait: bool = True,
        timeout: float | None = None,  # noqa: ASYNC109
        alone: float | None = None,
        anyway: bool = False,
    ) -> Outcome:
        steps = self._vocabulary.run(group, times, wait=wait, timeout=timeout, alone=alone, anyway=anyway)
        outcome = await self._do(steps)
        if not wait and alone is None:
            self._beat()
        return outcome

    async def play(
        self,
        frames: Frames,
        *,
        units: Units,
        times: int = 1,
        loop_from: int = 0,
        wait: bool = True,
        timeout: float | None = None,  # noqa: ASYNC109
        alone: float | None = None,
        anyway: bool = False,
    ) -> None:
        steps = self._vocabulary.play(
            frames, units, times, loop_from, wait=wait, timeout=timeout, alone=alone, anyway=anyway
        )
        await self._do(steps)
        if not wait and alone is None:
            self._beat()

    async def download(
        self,
        slot: int,
        frames: Frames,
        *,
        units: Units,
        name: str = "",
        replaces: str | None = None,
        wait: bool = True,
        timeout: float | None = None,  # noqa: ASYNC109
    ) -> Json:
        steps = self._vocabulary.download(slot, frames, units, name, replaces, wait=wait, timeout=timeout)
        return await self._do(steps)

    async def erase(self) -> None:
        await self._do(self._vocabulary.erase())

    # The right to drive

    async def stop(self) -> Json | None:
        return await self._do(self._vocabulary.stop())

    async def resume(self) -> None:
        await self._do(self._vocabulary.resume())

    async def request_lease(self) -> bool:
        return await self._do(self._vocabulary.request_lease())

    async def release(self) -> None:
        await self._do(self._vocabulary.release())

    # Looking

    async def snapshot(self) -> Snapshot:
        return await self._do(self._vocabulary.snapshot())

    async def status(self) -> Json:
        return await self._do(self._vocabulary.status())

    async def battery(self) -> int:
        return await self._do(self._vocabulary.battery())

    async def poses(self) -> dict[int, str]:
        return await self._do(self._vocabulary.poses())

    async def servos(self) -> list[Servo]:
        return await self._do(self._vocabulary.servos())

    async def events(self, *, seconds: float | None = None) -> AsyncGenerator[Event, None]:
        self._vocabulary.judge_open()
        until_s = None if seconds is None else time.monotonic() + seconds
        last_id, pause_s, was_open = None, FIRST_PAUSE_S, False
        while left(until_s) > 0:
            stream: EventStream | None = None
            try:
                gateway = await self._opened()
                stream = await in_thread(lambda: gateway.events(last_id), EventStream.close)  # noqa: B023
                was_open, pause_s = True, FIRST_PAUSE_S
                while (left_s := left(until_s)) > 0:
                    event = await in_thread(lambda: stream.next(left_s))  # noqa: B023
                    last_id = stream.last_id
                    yield event
            except (UnreachableError, BusyError):
                if not was_open:
                    raise
            finally:
                if stream:
                    stream.close()
            await asyncio.sleep(min(pause_s, max(0.0, left(until_s))))
            pause_s = min(2 * pause_s, LONGEST_PAUSE_S)

    # Inside

    async def _opened(self) -> Gateway:
        if self._opening is None:
            self._opening = asyncio.create_task(self._open_in_thread())
        return await asyncio.shield(self._opening)

    async def _open_in_thread(self) -> Gateway:
        gateway = await in_thread(self._open)
        gateway.mind_signals()
        return gateway

    def _leave(self) -> None:
        """The program ends without having closed it."""
        opening = self._opening
        if opening and opening.done() and not opening.cancelled() and opening.exception() is None:
            carry_out(opening.result(), self._vocabulary.close(LEAVE_S))

    async def _do(self, steps: Steps[T]) -> T:
        self._vocabulary.judge_open()
        return await self._carry_out(steps)

    async def _carry_out(self, steps: Steps[T]) -> T:
        answer: Any = None
        try:
            step = next(steps)
            while True:
                try:
                    if isinstance(step, Pause):
                        await asyncio.sleep(step.seconds)
                        answer = None
                    else:
                        answer = await self._answer_to(step)
                except BaseException as error:  # noqa: BLE001 (the steps judge it)
                    step = steps.throw(error)
                else:
                    step = steps.send(answer)
        except StopIteration as ended:
            result: T = ended.value
            return result

    async def _answer_to(self, step: Call | Welcome) -> Any:
        gateway = await self._opened()
        answer = asyncio.create_task(
            in_thread(lambda: gateway.call(step) if isinstance(step, Call) else gateway.welcome())
        )
        try:
            return await asyncio.shield(answer)
        except asyncio.CancelledError:
            await asyncio.wait([answer])  # what it begins can be stopped only after it has begun
            answer.exception()  # seen
            raise

    def _beat(self) -> None:
        self._begun += 1
        if self._beating is None or self._beating.done():
            self._beating = asyncio.create_task(self._beat_until_ended())

    async def _beat_until_ended(self) -> None:
        """Again where another motion has begun meanwhile."""
        begun = 0
        while begun != self._begun:
            begun = self._begun
            with suppress(GatewayError):
                await self._do(self._vocabulary.beats())

"""Reads the board: its battery, the positions of its servos, its firmware, its trims. Callers that ask while
a question is under way share its answer. Twin of shared/src/robot/readings.ts.

The battery is read when a board becomes ready, soon after something has ended, and every few seconds while
nothing moves: on some boards any packet disturbs what runs, and under load the voltage sags anyway. A board
that stayed silent is queried again only on request. Knows the questions and how long each may take; no
client, and not how a packet leaves.
"""

import asyncio
import contextlib
import logging
import math
from collections.abc import Callable, Sequence
from typing import Literal, Protocol

from servodeck.errors import CancelledError, GatewayError, LatchedError, NoAnswerError
from servodeck.port.link import Link
from servodeck.port.wire import Left
from servodeck.protocol.families import Family, Question
from servodeck.protocol.packets import portions_of
from servodeck.protocol.timings import BATTERY, IDENTIFY, READ, wire_s
from servodeck.protocol.values import (
    AllPositions,
    Battery,
    Command,
    Offsets,
    Positions,
    ReadAllPositions,
    ReadBattery,
    ReadOffsets,
    ReadPositions,
    ReadVersion,
    Report,
    Version,
)
from servodeck.robot.board.identification import Identification
from servodeck.robot.board.identity import QUESTIONS
from servodeck.robot.board.replies import Replies
from servodeck.snapshots import BatteryRead, BatterySilent, BatteryState, BatteryUnread
from servodeck.value import value

Reading = Literal["positions", "version", "offsets"]
log = logging.getLogger("servodeck.robot")
Key = tuple[Reading, tuple[int, ...]]


class ReadableBoard(Protocol):
    @property
    def link(self) -> Link: ...

    @property
    def identification(self) -> Identification: ...

    @property
    def family(self) -> Family: ...

    def put_question(self, question: Command) -> Left:
        """Puts it on the wire. Raises the reason if it cannot leave."""


class Readings:
    def __init__(
        self,
        board: ReadableBoard,
        replies: Replies,
        battery: "BatteryReader",
        now: Callable[[], float],
    ) -> None:
        self._board = board
        self._replies = replies
        self._battery = battery
        self._now = now
        self._under_way: dict[Key, asyncio.Task[None]] = {}

    async def read(self, what: Reading, servos: Sequence[int] = ()) -> None:
        """Returns when the board has answered; the report goes to every client. A second caller that requests
        the same meanwhile shares the answer. Raises NoAnswerError, and whatever prevents the question.
        """
        key = (what, tuple(servos))
        if key not in self._under_way:
            self._under_way[key] = asyncio.create_task(self._read(*key))
            self._under_way[key].add_done_callback(lambda reading: self._ended(key, reading))
        await asyncio.shield(self._under_way[key])

    async def answer_to(self, question: Question) -> Report | None:
        """Sends the query once, to learn which board it is or whether it is still there. None where no answer
        came; raises the reason if it cannot be sent.
        """
        if question == "readBattery" and self._board.identification.state.status != "identifying":
            try:
                return Battery(await self._battery.read())  # shared with others that read at the same time
            except NoAnswerError:
                return None
        packet, answer = QUESTIONS[question].packet, QUESTIONS[question].answer
        async with self._replies.asking:
            # No board answers what has not reached it yet.
            earliest_s = self._now() + wire_s(len(packet.data))
            try:
                left = self._board.link.wire().send(packet, self._board)
                timeout_s = IDENTIFY.timeout_ms / 1000
                return await self._replies.to(left, timeout_s, answer, not_before_s=earliest_s)
            except (LatchedError, CancelledError):
                return None  # a stop empties the queue; it does not answer the question

    async def _read(self, what: Reading, servos: tuple[int, ...]) -> None:
        detail_s = READ.detail_timeout_ms / 1000
        family = self._board.family
        if what == "version":
            await self._ask(ReadVersion(), Version, detail_s)
        elif what == "offsets":
            await self._ask(ReadOffsets(), Offsets, detail_s)
        elif "readAllPositions" in family.commands:
            await self._ask(ReadAllPositions(), AllPositions, detail_s)
        else:
            for portion in portions_of(servos, family.servos_per_move):
                await self._ask(ReadPositions(tuple(portion)), Positions, positions_s(len(portion)))

    async def _ask(self, question: Command, answer: type[Report], wait_s: float) -> None:
        if await self._replies.ask(lambda: self._board.put_question(question), wait_s, answer) is None:
            raise NoAnswerError("The board did not answer in time.")

    def _ended(self, key: Key, reading: asyncio.Task[None]) -> None:
        del self._under_way[key]
        if not reading.cancelled():
            reading.exception()  # callers have it; they may all be gone


def positions_s(servo_count: int) -> float:
    """The board reads its servos one by one, then the answer needs its time on the wire."""
    answer_ms = wire_s(5 + 3 * servo_count) * 1000
    return (math.ceil(READ.position_ms * servo_count + answer_ms) + READ.margin_ms) / 1000


BATTERY_WAIT_S = BATTERY.timeout_ms / 1000


@value
class BatteryReading:
    battery_mv: int
    at_s: float


class PoweredBoard(ReadableBoard, Protocol):
    def may_ask(self) -> bool:
        """A client is connected, and nothing moves: time for questions."""

    def is_idle(self) -> bool:
        """Nothing moves."""

    def battery_changed(self) -> None: ...


class BatteryReader:
    def __init__(
        self, board: PoweredBoard, replies: Replies, now: Callable[[], float], *, polls: bool
    ) -> None:
        """`polls`: the battery is read by itself while the board is ready."""
        self.newest: BatteryReading | None = None
        self.rested: BatteryReading | None = None
        """The newest one while nothing moved: under load the voltage sags."""
        self.is_silent = False
        """So many questions in a row stayed unanswered that the board is taken to report no voltage."""
        self._board = board
        self._replies = replies
        self._now = now
        self._silences = 0
        self._unsolicited = UnsolicitedAnswers()
        self._polls = polls
        self._timer: asyncio.TimerHandle | None = None
        self._poll: asyncio.Task[None] | None = None
        self._question: asyncio.Task[int] | None = None

    def port_opened(self) -> None:
        self._unsolicited = UnsolicitedAnswers()

    def query_left(self, at_s: float) -> None:
        """The last bit of the question leaves then."""
        self._unsolicited.query_left(at_s)

    def heard(self, report: Report) -> None:
        if isinstance(report, Battery):
            self.newest = BatteryReading(report.battery_mv, self._now())
            if self._board.is_idle():
                self.rested = self.newest
            self._silences, self.is_silent = 0, False
            self._board.battery_changed()
            if self._unsolicited.answered(self._now()):
                facts = {"device": self._board.link.place}
                log.warning("the board answers another program, too; close it", extra={"facts": facts})

    def forget(self) -> None:
        """The board has changed."""
        was_known = self.newest or self.is_silent
        self.newest, self.rested, self._silences, self.is_silent = None, None, 0, False
        if was_known:
            self._board.battery_changed()

    def snapshot(self) -> BatteryState:
        newest = self.newest
        if self.is_silent:
            return BatterySilent(last_mv=newest.battery_mv if newest else None)
        if newest is None:
            return BatteryUnread()
        return BatteryRead(battery_mv=newest.battery_mv, age_ms=round((self._now() - newest.at_s) * 1000))

    async def read(self) -> int:
        """In mV. A caller that reads while a query is under way shares its answer."""
        if self._question is None:
            self._question = asyncio.create_task(self._read())
            self._question.add_done_callback(self._read_done)
        return await asyncio.shield(self._question)

    async def _read(self) -> int:
        report = await self._replies.ask(
            lambda: self._board.put_question(ReadBattery()), BATTERY_WAIT_S, Battery
        )
        if not isinstance(report, Battery):
            self._count_silence()
            raise NoAnswerError("The board did not report its battery voltage. Not every board can.")
        return report.battery_mv

    def _count_silence(self) -> None:
        # Where every such board answers, silence says that the board is gone, not that it cannot report it.
        if "readBattery" in self._board.family.certain_answers:
            return
        self._silences += 1
        if self._silences >= BATTERY.silent_limit and not self.is_silent:
            self.is_silent = True
            self._board.battery_changed()

    def _read_done(self, question: asyncio.Task[int]) -> None:
        self._question = None
        if not question.cancelled():
            question.exception()  # callers have it; none may be left to take it

    def board_ready(self, *, is_ready: bool) -> None:
        """It is ready now, or not any more."""
        if is_ready and self._polls:
            self._tick()
        else:
            self._stop_timer()

    def client_joined(self) -> None:
        """Reads the battery now if the last reading is old."""
        newest = self.newest
        if self._timer and (newest is None or self._now() - newest.at_s > BATTERY.every_ms / 1000):
            self._tick()

    def motion_ended(self) -> None:
        """A move, a run or a download."""
        if self._timer:
            self._poll_in(BATTERY.after_run_ms)

    @property
    def may_answer(self) -> bool:
        """Such boards report it, and this one has not stayed silent."""
        return "readBattery" in self._board.family.answers and not self.is_silent

    def _poll_in(self, ms: float) -> None:
        self._stop_timer()
        self._timer = asyncio.get_running_loop().call_later(ms / 1000, self._tick)

    def _stop_timer(self) -> None:
        if self._timer:
            self._timer.cancel()
        self._timer = None

    def _tick(self) -> None:
        self._poll_in(BATTERY.every_ms)
        if self.may_answer and self._board.may_ask():
            self._poll = asyncio.create_task(self._poll_once())

    async def _poll_once(self) -> None:
        with contextlib.suppress(GatewayError):  # a silence is counted where the query is sent
            await self.read()


class UnsolicitedAnswers:
    """Notices battery answers that no query from here requested, for one opening of the port: then another
    program uses the same board, which neither a HID cable nor Bluetooth forbids. Twin of
    frontend/src/robot/traffic.ts.
    """

    def __init__(self) -> None:
        self._queried_s = -math.inf
        self._count = 0

    def query_left(self, at_s: float) -> None:
        self._queried_s = at_s

    def answered(self, at_s: float) -> bool:
        """True once, when it is sure enough."""
        if at_s - self._queried_s <= BATTERY.unsolicited_after_ms / 1000:
            return False
        self._count += 1
        return self._count == BATTERY.unsolicited_limit

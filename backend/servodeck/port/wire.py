"""The only code that touches the open port: puts packets on the wire one at a time, stops first.

Knows bytes, time and order. Must not know the meaning of a packet, nor who may send it: requests.py judges
that. The operating system never has more than one packet, so a stop waits for at most one.
"""

import asyncio
import contextlib
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from servodeck import metrics
from servodeck.errors import BusyError, ClosedError, GatewayError, OutOfRangeError
from servodeck.port.ports import OpenPort
from servodeck.port.reader import start_reading
from servodeck.protocol.families import Withheld
from servodeck.protocol.packets import HARMLESS, CommandPacket
from servodeck.protocol.timings import STOP, wire_s
from servodeck.protocol.values import Stop

STOP_PACKET = CommandPacket(Stop(), bytes.fromhex("55550207"))


def stop_packets(byte_count: int) -> CommandPacket:
    """Whole stop packets back to back, as many as fit."""
    return CommandPacket(Stop(), STOP_PACKET.data * (byte_count // len(STOP_PACKET.data)))


QUEUE_PER_OWNER = 8
CLOCK_GRAIN_S = 1e-6

Owner = object
# The next packet of the hold that those packets began, None where all is held.
Hold = Callable[[Sequence[CommandPacket]], CommandPacket | None]


def no_hold(_held: Sequence[CommandPacket]) -> None:
    """Nothing is held."""


def always() -> None:
    """No condition: it may leave."""


Left = asyncio.Future[None]


@dataclass(eq=False, slots=True)
class Job:
    """A packet in the queue; `left` resolves when its last bit has left the wire. `make` returns it when the
    wire is free, None where it is not needed any more; it raises what prevents it from leaving.
    """

    number: int
    make: Callable[[], CommandPacket | None]
    owner: Owner
    left: Left
    requested_at: float


@dataclass(eq=False, slots=True)
class Halt:
    """A stop sequence under way: what is still to be sent of it, and from when on the next stop may go.

    `hold` follows the first stop at once, because a stop never ends the move in progress (S50), and the last
    one, because the first stop may have been lost (S52): each time that of the moment. It is several packets
    where the port carries none that is long enough; `held` are those that left. `question` leaves behind the
    second stop: where it is answered before the last one, the board hears that one.
    """

    hold: Hold
    left: Left
    question: Callable[[], CommandPacket | None]
    stops_to_go: int = 1 + STOP.repeats
    held: list[CommandPacket] = field(default_factory=list)
    hold_now: bool = False
    ask_now: bool = False
    due: float = field(default=float("-inf"))


class Wire:
    """One open port from its first packet to its loss. `run` is its life."""

    def __init__(
        self,
        port: OpenPort,
        *,
        gap_s: float,
        now: Callable[[], float],
        received: Callable[[bytes], None],
        leaving: Callable[[Owner, CommandPacket, float], None] = lambda _owner, _packet, _at_s: None,
        first: CommandPacket | None = None,
    ) -> None:
        """`leaving` is called with the owner of a packet that begins to leave, and the time of its end.
        `first` leaves before all others.
        """
        self.unfinished: CommandPacket | None = first
        """The packet that may not have left completely."""
        self.asked: int | None = None
        """The command number of the question behind the latest stop sequence."""
        self.is_heard = False
        """The board has answered it."""
        self.is_confirmed = False
        """And did so before the last stop of the sequence."""
        self._port = port
        self._gap_s = max(gap_s, STOP.gap_ms / 1000)
        self._now = now
        self._received = received
        self._leaving = leaving
        # What the last owner of the port sent is unknown: it may be on the wire still.
        self._left_at = now()
        self._free_at = self._left_at + self._gap_s
        self._freed = asyncio.Event()
        self._last_number: int | None = None
        self._halt: Halt | None = None
        self._urgent: deque[Job] = deque()
        self._queue: deque[Job] = deque()
        self._under_way: Job | None = None
        self._work = asyncio.Event()
        self._ended: GatewayError | None = None

    def send(
        self,
        packet: CommandPacket,
        owner: Owner,
        *,
        urgent: bool = False,
        judge: Callable[[], None] = always,
    ) -> Left:
        """Queues a packet, an urgent one before all others. Raises BusyError when this owner has too many
        waiting. `judge` is called when the wire is free, and raises what prevents it from leaving.
        """
        if len(packet.data) > self._port.longest_packet:
            raise OutOfRangeError(
                f"The packet has {len(packet.data)} bytes, this port carries {self._port.longest_packet}."
            )
        queue = self._urgent if urgent else self._queue
        if sum(other.owner is owner for other in queue) >= QUEUE_PER_OWNER:
            raise BusyError(
                f"{QUEUE_PER_OWNER} packets are waiting already. Send the next one when one has left."
            )

        def make() -> CommandPacket:
            judge()
            return packet

        return self._queue_up(queue, packet.number, make, owner)

    def send_made(
        self,
        number: int,
        make: Callable[[], CommandPacket | None],
        owner: Owner,
        *,
        urgent: bool = False,
    ) -> Left:
        """Queues a packet of that command number that is made when the wire is free."""
        return self._queue_up(self._urgent if urgent else self._queue, number, make, owner)

    def _queue_up(
        self, queue: deque[Job], number: int, make: Callable[[], CommandPacket | None], owner: Owner
    ) -> Left:
        if self._ended:
            raise self._ended
        job = Job(number, make, owner, asyncio.get_running_loop().create_future(), self._now())
        queue.append(job)
        self._work.set()
        return job.left

    def halt(
        self,
        hold: Hold,
        reason: GatewayError,
        question: Callable[[], CommandPacket | None] = lambda: None,
    ) -> Left:
        """Drops all that waits and sends the stop sequence with what `hold` gives. Pressed again, it joins
        the one under way. `question`: such a board answers it where it hears.
        """
        if self._ended:
            raise self._ended
        self.purge(lambda _job: True, reason)
        if self._halt is None:
            self._halt = Halt(hold, asyncio.get_running_loop().create_future(), question)
            self.forget_answers()
            metrics.totals.stops += 1
        else:
            self._halt.hold = hold
            if (
                self._halt.stops_to_go == 0
            ):  # each press is followed by a stop, but presses never put off the hold
                self._halt.stops_to_go, self._halt.due = 1, self._now()
        self._work.set()
        return self._halt.left

    @property
    def longest_packet(self) -> int:
        """In bytes."""
        return self._port.longest_packet

    @property
    def in_reports(self) -> bool:
        """Each packet leaves in a frame of its own."""
        return self._port.in_reports

    @property
    def withheld(self) -> frozenset[Withheld]:
        return self._port.withheld

    @property
    def halting(self) -> Left | None:
        """The stop sequence under way."""
        return self._halt.left if self._halt else None

    @property
    def is_halting(self) -> bool:
        return self._halt is not None

    def answered(self, number: int) -> None:
        """The board has answered a packet of that command number: if it left last, the gap is over."""
        if number == self.asked:
            self.is_heard = True
        if number == self._last_number:
            self._free_at = min(self._free_at, max(self._left_at, self._now()))
            self._freed.set()

    def purge(self, unwanted: Callable[[Job], bool], reason: GatewayError) -> None:
        """Takes packets that have not begun to leave out of the queue; each fails with `reason`."""
        for job in [job for job in self._queue if unwanted(job)]:
            self._queue.remove(job)
            fail(job.left, reason)

    def has_waiting(self, number: int) -> bool:
        return any(job.number == number for job in (*self._urgent, *self._queue))

    @property
    def has_motion_waiting(self) -> bool:
        """A packet waits that may move the robot."""
        waiting = (job.number for job in (*self._urgent, *self._queue))
        return any(number not in HARMLESS for number in waiting)

    def forget_answers(self) -> None:
        """Of the stop sequence before: what leaves now is not answered yet."""
        self.asked, self.is_heard, self.is_confirmed = None, False, False

    def is_clear_of(self, unwanted: Callable[[int], bool]) -> bool:
        """No packet of such a command number waits, and no stop sequence is under way."""
        return not self._halt and not any(unwanted(job.number) for job in (*self._urgent, *self._queue))

    async def run(self) -> None:
        """Sends and reads until the port is lost (raises PortLostError) or this task is cancelled."""
        lost: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        stop_reading = start_reading(self._port, self._received, lambda error: fail(lost, error))
        sender = asyncio.create_task(self._send_all())
        try:
            await asyncio.wait({sender, lost}, return_when=asyncio.FIRST_COMPLETED)
            (lost if lost.done() else sender).result()
        except GatewayError as error:
            self._end(error)
            raise
        finally:
            stop_reading()
            lost.cancel()
            sender.cancel()
            self._end(ClosedError("The port was closed."))

    async def _send_all(self) -> None:
        if self.unfinished:
            await self._until_free()
            await self._put(self.unfinished, None)
        while True:
            await self._work.wait()
            await self._until_free()  # choose only then: a stop may have come meanwhile
            if self._halt:
                await self._send_of(self._halt)
            elif self._urgent or self._queue:
                await self._send_job((self._urgent or self._queue).popleft())
            else:
                self._work.clear()

    async def _send_of(self, halt: Halt) -> None:
        """Sends the next packet of a stop sequence; nothing else may leave between them."""
        if halt.hold_now:
            halt.hold_now = False
            if hold := halt.hold(halt.held):
                await self._put(hold, None)
                halt.held.append(hold)
                halt.hold_now = halt.hold(halt.held) is not None
        elif halt.ask_now:
            halt.ask_now = False
            if question := halt.question():
                await self._put(question, None)
                self.asked = question.number
        elif halt.stops_to_go:
            await self._until(halt.due)
            self.is_confirmed = self.is_heard and halt.stops_to_go == 1
            is_edge = halt.stops_to_go in (1 + STOP.repeats, 1)
            halt.stops_to_go -= 1
            halt.due = self._now() + STOP.repeat_every_ms / 1000
            await self._put(STOP_PACKET, None)
            halt.held = []
            halt.hold_now = is_edge and halt.hold(halt.held) is not None
            halt.ask_now = halt.stops_to_go == 1
        if halt.stops_to_go == 0 and not halt.hold_now:
            self._halt = None
            settle(halt.left)

    async def _send_job(self, job: Job) -> None:
        try:
            packet = job.make()
        except GatewayError as error:
            fail(job.left, error)
            return
        if packet is None:
            settle(job.left)
            return
        self._under_way = job
        waited_s = self._now() - job.requested_at
        await self._put(packet, job.owner)
        metrics.queue_wait.note(waited_s)
        self._under_way = None
        settle(job.left)

    async def _put(self, packet: CommandPacket, owner: Owner) -> None:
        self.unfinished = packet
        handed_over = self._port.write(packet.data)
        self._last_number = packet.number
        metrics.sent[metrics.name_of(self._last_number)] += 1
        self._left_at = self._now() + max(wire_s(len(packet.data)), self._port.shortest_s)
        self._free_at = self._left_at + self._gap_s
        self._leaving(owner, packet, self._left_at)
        if handed_over:
            await handed_over
            self._left_at = max(self._left_at, self._now())
            self._free_at = self._left_at + self._gap_s
        await self._until(self._left_at)
        self.unfinished = None

    async def _until_free(self) -> None:
        while (left_s := self._free_at - self._now()) > CLOCK_GRAIN_S:
            self._freed.clear()
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(left_s):
                    await self._freed.wait()

    async def _until(self, when: float) -> None:
        # In a loop: event loops round to milliseconds, uvloop down, and a gap must not shrink.
        while (left_s := when - self._now()) > CLOCK_GRAIN_S:  # noqa: ASYNC110 (nothing announces a time)
            await asyncio.sleep(left_s)

    def _end(self, error: GatewayError) -> None:
        if self._ended:
            return
        self._ended = error
        jobs = [*([self._under_way] if self._under_way else []), *self._urgent, *self._queue]
        waiting = [job.left for job in jobs] + ([self._halt.left] if self._halt else [])
        for left in waiting:
            fail(left, error)


def settle(future: Left) -> None:
    if not future.done():
        future.set_result(None)


def fail(future: asyncio.Future[Any], error: GatewayError) -> None:
    """Fails it; a future without a waiting caller causes no warning."""
    if not future.done():
        future.set_exception(error)
        future.exception()

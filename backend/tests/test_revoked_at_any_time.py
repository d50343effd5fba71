"""Several callers ask for anything through every door, and are revoked, demoted or dropped at any instant.

The oracle is what the port was given: each request moves for a time, moves or plays to a place, or runs or
fills a slot, that no other one has, so that a packet says whose it is.
"""

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from httpx2 import Response
from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.api.intake import Intake, merged
from servodeck.api.websocket import take
from servodeck.callers import THIS_COMPUTER, Caller, Rate
from servodeck.intents import (
    AnyClientMessage,
    ContinueMessage,
    FrameBody,
    LeaseMessage,
    MoveMessage,
    PacketMessage,
    PlayMessage,
    StopMessage,
    StopPlayingMessage,
    Target,
)
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode, parse_command
from servodeck.protocol.timings import MOVE, wire_s
from servodeck.protocol.values import Command, Download, Move, Run
from tests.amount import TIMES
from tests.client import Client
from tests.downloading import STORED
from tests.fake_port import FakePort
from tests.samples import DOWNLOAD, STOP
from tests.scripted import Scripted, script
from tests.virtual_time import at, in_virtual_time, now

NAMES = ("Anna", "Bert", "Cleo")
FRAMES, FRAME_COUNT = [{"durationMs": 500, "positions": {"1": 1500}}], 10
STORED_AFTER_S = 0.02
PLACES_FROM = 1100
What = Literal[
    "script moves",
    "script runs",
    "script plays",
    "script downloads",
    "script acts",
    "page moves",
    "page runs",
    "page plays",
    "page ends a group",
    "page ends a play",
    "page stops",
    "a client resumes",
    "page drops",
    "is revoked",
    "is demoted",
]
MOTIONS: list[What] = ["script moves", "script runs", "script plays", "page moves", "page runs", "page plays"]
OFTEN: list[What] = [*MOTIONS, "script downloads"]
OVER_HTTP: list[What] = ["script moves", "script runs", "script plays", "script downloads", "script acts"]
ENDS: list[What] = ["page ends a group", "page ends a play", "page stops"]
ON_PAGES: list[What] = ["page moves", "page runs", "page plays", *ENDS]
LOSSES: list[What] = ["page drops", "is revoked", "is demoted"]


@dataclass(frozen=True)
class Step:
    """`after_ms`: since the step before."""

    after_ms: int
    what: What
    who: str


class StoringPort(FakePort):
    """Says of each frame of a download that it is stored."""

    def write(self, data: bytes) -> None:
        super().write(data)
        if data[COMMAND_AT] == DOWNLOAD[COMMAND_AT]:
            at(now() + wire_s(len(data)) + STORED_AFTER_S, lambda: self.say(STORED))


class Page(Client):
    """Of which few messages are taken at once, so that one may wait when it is sent away."""

    def __init__(self, here: Scripted, caller: Caller) -> None:
        super().__init__(here.control, caller)
        rate = Rate(20, 2, here.control.now)
        self._intake = Intake(rate, self._take, merged, lambda _: None, lambda: None)

    def say(self, message: AnyClientMessage) -> None:
        if isinstance(message, StopMessage):
            self._intake.take_at_once(message)
        else:
            self._intake.offer(message)

    def say_packet(self, packet: bytes) -> None:
        self._claim()
        self.say(PacketMessage(type="packet", id=1, bytes=packet.hex(), nonce=self.nonce))

    def say_move(self, duration_ms: int, positions: Mapping[int, int]) -> None:
        self._claim()
        targets = [Target(servo=servo, position=position) for servo, position in positions.items()]
        move = MoveMessage(type="move", id=1, targets=targets, duration_ms=duration_ms, nonce=self.nonce)
        self.say(move)

    def say_play(self, frames: list[FrameBody]) -> None:
        self._claim()
        nonce = self.nonce or "none"
        self.say(PlayMessage(type="play", id=2, frames=frames, times=0, loop_from=0, nonce=nonce))

    def _claim(self) -> None:
        if self.control.driving.driver is None:
            self.say(LeaseMessage(type="lease", action="request"))

    def _take(self, message: AnyClientMessage) -> None:
        take(message, self, self.control)


@dataclass
class Party:
    """A device of a driver: its requests over HTTP, and its page."""

    name: str
    caller: Caller
    headers: dict[str, str]
    page: Page
    asked: "list[asyncio.Task[Response]]" = field(default_factory=list)
    is_out: bool = False


class History:
    def __init__(self, here: Scripted) -> None:
        self.here = here
        self.parties = {name: self._admit(name) for name in NAMES}
        self._senders: dict[tuple[str, int], str] = {}
        # How much the port had been given when that sender was gone.
        self._gone_after: dict[str, int] = {}
        self._losses: list[asyncio.Task[None]] = []

    def _admit(self, name: str) -> Party:
        device, token = self.here.entrance.devices.admit("device", name, "driver")
        return Party(
            name, device.caller, {"authorization": f"Bearer {token}"}, Page(self.here, device.caller)
        )

    def do(self, step: Step, number: int) -> None:
        """`number` is no other step's."""
        if step.what in OVER_HTTP:
            self._ask(self.parties[step.who], step.what, number)
        elif step.what in ON_PAGES:
            self._say(self.parties[step.who], step.what, number)
        elif step.what == "a client resumes":
            self.here.control.resume(THIS_COMPUTER)
        else:
            self._lose(self.parties[step.who], step.what)

    def _ask(self, party: Party, what: What, number: int) -> None:
        sender = f"{party.name} by HTTP"
        if what == "script moves":
            time_ms = self._mark("move", MOVE.first_ms + number, sender)
            positions = {str(servo): 1000 for servo in range(1, 2 + number % 4)}
            self._post(party, "move", {"timeMs": time_ms, "positions": positions})
        elif what == "script runs":
            alone = {"continueForMs": 5000} if number % 2 else {}
            self._post(party, f"slots/{self._mark('run', number, sender)}/run", {"times": 1, **alone})
        elif what == "script plays":
            position = self._mark("position", PLACES_FROM + number, sender)
            alone = {"continueForMs": 5000} if number % 2 else {}
            frames = [{"durationMs": MOVE.first_ms, "positions": {"1": position}}] * 2
            self._post(party, "play", {"frames": frames, "times": 0, **alone})
        elif what == "script downloads":
            slot = self._mark("download", number, sender)
            self._post(party, "download", {"groups": [{"slot": slot, "frames": FRAMES * FRAME_COUNT}]})
        else:
            self._post(party, "lease", {"action": ("request", "release", "heartbeat")[number % 3]})

    def _say(self, party: Party, what: What, number: int) -> None:
        page, sender = party.page, f"{party.name} on a page"
        if what == "page moves":
            position = self._mark("position", PLACES_FROM + number, sender)
            page.say_move(MOVE.first_ms * (number % 2), dict.fromkeys(range(1, 2 + number % 4), position))
        elif what == "page runs":
            page.say_packet(encode(Run(self._mark("run", number, sender), 1), FAMILIES["doc"]))
            page.say(ContinueMessage(type="continue", for_ms=5000))
        elif what == "page plays":
            position = self._mark("position", PLACES_FROM + number, sender)
            page.say_play([FrameBody(duration_ms=MOVE.first_ms, positions={"1": position})] * 2)
        elif what == "page ends a play":
            page.say(StopPlayingMessage(type="stopPlaying"))
        elif what == "page ends a group":
            page.say_packet(STOP)
        else:
            page.say(StopMessage(type="stop"))

    def _lose(self, party: Party, what: What) -> None:
        if what == "page drops":
            self.here.control.leave(party.page)
            self._gone(f"{party.name} on a page")
        elif not party.is_out:
            party.is_out = True
            self._losses.append(asyncio.create_task(self._send_away(party, what)))

    def _mark(self, kind: str, number: int, sender: str) -> int:
        self._senders[kind, number] = sender
        return number

    def _post(self, party: Party, path: str, body: Mapping[str, object]) -> None:
        asking = self.here.client.post(f"/api/{path}", json=body, headers=party.headers)
        party.asked.append(asyncio.create_task(asking))

    def _gone(self, sender: str) -> None:
        self._gone_after.setdefault(sender, len(self.here.port.written))

    async def _send_away(self, party: Party, what: What) -> None:
        path, control = f"/api/people/{party.caller.id}", self.here.control
        if what == "is revoked":
            answer = await self.here.client.delete(path, headers=self.here.owner)
        else:
            answer = await self.here.client.patch(path, json={"role": "viewer"}, headers=self.here.owner)
        assert answer.status_code in (200, 204), answer.text
        self._gone(f"{party.name} by HTTP")
        self._gone(f"{party.name} on a page")
        driver = control.driving.driver
        assert driver is None or driver.caller.id != party.caller.id

    async def end(self) -> None:
        await asyncio.gather(*self._losses)
        for party in self.parties.values():
            for answer in await asyncio.gather(*party.asked):
                assert answer.status_code in (200, 202, 401, 403, 409, 422, 429), answer.text
        await asyncio.sleep(8)
        for index, packet in enumerate(self.here.port.packets()):
            sender = self._sender_of(parse_command(packet))
            behind = self._gone_after.get(sender or "")
            assert behind is None or index < behind, f"{sender} was gone, and {packet.hex()} left"

    def _sender_of(self, command: Command | None) -> str | None:
        match command:
            case Move(duration_ms, targets) if duration_ms >= MOVE.first_ms:  # no hold takes so long
                of_page = self._senders.get(("position", targets[0].position))
                return of_page or self._senders.get(("move", duration_ms))
            case Run(slot, _):
                return self._senders.get(("run", slot))
            case Download(slot=slot):
                return self._senders.get(("download", slot))
        return None


@in_virtual_time
async def play(steps: list[Step]) -> None:
    async with script(behind=StoringPort()) as here:
        history = History(here)
        for number, step in enumerate(steps):
            await asyncio.sleep(step.after_ms / 1000)
            history.do(step, number)
        await history.end()


PAUSES_MS = st.one_of(st.integers(0, 20), st.integers(20, 160), st.sampled_from([300, 800, 2100]))
ASKED = st.sampled_from([*OFTEN * 2, *OVER_HTTP, *ON_PAGES])
LOST = st.sampled_from([*LOSSES, "is revoked"])


@st.composite
def episodes(draw: st.DrawFn) -> list[Step]:
    """A client sends a few requests and may be lost; others come between, and a client may resume."""
    who = draw(st.sampled_from(NAMES))
    asked = [Step(draw(PAUSES_MS), what, who) for what in draw(st.lists(ASKED, min_size=1, max_size=3))]
    between = [
        Step(draw(PAUSES_MS), what, draw(st.sampled_from(NAMES)))
        for what in draw(st.lists(ASKED, max_size=1))
    ]
    lost = [Step(draw(PAUSES_MS), what, who) for what in draw(st.lists(LOST, max_size=1))]
    resumed = [Step(draw(PAUSES_MS), "a client resumes", who)] if draw(st.booleans()) else []
    return asked + between + lost + resumed


@settings(max_examples=40 * TIMES)
@given(history=st.lists(episodes(), min_size=1, max_size=4))
def test_no_packet_of_a_revoked_client_begins_to_leave_after_the_answer(history: list[list[Step]]) -> None:
    play([step for episode in history for step in episode])

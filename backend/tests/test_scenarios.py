"""Every file of shared/protocol/scenarios, played at the gateway in virtual time: its inputs come at their
times, and the packets that leave, the messages and the outcome of each intent must be as written. The page's
session plays the same (shared/src/robot/scenarios.test.ts) and writes the files; README.md there says what an
event is.
"""

import asyncio
import json
from functools import partial
from math import inf
from typing import Any

import pytest

from servodeck.errors import GatewayError, NoAnswerError, PortMissingError
from servodeck.port.ports import OpenPort
from servodeck.port.whereabouts import UsbDevice
from servodeck.protocol.packets import encode
from servodeck.protocol.timings import STOP as STOP_TIMES
from servodeck.protocol.timings import wire_s
from servodeck.protocol.values import Frame, ReadPositions, ServoTarget
from servodeck.robot.board.download import Group, made_of, packets_of
from servodeck.robot.board.playing import FrameGroup
from servodeck.robot.control import Control
from servodeck.robot.operations import PageClaim
from servodeck.robot.scripts import Scripts
from servodeck.snapshots import PlayState
from tests.client import ANNA, Client
from tests.fake_port import STOPS_AT_OPENING, FakePort, is_row
from tests.running import DEVICE
from tests.samples import BATTERY, STOP
from tests.vectors import load_scenarios
from tests.virtual_time import at, in_virtual_time, now

Event = dict[str, Any]
SCENARIOS = load_scenarios()
# So long the stops of the opening have left before the first input, as at the page's session.
OPEN_FOR_S = 0.1
# Behind the last event: what should not come any more would be seen.
QUIET_S = 5.0
BEFORE_HEARTBEAT_S = 1.5
REMINDED_S = STOP_TIMES.again_every_ms / 1000


class Listener(Client):
    """The driver; records its messages with their times."""

    def __init__(self, control: Control) -> None:
        self.sent: list[tuple[float, Event]] = []
        self.something_sent = asyncio.Event()
        super().__init__(control, ANNA)

    def put(self, text: str) -> None:
        self.sent.append((now(), json.loads(text)))
        self.something_sent.set()
        super().put(text)


class PulledPorts:
    """One device, a new port each time that it is opened."""

    def __init__(self) -> None:
        self.opened: list[FakePort] = []
        self.is_there = True

    async def open(self, _device: str) -> FakePort:
        if not self.is_there:
            raise PortMissingError("The device is not plugged in.")
        self.opened.append(FakePort())
        self.opened[-1].is_return = len(self.opened) > 1
        return self.opened[-1]

    async def close(self, port: OpenPort) -> None:
        port.close()

    async def list_usb(self) -> list[UsbDevice]:
        return []

    async def find_rate(self, device: str) -> None:
        """Nothing that can be read arrives there."""

    def plug(self, state: str) -> None:
        self.is_there = state == "back"
        if not self.is_there:
            self.opened[-1].unplug()


class Player:
    """Takes the inputs of a scenario, and knows what came of them, in milliseconds since it began."""

    def __init__(self, control: Control, ports: PulledPorts) -> None:
        self.ends: list[tuple[float, int, str]] = []
        self.begun_s = now()
        self._control = control
        self._ports = ports
        self._scripts = Scripts(control, lambda _caller: True)
        self._session = Listener(control)
        self._tasks: list[asyncio.Task[None]] = []

    def take(self, event: Event) -> None:
        match event:
            case {"says": packet}:
                self._ports.opened[-1].say(bytes.fromhex(packet))
            case {"port": state}:
                self._ports.plug(state)
            case {"intent": intent}:
                self._tasks.append(asyncio.create_task(self._ask(intent, event.get("id"))))

    async def watch(self) -> None:
        """A client is connected while the scenario is played: a group ends with the client that began it."""
        while True:
            await asyncio.sleep(1)
            if self._control.driving.driver not in (None, self._session):
                self._scripts.act(ANNA, "heartbeat")

    def leaves(self, *, opening: bool) -> list[tuple[float, str, int]]:
        """Each with the number of times that it leaves back to back; behind the first `opening`, if it is not
        part of the scenario. What is said again each second while motion is latched is left out.
        """
        written = [port.everything() for port in self._ports.opened]
        if not opening:
            written[0] = written[0][1 + STOPS_AT_OPENING :]
        packets: list[tuple[float, str, int]] = []
        left_s, was_reminder = -inf, False
        for at_s, data in [one for port in written for one in port]:
            times = len(data) // len(STOP) if is_row(data) else 1
            is_reminder = data == STOP and abs(at_s - left_s - REMINDED_S) < 0.001
            is_asked = was_reminder and data == BATTERY
            left_s, was_reminder = at_s + wire_s(len(data)), is_reminder
            if not (is_reminder or is_asked):
                packets.append((self._ms(at_s), data[: len(data) // times].hex(" ").upper(), times))
        return packets

    def tells(self) -> list[tuple[float, str, Any]]:
        """Each field when it has changed."""
        known: dict[str, Any] = {}
        changes = []
        for at_s, message in self._session.sent:
            fields = fields_of(message)
            new = {field: value for field, value in fields.items() if known.get(field, ...) != value}
            known |= new
            if message["type"] != "welcome":
                changes += [(self._ms(at_s), field, value) for field, value in new.items()]
        return changes

    async def _ask(self, intent: Event, number: int | None) -> None:
        try:
            how = await self._outcome(intent)
        except GatewayError as error:
            how = str(error.code)
        if number is not None:
            self.ends.append((self._ms(now()), number, how))

    async def _outcome(self, intent: Event) -> str:
        control = self._control
        match intent:
            case {"type": "move", "targets": targets, "durationMs": duration_ms}:
                self._move(targets_of(targets), duration_ms)
            case {"type": "run", "slot": slot, "times": times}:
                await self._run(slot, times)
            case {"type": "stop"}:
                await control.stop()
            case {"type": "resume"}:
                control.resume(ANNA, self._session)
            case {"type": "stopGroup"}:
                await control.operations.end_group(self._session)
            case {"type": "readBattery" | "readPositions"}:
                await self._read(intent)
            case {"type": "board", "family": family}:
                control.name_board(ANNA, family)
            case {"type": "download", "groups": groups}:
                return await self._download([Group(one["slot"], "", frames_of(one)) for one in groups])
            case {"type": "cancelDownload"}:
                self._cancel_download()
            case _:
                await self._play_or_stop(intent)
        return "done"

    def _move(self, targets: list[ServoTarget], duration_ms: int) -> None:
        if self._control.driving.driver is None:
            self._control.driving.act(self._session, "request")
        self._control.requests.move(self._session, targets, duration_ms, self._session.nonce)

    async def _run(self, slot: int, times: int) -> None:
        ran = await self._scripts.run(ANNA, slot, times, take=False)
        if ran.outcome == "silent":
            raise NoAnswerError("The board did not say that it runs the group.")

    async def _read(self, intent: Event) -> None:
        if intent["type"] == "readBattery":
            await self._control.board.battery.read()
            return
        question = encode(ReadPositions(tuple(intent["servos"])), self._control.board.family)
        await self._control.requests.send(self._session, question.hex())

    def _cancel_download(self) -> None:
        job = self._control.board.jobs.latest
        assert job
        self._control.board.jobs.cancel(job.id)

    async def _download(self, groups: list[Group]) -> str:
        jobs, family = self._control.board.jobs, self._control.board.family_id
        parts = [made_of(group, list(packets_of(group, family)), family) for group in groups]
        job = self._control.requests.download(parts, ANNA, lambda: None)
        while (state := jobs.find(job.id)).status == "running":
            self._session.something_sent.clear()
            await self._session.something_sent.wait()
        return str(state.code or state.status)

    async def _play_or_stop(self, intent: Event) -> None:
        """A play has ended however it did."""
        if intent["type"] == "stopPlaying":
            self._control.requests.stop_playing()
            return
        assert intent["type"] == "play", f"the gateway is not asked for {intent} here"
        if self._control.driving.driver is None:
            self._control.driving.act(self._session, "request")
        group = FrameGroup(frames_of(intent), intent["times"], intent["loopFrom"])
        ended: asyncio.Future[PlayState] = asyncio.get_running_loop().create_future()
        claim = PageClaim(self._control, self._session, self._session.nonce)
        await self._control.operations.play(claim, group, ended.set_result)
        await ended

    def _ms(self, at_s: float) -> float:
        return (at_s - self.begun_s) * 1000


def fields_of(message: Event) -> dict[str, Any]:
    match message["type"]:
        case "welcome" | "state":
            names = ("brokenSlots", "waitingToStart")
            status, code = message["link"]["status"], message["link"]["code"]
            link = f"refused: {code}" if status == "refused" else status
            begun = {"playedFrame": None} if message["type"] == "welcome" else {}
            same = {name: message[name] for name in names}
            return {"link": link, "latched": message["latch"], **same, **begun}
        case "play":
            is_on = message["play"]["status"] == "playing"
            return {"playedFrame": message["play"]["frameIndex"] if is_on else None}
        case "halted":
            return {"unheld": message["unheld"]}
    return {}


def targets_of(targets: list[Event]) -> list[ServoTarget]:
    return [ServoTarget(one["servo"], one["position"]) for one in targets]


def frames_of(group: Event) -> list[Frame]:
    return [Frame(one["durationMs"], tuple(targets_of(one["targets"]))) for one in group["frames"]]


def is_like(events: list[tuple[Any, ...]], expected: list[tuple[Any, ...]]) -> None:
    """Each with its time first, which may be a hundredth of a millisecond off."""
    assert [event for _, *event in events] == [event for _, *event in expected]
    assert [at_ms for at_ms, *_ in events] == pytest.approx([at_ms for at_ms, *_ in expected], abs=0.01)


@pytest.mark.parametrize("scenario", SCENARIOS, ids=[f"{one['part']}: {one['name']}" for one in SCENARIOS])
@in_virtual_time
async def test_what_comes_of_it_is_what_is_written(scenario: Event) -> None:
    ports, events = PulledPorts(), scenario["events"]
    identifies = scenario.get("identifies", False)
    control = Control(ports, now, scenario["family"], identifies_board=identifies)
    opening = asyncio.create_task(control.use_port(DEVICE))
    if not identifies:
        await opening
        await asyncio.sleep(OPEN_FOR_S)
    for _ in range(10):  # until the port is open
        await asyncio.sleep(0)
    player = Player(control, ports)
    for event in events:
        at(player.begun_s + event["atMs"] / 1000, partial(player.take, event))
    watching = asyncio.create_task(player.watch())
    await asyncio.sleep(events[-1]["atMs"] / 1000 + (BEFORE_HEARTBEAT_S if identifies else QUIET_S))
    watching.cancel()
    leaves = [(one["atMs"], one["leaves"], one.get("times", 1)) for one in events if "leaves" in one]
    is_like(player.leaves(opening=identifies), leaves)
    is_like(player.ends, [(one["atMs"], one["ends"], one["with"]) for one in events if "ends" in one])
    changes = [(one["atMs"], *change) for one in events if "tells" in one for change in one["tells"].items()]
    tells = player.tells()
    for field in {field for _, field, _ in (*changes, *tells)}:
        is_like([one for one in tells if one[1] == field], [one for one in changes if one[1] == field])
    await control.board.link.close()

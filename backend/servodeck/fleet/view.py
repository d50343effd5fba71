"""A fleet as a page shows it: each robot in a few values, what was asked of them, what happened, and the
groups into which people sort them. Counts a revision up with each change, so that a page asks only for what
is new.

Knows what a console has heard; no broker, no HTTP.
"""

import asyncio
import logging
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from servodeck.errors import OutOfRangeError
from servodeck.files import BackgroundFile
from servodeck.fleet.console import Console
from servodeck.fleet.heard import Presence, Robot
from servodeck.fleet.messages import About, State
from servodeck.fleet.view_messages import (
    FleetBroker,
    FleetChanges,
    FleetCues,
    FleetEvent,
    FleetEventKind,
    FleetGroups,
    FleetRobot,
    FleetRunning,
    FleetSlot,
    FleetState,
    FleetTask,
)
from servodeck.schema import Message
from servodeck.snapshots import BatteryState, StoredGroup
from servodeck.value import value

T = TypeVar("T")
M = TypeVar("M", bound=Message)
GROUPS_FILE = "fleet-groups.json"
CUES_FILE = "fleet-cues.json"
KEPT_EVENTS = 200
# How often a page hears of changes at most: a viewer may ask twice a second.
EACH_S = 0.6
# Nobody tells that the page behind a request that waits is gone: a page has to ask again soon.
LONGEST_WAIT_S = 1.2
# It asks again at once; a request that was lost takes a second.
PRESENT_S = 2.5
AGE_STEP_MS = 10_000
log = logging.getLogger("servodeck.fleet")


@value
class Basis:
    """What a robot is shown by. To make it takes as long as to look at a hundred that are as before."""

    about: About | None
    state: State | None
    presence: Presence
    seen_ms_ago: int | None
    groups_of: Mapping[str, list[str]]

    def is_of(self, before: "Basis | None") -> bool:
        """It is as it was then: reports and groups are replaced, never changed."""
        return (
            before is not None
            and self.about is before.about
            and self.state is before.state
            and self.groups_of is before.groups_of
            and (self.presence, self.seen_ms_ago) == (before.presence, before.seen_ms_ago)
        )


class FleetView:
    def __init__(self, console: Console, site: str, folder: Path | None, now_ms: Callable[[], int]) -> None:
        """`now_ms` since 1970. Without a folder groups are forgotten at the end."""
        self._console = console
        self._site = site
        self._now_ms = now_ms
        file = folder / GROUPS_FILE if folder else None
        self._groups = read_list(file, FleetGroups(groups={})).groups
        self._groups_of = groups_of(self._groups)
        cues_file = folder / CUES_FILE if folder else None
        self._cues = read_list(cues_file, FleetCues(cues=[]))
        self._cues_file = BackgroundFile(cues_file, self._cues_text)
        self._file = BackgroundFile(file, lambda: FleetGroups(groups=self._groups).model_dump_json())
        self._revision = 1
        self._robots: dict[str, tuple[int, FleetRobot]] = {}
        self._bases: dict[str, Basis] = {}
        self._removed: dict[str, int] = {}
        self._tasks: dict[str, tuple[int, FleetTask]] = {}
        self._events: deque[tuple[int, FleetEvent]] = deque(maxlen=KEPT_EVENTS)
        self._broker = FleetBroker(status="connecting", detail="")
        self._seen_at_ms: dict[str, int] = {}
        self._asked_at_s = -PRESENT_S

    async def changes(self, since: int) -> FleetChanges:
        """Waits until there are any, for a moment at most. A `since` of another start gets all of it."""
        clock = asyncio.get_running_loop().time
        self._asked_at_s = clock()
        until_s = self._asked_at_s + LONGEST_WAIT_S
        while True:
            self._look()
            if not 0 < since <= self._revision:
                return self._since(0)
            if since < self._revision or clock() >= until_s:
                return self._since(since)
            await asyncio.sleep(EACH_S)

    @property
    def is_watched(self) -> bool:
        """A page has asked for changes just now."""
        return asyncio.get_running_loop().time() - self._asked_at_s <= PRESENT_S

    def robots(self) -> Mapping[str, FleetRobot]:
        self._look()
        return {robot.id: robot for _, robot in self._robots.values()}

    def put_task(self, task: FleetTask) -> None:
        """New, or in place of the one with that id."""
        self._revision += 1
        self._tasks[task.id] = (self._revision, task)

    def forget_task(self, task_id: str) -> None:
        self._tasks.pop(task_id, None)

    async def group(self, robots: Sequence[str], group: str) -> None:
        """Into that group alone; empty: into none. Robots that are away stay where they are. Raises an
        OutOfRangeError, and a StorageError where the disk refuses: they hold until the end then.
        """
        moved = set(robots)
        groups = {
            name: [one for one in members if one not in moved] for name, members in self._groups.items()
        }
        if group:
            groups[group] = [*groups.get(group, []), *dict.fromkeys(robots)]
        try:
            wanted = FleetGroups(groups={name: members for name, members in groups.items() if members})
        except ValidationError:
            raise OutOfRangeError("There are at most 100 groups, of 1000 robots each.") from None
        self._groups = wanted.groups
        self._groups_of = groups_of(self._groups)
        self._look()
        await self._file.saved()

    async def set_cues(self, wanted: FleetCues) -> None:
        """Raises a StorageError where the disk refuses; they hold until the end then."""
        self._cues = wanted
        self._revision += 1
        await self._cues_file.saved()

    def _cues_text(self) -> str:
        return self._cues.model_dump_json()

    def _look(self) -> None:
        """Takes in what the console has heard since the last look."""
        problem = self._console.problem
        broker = FleetBroker(status="connecting" if problem else "connected", detail=problem or "")
        if broker != self._broker:
            self._broker = broker
            self._revision += 1
        heard = {one.name: one for one in self._console.robots()}
        for name, one in heard.items():
            basis = Basis(one.about, one.state, one.presence, self._seen_ms_ago(one), self._groups_of)
            if basis.is_of(self._bases.get(name)):
                continue
            self._bases[name] = basis
            robot = self._robot(name, basis)
            _, before = self._robots.get(name, (0, None))
            if robot != before:
                self._revision += 1
                self._robots[name] = (self._revision, robot)
                self._removed.pop(name, None)
                self._note(before, robot)
        for name in self._robots.keys() - heard.keys():
            self._revision += 1
            del self._robots[name], self._bases[name]
            self._removed[name] = self._revision

    def _note(self, before: FleetRobot | None, robot: FleetRobot) -> None:
        """What a person wants to read later. The first look is no event."""
        if before is None:
            return
        kind = event_of(before, robot)
        if kind is not None:
            by = robot.state.stopped_by if kind == "stopped" and robot.state else None
            event = FleetEvent(at_ms=self._now_ms(), robot=robot.name, kind=kind, by=by)
            self._events.append((self._revision, event))

    def _since(self, since: int) -> FleetChanges:
        def of(entries: Mapping[str, tuple[int, T]]) -> list[T]:
            return [one for revision, one in entries.values() if revision > since]

        return FleetChanges(
            revision=self._revision,
            is_whole=since == 0,
            site=self._site,
            broker=self._broker,
            robots=of(self._robots),
            removed=[name for name, revision in self._removed.items() if since and revision > since],
            tasks=of(self._tasks),
            cues=self._cues.cues,
            events=[event for revision, event in self._events if revision > since],
        )

    def _robot(self, name: str, basis: Basis) -> FleetRobot:
        about, state = basis.about, basis.state
        slots = about.slots if about else {}
        return FleetRobot(
            id=name,
            name=about.name if about and about.name else name,
            robot=about.robot if about else "",
            board=about.board if about else "unknown",
            version=about.version if about else "",
            page=about.page if about else "",
            limits=about.servos if about else [],
            low_battery_mv=about.low_battery_mv if about else None,
            slots=[FleetSlot(slot=int(slot), name=group.name) for slot, group in slots.items()],
            groups=self._groups_of.get(name, []),
            presence=basis.presence,
            seen_ms_ago=basis.seen_ms_ago,
            state=state_of(state, slots) if state else None,
        )

    def _seen_ms_ago(self, heard: Robot) -> int | None:
        now_ms = self._now_ms()
        if heard.presence != "silent":
            self._seen_at_ms[heard.name] = now_ms
            return None
        seen_at_ms = self._seen_at_ms.get(heard.name)
        return None if seen_at_ms is None else (now_ms - seen_at_ms) // AGE_STEP_MS * AGE_STEP_MS


def groups_of(groups: Mapping[str, Sequence[str]]) -> dict[str, list[str]]:
    """The groups of each robot. To look for a thousand robots in each group takes half a second."""
    found: dict[str, list[str]] = {}
    for group in sorted(groups):
        for name in groups[group]:
            found.setdefault(name, []).append(group)
    return found


def state_of(state: State, slots: Mapping[str, StoredGroup]) -> FleetState:
    running = state.running
    named = slots.get(str(running.slot)) if running else None
    return FleetState(
        link=state.link.status,
        latch=state.latch,
        stopped_by=state.stopped_by,
        driver=state.driver,
        running=FleetRunning(slot=running.slot, name=named.name if named else "") if running else None,
        battery_mv=battery_mv_of(state.battery),
    )


def battery_mv_of(battery: BatteryState) -> int | None:
    """The last one that the board has reported."""
    match battery.kind:
        case "read":
            return battery.battery_mv
        case "silent":
            return battery.last_mv
        case "unread":
            return None


def event_of(before: FleetRobot, now: FleetRobot) -> FleetEventKind | None:
    """The one change that a person wants to read of, if there is one."""
    if before.presence == "silent" and before.seen_ms_ago is None:
        return None  # what the broker had kept of it came before what it says now
    if now.presence != before.presence:
        return "back" if now.presence == "present" else now.presence
    if before.state is None or now.state is None:
        return None
    if now.state.latch != before.state.latch:
        return "stopped" if now.state.latch else "resumed"
    was_ready, is_ready = before.state.link == "ready", now.state.link == "ready"
    if was_ready != is_ready:
        return "ready" if is_ready else "lost"
    return None


def read_list(file: Path | None, empty: M) -> M:
    """Empty where it was never stored, or cannot be read: it is a convenience."""
    if file is None:
        return empty
    try:
        return type(empty).model_validate_json(file.read_text("utf-8"))
    except FileNotFoundError:
        return empty
    except (OSError, ValidationError):
        log.warning("%s cannot be read: an empty one takes its place", file)
        return empty

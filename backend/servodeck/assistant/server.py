"""The tools. Which of them an assistant gets depends on its role at the gateway: everybody looks, proposes
and stops; only who may drive moves. No tool plays a draft, and none resumes: these are for people.

Decides nothing about motion: every request goes through the gateway's own door, and its sentence comes back.
"""

from collections.abc import Awaitable, Callable
from functools import wraps
from inspect import signature
from typing import Annotated, Any, ParamSpec, TypeVar

from mcp.server.mcpserver import Context, Image, MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from mcp.types import CallToolResult, InputRequiredResult, ToolAnnotations
from pydantic import BaseModel, Field

from servodeck import __version__
from servodeck.assistant.bodies import Body, Degrees, RobotAbout
from servodeck.assistant.drafts import ProposedFrame, check, document, duration_ms
from servodeck.assistant.gateway import Requests
from servodeck.assistant.picture import picture
from servodeck.client.asynchronous import AsyncRobot
from servodeck.client.values import Snapshot
from servodeck.errors import GatewayError
from servodeck.library.library import wall_clock_ms

P = ParamSpec("P")
T = TypeVar("T")
LOOK = ToolAnnotations(read_only_hint=True)
PROPOSE = ToolAnnotations(read_only_hint=False, destructive_hint=False)
MOVE = ToolAnnotations(read_only_hint=False, destructive_hint=True)
INSTRUCTIONS = """A robot on a servo controller, through its Servodeck gateway. Angles are in degrees
from each servo's home. Call get_robot first: it has the servos' names and limits. propose_group stores a
draft that a person opens and plays on the page; you cannot play it. While the robot is stopped, all that
moves is refused until a person presses Resume; do not try again before you are told so. A person may be near
the robot: move slowly, and say beforehand what you will do."""
# A person watches and may want to stop it: not as fast as a program may.
FASTEST_S, LONGEST_S = 0.5, 30.0
MOST_TIMES = 10
DRAFT = "draft"
"""The tag that the gateway gives to what was proposed."""

Seconds = Annotated[float, Field(ge=FASTEST_S, le=LONGEST_S)]
Times = Annotated[int, Field(ge=1, le=MOST_TIMES)]


class RobotNow(BaseModel):
    """`degrees`: where each servo is or is moving to; one that is missing is unknown, and its first move is
    slow. `slots`: the groups in the board's memory that the gateway knows.
    """

    link: str
    is_stopped: bool
    stopped_by: str | None
    driver: str | None
    battery_mv: int | None
    degrees: dict[str, float]
    slots: dict[int, str]


class GroupAbout(BaseModel):
    id: str
    name: str
    tags: list[str]
    seconds: float
    frames: int


class GroupFrame(BaseModel):
    seconds: float
    degrees: dict[str, float]
    note: str


class Group(BaseModel):
    name: str
    tags: list[str]
    frames: list[GroupFrame]


class Proposal(BaseModel):
    """`id` is null where nothing was stored because of `problems`. `remarks` are worth a second thought."""

    id: str | None
    problems: list[str]
    remarks: list[str]
    seconds: float
    ranges: dict[str, tuple[float, float]]
    next: str


def refusing(tool: Callable[P, Awaitable[T]]) -> Callable[P, Awaitable[T]]:
    """The gateway's refusal as the tool's: its code and its sentence."""

    @wraps(tool)
    async def run(*args: P.args, **kwargs: P.kwargs) -> T:
        try:
            return await tool(*args, **kwargs)
        except GatewayError as error:
            raise ToolError(f"{error.code}: {error.detail}") from error

    return run


class Looking:
    """Tools that change nothing."""

    def __init__(self, robot: AsyncRobot, requests: Requests) -> None:
        self._robot = robot
        self._requests = requests

    async def get_snapshot(self) -> RobotNow:
        """The robot now: its link, whether it is stopped, who drives, the battery, where its servos are."""
        snapshot, body = await self._robot.snapshot(), await self._requests.body()
        return RobotNow(
            link=snapshot.link,
            is_stopped=snapshot.is_latched,
            stopped_by=snapshot.raw["stoppedBy"],
            driver=snapshot.driver,
            battery_mv=snapshot.battery_mv,
            degrees={
                joint.name: joint.degrees_at(place)
                for number, place in pose_of(snapshot, body).items()
                if (joint := body.joints.get(number))
            },
            slots=dict(snapshot.groups),
        )

    async def get_robot(self) -> RobotAbout:
        """Its servos with names and limits in degrees, its named poses, and what its board takes."""
        return (await self._requests.body()).about(list((await self._robot.poses()).values()))

    async def get_pose_picture(self) -> Image:
        """A picture of where the servos are or are moving to."""
        snapshot, body = await self._robot.snapshot(), await self._requests.body()
        return Image(data=picture(body, [pose_of(snapshot, body)]), format="png")

    async def list_groups(self) -> list[GroupAbout]:
        """The action groups of the library, drafts among them."""
        return [
            GroupAbout(id=one.id, name=one.name, tags=list(one.tags), seconds=one.seconds, frames=one.frames)
            for one in await self._requests.groups()
        ]

    async def get_group(self, id: str) -> Group:  # noqa: A002 (as list_groups has it)
        """The frames of an action group of the library, in degrees."""
        content, body = await self._requests.group(id), await self._requests.body()
        frames = [
            GroupFrame(
                seconds=frame["durationMs"] / 1000,
                degrees={
                    joint.name: joint.degrees_at(target["position"])
                    for target in frame["targets"]
                    if (joint := body.joints.get(target["servo"]))
                },
                note=frame["note"],
            )
            for frame in content["frames"]
        ]
        return Group(name=content["name"], tags=content["tags"], frames=frames)


class Proposing:
    def __init__(self, requests: Requests) -> None:
        self._requests = requests

    async def propose_group(
        self,
        name: Annotated[str, Field(min_length=1, max_length=64)],
        frames: Annotated[list[ProposedFrame], Field(min_length=1, max_length=255)],
    ) -> list[Any]:
        """Checks an action group against the robot's limits and stores it in the library as a draft, with a
        picture of its frames in the answer. It is not played: a person opens the draft on the page, looks at
        it and presses Play. Nothing is stored where there are problems.
        """
        body = await self._requests.body()
        checked = check(frames, body)
        length_ms = duration_ms(frames)
        stored = None
        if not checked.problems:
            text = document(name, frames, checked, body)
            facts = {
                "kind": "group",
                "name": name,
                "robot": body.name,
                "tags": [],
                "updatedAtMs": wall_clock_ms(),
                "frames": len(frames),
                "durationMs": length_ms,
                "unit": body.family.unit,
                "pose": [
                    {"servo": servo, "position": place} for servo, place in checked.positions[0].items()
                ],
            }
            stored = await self._requests.propose(text, facts)
        proposal = Proposal(
            id=stored,
            problems=list(checked.problems),
            remarks=list(checked.remarks),
            seconds=length_ms / 1000,
            ranges=checked.ranges,
            next="A person opens the draft in the library on the page and presses Play."
            if stored
            else "Nothing was stored. Correct the problems and propose it again.",
        )
        return [proposal.model_dump_json(indent=2), Image(data=picture(body, checked.poses), format="png")]


class Stopping:
    def __init__(self, robot: AsyncRobot) -> None:
        self._robot = robot

    async def stop(self) -> str:
        """STOP, at once, whoever drives. Afterwards nothing moves until a person presses Resume."""
        unheld = await self._robot.stop()
        if unheld is None:
            return "Stopped: every servo is held."
        return f"Stop was sent. Some servos may still move: {dict(unheld)}"


class Driving:
    """Tools that move the robot, under the name of the assistant's token; each waits until it is over."""

    def __init__(self, robot: AsyncRobot, requests: Requests) -> None:
        self._robot = robot
        self._requests = requests

    async def move_servos(self, degrees: Degrees, seconds: Seconds = 2.0) -> str:
        """Moves servos together to these angles. The first move of a servo takes at least 1.5 s."""
        await self._robot.move(degrees, units="deg", seconds=seconds)
        await self._robot.release()
        return "The servos have arrived."

    async def go_to_pose(self, pose: str, seconds: Seconds = 2.0) -> str:
        """Moves to a named pose of the robot; "home" is every servo at its home."""
        await self._robot.pose(pose, seconds=seconds)
        await self._robot.release()
        return f"The robot is at {pose}."

    async def run_slot(self, group: str | int, times: Times = 1) -> str:
        """Runs a group that a person has stored on the board, by its name or its slot. No draft: a person
        plays that, until its tag `draft` is taken off in the library.
        """
        await self._refuse_draft(group)
        outcome = await self._robot.run(group, times=times)
        await self._robot.release()
        return f"It has ended. The board: {outcome}."

    async def _refuse_draft(self, group: str | int) -> None:
        drafts = {one.id for one in await self._requests.groups() if DRAFT in one.tags}
        for slot, stored in (await self._robot.snapshot()).raw["slotVersions"].items():
            if group in (int(slot), stored["name"]) and stored["document"] in drafts:
                raise ToolError(f"Slot {slot} holds a draft: a person plays it.")


def pose_of(snapshot: Snapshot, body: Body) -> dict[int, float]:
    """In the units of the robot's document."""
    return {
        number: place - joint.trim
        for number, place in snapshot.targets.items()
        if (joint := body.joints.get(number))
    }


class StrictServer(MCPServer[Any]):
    """Refuses what a tool does not take, by name; its library would leave it out in silence. STOP is done
    whatever it carries.
    """

    def __init__(self) -> None:
        super().__init__("servodeck", version=__version__, instructions=INSTRUCTIONS)
        self.taken: dict[str, list[str]] = {}
        """The arguments of each tool."""

    async def call_tool(
        self, name: str, arguments: dict[str, Any], context: Context[Any, Any] | None = None
    ) -> CallToolResult | InputRequiredResult:
        taken = self.taken.get(name, list(arguments))
        for word in arguments:
            if word not in taken:
                allowed = ", ".join(taken) or "none"
                raise ToolError(f"malformed: {word} is no argument of {name}, allowed: {allowed}")
        return await super().call_tool(name, arguments, context)


def make_server(robot: AsyncRobot, requests: Requests, *, drives: bool) -> MCPServer[Any]:
    """`drives`: it gets the tools that move."""
    server = StrictServer()
    looking, proposing = Looking(robot, requests), Proposing(requests)
    tools: list[tuple[Callable[..., Awaitable[Any]], ToolAnnotations]] = [
        (looking.get_snapshot, LOOK),
        (looking.get_robot, LOOK),
        (looking.get_pose_picture, LOOK),
        (looking.list_groups, LOOK),
        (looking.get_group, LOOK),
        (proposing.propose_group, PROPOSE),
        (Stopping(robot).stop, MOVE),
    ]
    if drives:
        driving = Driving(robot, requests)
        tools += [(driving.move_servos, MOVE), (driving.go_to_pose, MOVE), (driving.run_slot, MOVE)]
    for tool, annotations in tools:
        has_picture = tool in (looking.get_pose_picture, proposing.propose_group)
        structured = False if has_picture else None
        if tool.__name__ != Stopping.stop.__name__:
            server.taken[tool.__name__] = list(signature(tool).parameters)
        server.add_tool(refusing(tool), annotations=annotations, structured_output=structured)
    return server

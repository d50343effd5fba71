"""`servodeck fleet`: the robots of a site on an MQTT broker, from the command line. Parses and prints; the
console talks to the gateways, and each of them decides what is allowed.
"""

import json
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from functools import wraps
from inspect import Signature, signature
from typing import TYPE_CHECKING, Annotated, Any

import typer

from servodeck.cli import end_loading
from servodeck.cli.broker import (
    USUAL_SITE,
    MqttCa,
    MqttCert,
    MqttKey,
    MqttOptions,
    MqttPassword,
    MqttPasswordFile,
    MqttSite,
    MqttUrl,
    broker_of,
    site_of,
)
from servodeck.cli.broker_config import broker_config
from servodeck.cli.commands import LONGEST_ALONE_S, usual_limit_s
from servodeck.cli.groups import group_of
from servodeck.cli.options import (
    BATTERY_UNKNOWN,
    FAILURE,
    INTERRUPTED,
    TIMED_OUT,
    UNREACHABLE,
    USAGE,
    Anyway,
    AsJson,
    Times,
    fail,
)
from servodeck.cli.serve import Data, Lan, Listen, OpenPage, PublicUrl, serve

if TYPE_CHECKING:
    from servodeck.fleet.console import Console
    from servodeck.fleet.heard import Robot

CONNECT_S = 5.0
# All that are there answer at once; so long for the slowest of them.
HEAR_S = 0.5
NAMED_S = 2.0
BEAT_S = 0.25

Role = Annotated[str, typer.Option(help="Which role the broker gives this user.")]
Names = Annotated[list[str] | None, typer.Argument(metavar="ROBOT...", help="Default: all of the site.")]
Named = Annotated[list[str], typer.Argument(metavar="ROBOT...")]

fleet = typer.Typer(
    name="fleet", help="See, stop and drive the robots of a site on an MQTT broker.", no_args_is_help=True
)


def console_at(
    mqtt: MqttUrl = "",
    mqtt_site: MqttSite = USUAL_SITE,
    mqtt_password: MqttPassword = "",
    mqtt_password_file: MqttPasswordFile = None,
    mqtt_ca: MqttCa = None,
    mqtt_cert: MqttCert = None,
    mqtt_key: MqttKey = None,
    role: Role = "driver",
) -> "Console":
    from servodeck.callers import RANKS
    from servodeck.fleet.console import Console

    if not mqtt:
        fail("Name the broker: --mqtt mqtts://USER@HOST, or SERVODECK_MQTT.", USAGE)
    if role not in RANKS:
        fail(f"--role is one of {', '.join(RANKS)}.", USAGE)
    options = MqttOptions(mqtt, mqtt_site, mqtt_password, mqtt_password_file, mqtt_ca, mqtt_cert, mqtt_key)
    try:
        return Console(broker_of(options), site_of(options), role)
    except ValueError as error:
        fail(f"--mqtt is not valid: {error}.", USAGE)


def on_console(command: Callable[..., None]) -> Callable[..., None]:
    """Its first argument is a connected console; on the command line that is the options of `console_at`."""
    where = signature(console_at).parameters

    @wraps(command)
    def run(**options: Any) -> None:
        end_loading()
        from servodeck.fleet.outcomes import FleetError

        with console_at(**{name: options.pop(name) for name in where}) as console:
            if not console.until(lambda: console.problem is None, CONNECT_S):
                fail(f"No answer from the broker. {console.problem}", UNREACHABLE)
            try:
                command(console, **options)
            except FleetError as error:
                fail(str(error))

    own = list(signature(command).parameters.values())[1:]
    run.__signature__ = Signature([*own, *where.values()])  # type: ignore[attr-defined]  # read by typer
    run.__annotations__ = {}  # typer would look for the console's class
    return run


def heard(console: "Console", names: Sequence[str] = ()) -> "list[Robot]":
    """Those that are named, or all that answer within a moment. Ends the program where one is missing."""
    if not names:
        console.until(lambda: False, HEAR_S)
        return console.robots()
    if not console.until(lambda: all(map(console.is_present, names)), NAMED_S):
        missing = [name for name in names if not console.is_present(name)]
        fail(f"{', '.join(missing)}: not there. servodeck fleet list shows who is.")
    return [robot for robot in console.robots() if robot.name in names]


@fleet.command("serve")
def serve_page(
    mqtt: MqttUrl = "",
    mqtt_site: MqttSite = USUAL_SITE,
    mqtt_password: MqttPassword = "",
    mqtt_password_file: MqttPasswordFile = None,
    mqtt_ca: MqttCa = None,
    mqtt_cert: MqttCert = None,
    mqtt_key: MqttKey = None,
    listen: Listen = "",
    lan: Lan = False,
    public_url: PublicUrl = "",
    data: Data = None,
    open_page: OpenPage = None,
) -> None:
    """Serve the page of all robots of the site, on a computer without a robot."""
    if not mqtt:
        fail("Name the broker: --mqtt mqtts://USER@HOST, or SERVODECK_MQTT.", USAGE)
    serve(
        listen=listen,
        lan=lan,
        public_url=public_url,
        data=data,
        open_page=open_page,
        fleet=mqtt,
        fleet_password=mqtt_password,
        fleet_password_file=mqtt_password_file,
        mqtt_site=mqtt_site,
        mqtt_ca=mqtt_ca,
        mqtt_cert=mqtt_cert,
        mqtt_key=mqtt_key,
    )


@fleet.command()
def forget(
    name: Annotated[str, typer.Argument(metavar="ROBOT")],
    mqtt: MqttUrl = "",
    mqtt_site: MqttSite = USUAL_SITE,
    mqtt_password: MqttPassword = "",
    mqtt_password_file: MqttPasswordFile = None,
    mqtt_ca: MqttCa = None,
    mqtt_cert: MqttCert = None,
    mqtt_key: MqttKey = None,
) -> None:
    """Take a robot that will not come back off the lists. The user is that of its gateway, whose password is
    in broker/secrets.
    """
    from servodeck.fleet.leaving import take_off

    if not mqtt:
        fail("Name the broker: --mqtt mqtts://ROBOT@HOST, or SERVODECK_MQTT.", USAGE)
    options = MqttOptions(mqtt, mqtt_site, mqtt_password, mqtt_password_file, mqtt_ca, mqtt_cert, mqtt_key)
    problem = take_off(broker_of(options), site_of(options), name)
    if problem:
        fail(problem)
    print(f"{name} is off the lists.")


@fleet.command("list")
@on_console
def list_robots(console: "Console", as_json: AsJson = False) -> None:
    """Show the robots of the site, and how they are."""
    robots = heard(console)
    if as_json:
        print(json.dumps([json_of(robot) for robot in robots]))
        return
    for robot in robots:
        print(line_of(robot))
    if not robots:
        print("No robot is there.")


def json_of(robot: "Robot") -> dict[str, Any]:
    about = robot.about and robot.about.model_dump(exclude={"stop_token"})
    return {
        "name": robot.name,
        "presence": robot.presence,
        "about": about,
        "state": robot.state and robot.state.model_dump(),
    }


def line_of(robot: "Robot") -> str:
    state = robot.state
    words = [f"{robot.name:<16}", f"{robot.presence:<8}"]
    if state and robot.presence != "silent":
        words += [f"{state.board:<8}", f"{state.link.status:<12}"]
        words += [f"driven by {state.driver}"] if state.driver else []
        words += [f"runs slot {state.running.slot}"] if state.running else []
        words += ["stopped, waits for resume"] if state.latch else []
        words += [f"{state.battery.battery_mv / 1000:.2f} V"] if state.battery.kind == "read" else []
    return "  ".join(words).rstrip()


@fleet.command()
@on_console
def stop(console: "Console", names: Names = None, as_json: AsJson = False) -> None:
    """Stop the robots that are named, or all of the site and those that come later. Names those that were
    not reached.
    """
    from servodeck.fleet.stopping import stop_robots

    # At once; who is there, and so has to answer, is heard meanwhile.
    if names:
        for name in names:
            console.stop(name)
        console.until(lambda: all(map(console.is_present, names)), HEAR_S)
    else:
        console.stop_all(0.0)
        heard(console)
    report = stop_robots(console, names or None)
    if as_json:
        missing, refused = list(report.missing), dict(report.refused)
        print(json.dumps({"stopped": list(report.stopped), "refused": refused, "missing": missing}))
    else:
        count = len(report.stopped) + len(report.refused) + len(report.missing)
        print(f"{len(report.stopped)} of {count} stopped.")
        for name, detail in report.refused:
            print(f"{name}: {detail}")
        for name in report.missing:
            print(f"{name}: not reached")
    if report.missing or report.refused:
        raise typer.Exit(FAILURE)


@fleet.command()
@on_console
def resume(console: "Console", names: Names = None) -> None:
    """Allow motion again at the robots that are named, or at all. Moves nothing. Those that come later are
    not stopped any more.
    """
    robots = heard(console, names or ())
    console.withdraw_holds()
    for robot in robots:
        if robot.presence == "present":
            console.ask(robot.name, "report")  # whose answer has a nonce that is new enough
            console.ask(robot.name, "resume")
            print(f"{robot.name}: motion is allowed.")


@fleet.command()
@on_console
def run(
    console: "Console",
    slot: Annotated[int, typer.Argument(help="Slot of the boards, from 0.")],
    names: Named,
    times: Times = 1,
    continue_for_s: Annotated[
        int | None,
        typer.Option(
            "--continue", metavar="SECONDS", help="Return at once and let it continue for at most this long."
        ),
    ] = None,
    timeout_s: Annotated[
        float | None,
        typer.Option("--timeout", metavar="SECONDS", min=0, help="Stop it after this time."),
    ] = None,
    together: Annotated[
        bool, typer.Option("--together", help="All at the same time, within milliseconds, or none.")
    ] = False,
    anyway: Anyway = False,
) -> None:
    """Run a group of the boards of these robots and wait for its end; Ctrl-C stops it."""
    from servodeck.fleet.outcomes import FleetError

    if together and continue_for_s is not None:
        fail("--together waits for the end: leave out --continue.", USAGE)
    heard(console, names)
    try:
        for name in names:
            drive(console, name)
        if together:
            begin_together(console, names, slot, times, anyway=anyway)
        else:
            begin(console, names, slot, times, continue_for_s, anyway=anyway)
        if continue_for_s is not None:
            return
        limit_s = watch(console, names, timeout_s)
    except KeyboardInterrupt:
        release(console, names)
        fail("Ended.", INTERRUPTED)
    except FleetError:
        release(console, names)
        raise
    release(console, names)
    if limit_s:
        fail(f"The end was not reported within {limit_s:g} s, so it was stopped.", TIMED_OUT)


def begin(
    console: "Console",
    names: Sequence[str],
    slot: int,
    times: int,
    continue_for_s: int | None,
    *,
    anyway: bool,
) -> None:
    alone_ms = None if continue_for_s is None else min(continue_for_s, LONGEST_ALONE_S) * 1000
    begun = {
        name: console.request(name, "run", slot=slot, times=times, continue_for_ms=alone_ms, anyway=anyway)
        for name in names
    }
    for name, answered in begun.items():
        done = console.result_of(name, answered)
        print(f"{name}: slot {slot}, {done.outcome}.")
        if done.battery_unknown:
            print(f"{name}: {BATTERY_UNKNOWN}")
        console.beat()


def begin_together(console: "Console", names: Sequence[str], slot: int, times: int, *, anyway: bool) -> None:
    from servodeck.fleet.together import start_together

    start_together(console, names, slot, times, anyway=anyway)
    console.until(lambda: all(is_running(console, name) for name in names), HEAR_S)
    for name in names:
        print(f"{name}: slot {slot}, {'started' if is_running(console, name) else 'did not start'}.")


def drive(console: "Console", name: str) -> None:
    """Raises FleetError where another client drives it."""
    from servodeck.fleet.outcomes import FleetError

    if not console.ask(name, "ask", action="request").drives:
        console.ask(name, "ask", action="release")
        robot = console.robot(name)
        driver = robot.state.driver if robot and robot.state else None
        raise FleetError(f"{driver or 'Somebody'} drives {name}. Wait, or ask there.")


def release(console: "Console", names: Iterable[str]) -> None:
    """Ends their runs and needs no resume. One that does not answer ends its run by itself, and stops."""
    from servodeck.fleet.outcomes import FleetError

    for name in filter(console.drives, names):
        with suppress(FleetError):
            console.ask(name, "ask", action="release")


def watch(console: "Console", names: Sequence[str], timeout_s: float | None) -> float:
    """Beats until none of them runs. The limit that was reached; 0 where all have ended before."""
    ends_in_ms = [running_in_ms(console, name) for name in names]
    known = [ms for ms in ends_in_ms if ms is not None]
    longest_ms = max(known) if len(known) == len(names) else None
    limit_s = usual_limit_s(longest_ms) if timeout_s is None else timeout_s
    begun_s = time.monotonic()
    while any(is_running(console, name) for name in names):
        if time.monotonic() - begun_s > limit_s:
            return limit_s
        console.beat()
        console.until(lambda: not any(is_running(console, name) for name in names), BEAT_S)
    return 0.0


def running_in_ms(console: "Console", name: str) -> int | None:
    """How long it still runs, as its gateway knows now."""
    state = console.ask(name, "report").state
    return state.running.ends_in_ms if state and state.running else 0


def is_running(console: "Console", name: str) -> bool:
    robot = console.robot(name)
    return robot is not None and robot.state is not None and robot.state.running is not None


@fleet.command()
@on_console
def download(
    console: "Console",
    groups: Annotated[
        list[str], typer.Argument(metavar="SLOT=FILE...", help="For example 5=wave.json 6=bow.json")
    ],
    to: Annotated[list[str], typer.Option(help="A robot. May be repeated.")],
) -> None:
    """Store groups on the boards of robots, one after the other on each."""
    from servodeck.fleet.outcomes import FleetError

    bodies = [group_of(text) for text in groups]
    heard(console, to)
    try:
        jobs = {name: begin_download(console, name, bodies) for name in to}
    except FleetError:
        release(console, to)
        raise
    failed = False
    for name, job in jobs.items():
        status = end_of(console, name, job)
        failed = failed or status != "done"
        print(f"{name}: {status}")
        console.ask(name, "ask", action="release")
    if failed:
        raise typer.Exit(FAILURE)


def begin_download(console: "Console", name: str, bodies: Sequence[dict[str, Any]]) -> str:
    """As one job, with a request for each group. Its id."""
    drive(console, name)
    job = None
    for body in bodies:
        job = console.ask(name, "download", groups=[body], behind=job and job.id).job
    assert job
    console.ask(name, "report")  # the state that is known from now on has the job
    return job.id


def end_of(console: "Console", name: str, job: str) -> str:
    console.until(lambda: job_status(console, name, job) != "running", LONGEST_ALONE_S)
    return job_status(console, name, job)


def job_status(console: "Console", name: str, job: str) -> str:
    """Of one that its gateway does not know any more: lost."""
    console.beat()
    robot = console.robot(name)
    state = robot.state if robot else None
    if state is None or not console.is_present(name):
        return "lost"
    return state.job.status if state.job and state.job.id == job else "lost"


fleet.command()(broker_config)

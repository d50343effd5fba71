"""STOP of robots, over the broker and, where a gateway has not confirmed it within a moment, straight to its
own page: the broker may be gone, or what is between.

Knows a console, and HTTP as a client; no robot core.
"""

import json
from collections.abc import Collection
from concurrent.futures import ThreadPoolExecutor, wait
from http.client import HTTPException
from typing import Any

from servodeck.fleet.console import STOP_S, Console
from servodeck.fleet.heard import Robot
from servodeck.fleet.messages import About, State
from servodeck.fleet.outcomes import StopReport, report_of

# Over a broker that works all have confirmed it by then.
GRACE_S = 0.25
# For the connection and for each read, and for all of it.
STRAIGHT_S, WHOLE_S = 1.0, 2.0
ANSWER_BYTES = 16 * 1024
# Those that are switched off take all of that second, in which the others must not wait.
AT_ONCE = 256


def stop_robots(console: Console, names: Collection[str] | None = None) -> StopReport:
    """Blocks. None: all of the site, and those that connect later. Each robot that was ever heard is in the
    report: one that is silent may still move, and of two gateways with one name one may have
    answered for both.
    """

    def over_broker() -> StopReport:
        return console.stop_all() if names is None else console.stop_some(names)

    before = {robot.name: robot.state for robot in console.robots()}
    known = set(names) if names is not None else set(before)
    threads = ThreadPoolExecutor(AT_ONCE, thread_name_prefix="stop")
    try:
        sent = threads.submit(over_broker)
        wait([sent], GRACE_S)
        answered = answered_in(sent.result()) if sent.done() else frozenset()
        asked = known - answered
        unconfirmed = [
            one
            for one in console.robots()
            if one.name in asked and not has_stopped(one, before.get(one.name))
        ]
        straight = {one.name: threads.submit(stop_straight, one.about) for one in unconfirmed if one.about}
        report = sent.result()
        wait(straight.values(), STOP_S)
        reached = {name for name, stopped in straight.items() if stopped.done() and stopped.result()}
        reached -= {one.name for one in unconfirmed if one.state and one.state.link.status != "ready"}
    finally:
        threads.shutdown(wait=False, cancel_futures=True)
    refused = {name: detail for name, detail in report.refused if name in known}
    cloned = {one.name for one in console.robots() if one.presence == "cloned"}
    stopped = (reached | set(report.stopped)) - refused.keys() - cloned
    return report_of(stopped, refused, known - stopped - refused.keys())


def answered_in(report: StopReport) -> frozenset[str]:
    return frozenset([*report.stopped, *(name for name, _ in report.refused)])


def has_stopped(robot: Robot, before: State | None) -> bool:
    """It has said so since; one that was stopped before may have been resumed."""
    state = robot.state
    return robot.presence == "present" and state is not None and state is not before and state.latch


def stop_straight(about: About) -> bool:
    """Whether the gateway at that page has stopped its robot. Follows no redirection, and uses no proxy: the
    address is one in this network.
    """
    # They take as long to load as all of the console.
    from urllib.request import HTTPRedirectHandler, ProxyHandler, Request

    from servodeck.fetching import Fetch

    class Nowhere(HTTPRedirectHandler):
        def redirect_request(self, *_: Any) -> None:
            return None

    if not (about.page and about.stop_token):
        return False
    headers = {"Authorization": f"Bearer {about.stop_token}"}
    request = Request(f"{about.page.rstrip('/')}/api/stop", b"", headers, method="POST")
    try:
        said = json.loads(Fetch(WHOLE_S, STRAIGHT_S).read(request, ANSWER_BYTES, Nowhere, ProxyHandler({})))
    except (OSError, HTTPException, ValueError):
        return False
    # Something else may have the address by now.
    return isinstance(said, dict) and said.get("latch") is True

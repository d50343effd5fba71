"""Watches the robot and hands what is due to every receiver. Takes samples on the event loop, which cost
microseconds; everything that may block is in sender.py.
"""

import asyncio
import uuid
from collections.abc import Callable, Sequence
from datetime import UTC, datetime

from servodeck.notify.conditions import Conditions, Due, Sample
from servodeck.notify.receivers import Notice
from servodeck.notify.sender import Sender
from servodeck.robot.control import Control

# What begins and ends within that time is no news.
EACH_S = 0.5


class Notifications:
    def __init__(self, senders: Sequence[Sender], page: Callable[[], str] = str) -> None:
        """`page`: the address of the page for people who are notified, or an empty text."""
        self.senders = tuple(senders)
        self._page = page

    async def watch(self, control: Control) -> None:
        """Until it is cancelled."""
        conditions = Conditions()
        try:
            while True:
                for due in conditions.after(sample_of(control)):
                    self._send(due, control)
                await asyncio.sleep(EACH_S)
        finally:
            for sender in self.senders:
                sender.end()

    def _send(self, due: Due, control: Control) -> None:
        robot = control.robot.facts
        notice = notice_of(due, robot.name if robot else "", control.board.family_id, self._page())
        for sender in self.senders:
            sender.put(notice)


def notice_of(due: Due, robot: str = "", board: str = "", page: str = "") -> Notice:
    at = datetime.now(UTC).isoformat(timespec="milliseconds")
    return Notice(str(uuid.uuid4()), due.event, due.text, robot, board, at, page)


def sample_of(control: Control) -> Sample:
    robot, reading = control.robot.facts, control.board.battery.newest
    return Sample(
        now_s=control.now(),
        link=control.board.link_state.status,
        latched_by=control.latched_by,
        stopped_by=control.stopped_by,
        battery=(reading.battery_mv, reading.at_s) if reading else None,
        low_mv=robot.low_battery_mv if robot else None,
    )

"""What a gateway says of itself on a broker, made of the state of its robot, and the nonces in it.

Reads state; sends nothing.
"""

from collections.abc import Callable

from servodeck import __version__
from servodeck.fleet.messages import About, Live, Started, State
from servodeck.robot.control import Control
from servodeck.robot.driving import name_of
from servodeck.robot.lease import GONE_S
from servodeck.value import value

# A nonce this young is used again: with 20 messages a second no more of them are remembered.
YOUNG_S = 0.04


class Nonces:
    """Those of the lease, behind the `instance` of this gateway: no other one has the same."""

    def __init__(self, control: Control, instance: str, issued: Callable[[dict[str, float]], None]) -> None:
        """`issued` gets all that are valid, whenever one is issued or the lease has changed."""
        self._control = control
        self._prefix = f"{instance}."
        self._issued = issued
        self._known: dict[str, float] = {}
        self._epoch = -1
        self._newest = ""

    def newest(self) -> str:
        now, lease = self._control.now(), self._control.driving.lease
        self.forget_old()
        if now - self._known.get(self._newest, -YOUNG_S) >= YOUNG_S:
            self._newest = self._prefix + lease.issue(now)
            self._known = {nonce: at for nonce, at in self._known.items() if now - at <= GONE_S}
            self._known[self._newest] = now
            self._issued(self._known)
        return self._newest

    def forget_old(self) -> None:
        """Those of an epoch that has ended."""
        epoch = self._control.driving.lease.epoch
        if epoch != self._epoch:
            self._epoch, self._known = epoch, {}
            self._issued(self._known)

    def of_lease(self, nonce: str) -> str:
        return nonce.removeprefix(self._prefix)


@value
class Page:
    """The gateway's own page for others, and the token with which it takes a STOP; empty where they reach
    none.
    """

    address: str = ""
    stop_token: str = ""


@value
class Facts:
    """A change of these is published at once."""

    board: str
    link: str
    latch: bool
    driver: str | None
    requested_by: str | None
    running: int | None
    play: str | None
    job: str | None
    is_held: bool
    is_unattended: bool
    started: Started | None


class Reports:
    def __init__(self, control: Control, name: str, instance: str, page: Page, nonces: Nonces) -> None:
        self._control = control
        self._name = name
        self._instance = instance
        self._page = page
        self._nonces = nonces
        self._count = 0
        self.is_cloned = False
        self._started: Started | None = None

    def note_start(self, started: Started) -> None:
        self._started = started

    def about(self) -> About:
        control = self._control
        facts = control.robot.facts
        return About(
            name=self._name,
            version=__version__,
            board=control.board.family_id,
            robot=facts.name if facts else "",
            servos=facts.limits if facts else [],
            slots=control.board.slot_versions,
            broken_slots=control.board.broken_slots,
            page=self._page.address,
            stop_token=self._page.stop_token,
            low_battery_mv=facts.low_battery_mv if facts else None,
        )

    def facts(self) -> Facts:
        board, driving = self._control.board, self._control.driving
        running, play, job = board.activity.running(), board.plays.latest, board.jobs.latest
        return Facts(
            board.family_id,
            board.link_state.status,
            self._control.latch,
            name_of(driving.driver),
            name_of(driving.lease.requester),
            running.slot if running else None,
            play.status if play else None,
            job.status if job else None,
            self._control.unheld is None,
            board.unattended.by is not None,
            self._started,
        )

    def state(self) -> State:
        control, board = self._control, self._control.board
        self._count += 1
        return State(
            instance=self._instance,
            count=self._count,
            epoch=control.driving.lease.epoch,
            nonce=self._nonces.newest(),
            is_cloned=self.is_cloned,
            board=board.family_id,
            link=board.link_state,
            latch=control.latch,
            latched_by=control.latched_by,
            stopped_by=control.stopped_by,
            unheld=control.unheld,
            driver=name_of(control.driving.driver),
            requested_by=name_of(control.driving.lease.requester),
            running=board.activity.running(),
            play=board.plays.latest,
            job=board.jobs.latest,
            unattended=board.unattended.snapshot(),
            battery=board.battery.snapshot(),
            started=self._started,
        )

    def live(self) -> Live:
        control = self._control
        return Live(
            instance=self._instance,
            epoch=control.driving.lease.epoch,
            nonce=self._nonces.newest(),
            latch=control.latch,
            driver=name_of(control.driving.driver),
            motion=control.board.motion.snapshot(control.now()),
        )

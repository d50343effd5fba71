"""Identifies the board for the whole life of a link: queries it at each opening, compares the answers with
the family that it is taken for, takes the choice of a person, and watches it while idle. Twin of
shared/src/robot/identification.ts.

Decides when a board is ready, and after how many questions it is gone; the questions and their meaning are
identity.py. Knows no port.
"""

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from typing import Literal, Protocol

from servodeck.errors import (
    BoardError,
    BoardSilentError,
    BoardUnknownError,
    EchoError,
    GatewayError,
    MovingError,
    WrongBoardError,
)
from servodeck.protocol.families import UNKNOWN, Family, Question
from servodeck.protocol.timings import HEARTBEAT
from servodeck.protocol.values import Report, UnknownReport
from servodeck.robot.board.identity import (
    Echoed,
    Evidence,
    SendQuestion,
    candidates_of,
    fit_of,
    identify,
    is_echo,
)
from servodeck.snapshots import LinkState
from servodeck.value import value

Status = Literal["closed", "identifying", "ready", "stale", "refused"]


@value
class BoardStatus:
    """`error` says why it is stale or refused."""

    status: Status
    error: GatewayError | None = None


class IdentifiedBoard(Protocol):
    def may_ask(self) -> bool:
        """A client is connected, and nothing moves: time for questions."""

    def is_idle(self) -> bool:
        """Nothing moves, runs or is being stored."""

    def answered(self) -> asyncio.Task[None]:
        """For the first time since the line was opened; done when the stops have left that follow."""

    def drive(self, family: Family) -> None:
        """From now on it is driven as a board of that family."""

    def entered(self, before: Status) -> None:
        """`status` has changed."""


class Identification:
    def __init__(self, board: IdentifiedBoard, ask: SendQuestion, claim: Family, *, identifies: bool) -> None:
        """`claim`: the family that the board is driven as until another is named. `identifies`: that is
        checked by harmless questions, and the board is watched afterwards.
        """
        self.claim = claim
        self.evidence: Sequence[Evidence] = ()
        self.state = BoardStatus("closed")
        self._board = board
        self._ask = ask
        self._identifies = identifies
        self._is_vouched = False
        self._noise_bytes = 0
        self._echoes = 0
        self._check: asyncio.Task[None] | None = None
        self._at_answer: asyncio.Task[None] | None = None
        """The stops behind the first answer since the line was opened."""
        self._heartbeat = Heartbeat(self._heartbeat_question, self._is_answered, self._gone)

    @property
    def candidates(self) -> list[str]:
        """Families that answer like it; none where no question was sent."""
        return candidates_of(self.evidence)

    @property
    def heard_as(self) -> Family | None:
        """The family by which a report is parsed; None: the one that is driven."""
        return UNKNOWN if self._asks and self.state.status == "identifying" else None

    @property
    def link_state(self) -> LinkState:
        """Of an open line, for clients."""
        status, error = self.state.status, self.state.error
        assert status != "closed"
        return LinkState(
            status=status, code=error.code if error else None, detail=error.detail if error else None
        )

    def judge_known(self) -> None:
        """Raises what keeps commands that move or store from the board: it is unknown which board it is, or
        whether it is there. Without a port only the former can be said.
        """
        if self.state.error:
            raise self.state.error
        if self.state.status == "identifying":
            raise MovingError("The board is being identified: try again in a moment.")
        if self.claim is UNKNOWN:
            raise BoardUnknownError(
                "The board is unknown and no port is open to identify it. Open a port, or choose the board."
            )

    def begin(self, stops: asyncio.Task[None], *, is_vouched: bool = False) -> None:
        """The line is open, and nothing is asked before these stops have left. `is_vouched`: the claim needs
        no check, until another is named.
        """
        self.evidence = ()
        self._at_answer = None
        self._is_vouched = is_vouched
        self._begin_check(stops)

    def ended(self) -> None:
        """The line is down."""
        self._end_check()
        self._heartbeat.stop()
        self.evidence = ()
        self._enter(BoardStatus("closed"))

    def choose(self, family: Family) -> None:
        """A person has chosen it; `UNKNOWN` has the board identified again. Raises MovingError where a
        question might end a motion.
        """
        status = self.state.status
        is_unasked = status not in ("closed", "identifying") and self._identifies and not self.evidence
        must_ask = is_unasked and family is not self.claim
        if (must_ask or (family is UNKNOWN and status != "closed")) and not self._board.is_idle():
            raise MovingError("The robot is moving: wait until it rests, or stop it first.")
        self._is_vouched = self._is_vouched and family is self.claim
        self.claim = family
        if family is UNKNOWN or status == "closed":
            self._board.drive(family)
        # Earlier answers of a board that is silent now may be of another board.
        if must_ask or (self._asks and (family is UNKNOWN or status == "stale") and status != "closed"):
            self._begin_check()
        elif status not in ("closed", "identifying"):
            self._judge()

    def heard(self, report: Report, data: bytes) -> None:
        self._note_echo(data)
        self._heartbeat.heard()
        if self.state.status != "stale" or isinstance(report, UnknownReport):
            return
        if self._asks:
            self._begin_check()
        else:
            self._accept(is_silent=False)

    def heard_noise(self, data: bytes) -> None:
        self._note_echo(data)
        self._noise_bytes += len(data)

    # Inside

    @property
    def _asks(self) -> bool:
        return self._identifies and not self._is_vouched

    def _begin_check(self, stops: asyncio.Task[None] | None = None) -> None:
        self._end_check()
        self.evidence = ()
        self._heartbeat.stop()
        self._enter(BoardStatus("identifying"))
        self._check = asyncio.create_task(self._ask_all(stops))

    def _end_check(self) -> None:
        if self._check:
            self._check.cancel()
        self._check = None

    async def _ask_all(self, stops: asyncio.Task[None] | None) -> None:
        try:
            if self._asks:
                self.evidence = await identify(
                    self._ask_first, lambda: self._noise_bytes, lambda: self._echoes, stops
                )
            elif stops:  # the family's word is enough
                await asyncio.shield(stops)
            if self._at_answer:
                await asyncio.shield(self._at_answer)
        except GatewayError as error:
            # Where the line went while questions were out, its state says so already.
            if self.state.status == "identifying":
                self._refuse(error)
        else:
            self._judge()

    async def _ask_first(self, question: Question) -> Report | None:
        report = await self._ask(question)
        if report is not None and self._at_answer is None:
            self._at_answer = self._board.answered()
        return report

    def _judge(self) -> None:
        fit = fit_of(self.claim, self.evidence)
        if any(isinstance(one, Echoed) for one in self.evidence):
            self._refuse(
                EchoError("The line returns what is sent: RX and TX may be connected to each other.")
            )
        elif self.claim is UNKNOWN:
            self._refuse(BoardUnknownError(self._name_it()))
        elif fit == "contradicts":
            self._refuse(
                WrongBoardError(f"The answers of the board do not match {self.claim.id}. {self._name_it()}")
            )
        else:
            self._accept(is_silent=fit == "silent")

    def _name_it(self) -> str:
        like = f"It answers like: {', '.join(self.candidates)}. " if self.candidates else ""
        return (
            "The board has not been named, so no command that moves or stores is sent to it. "
            f"{like}Name it: servodeck board FAMILY, on the page, or servodeck serve --board FAMILY. "
            "It is remembered for the port."
        )

    def _refuse(self, error: GatewayError) -> None:
        self._heartbeat.stop()
        self._board.drive(UNKNOWN)
        self._enter(BoardStatus("refused", error))

    def _accept(self, *, is_silent: bool) -> None:
        self._board.drive(self.claim)
        self._enter(BoardStatus("stale", silence()) if is_silent else BoardStatus("ready"))
        self._heartbeat.start(is_gone=is_silent)

    def _gone(self) -> None:
        if self.state.status == "ready":
            self._enter(BoardStatus("stale", silence()))

    def _heartbeat_question(self) -> Question | None:
        if not self._asks:
            return None
        # A board that is silent is queried also while no client looks: one may come over HTTP.
        may_ask = self._board.may_ask() or (self.state.status == "stale" and self._board.is_idle())
        return next(iter(self.claim.certain_answers), None) if may_ask else None

    async def _is_answered(self, question: Question) -> bool | None:
        try:
            return await self._ask(question) is not None
        except GatewayError:
            return None

    def _note_echo(self, data: bytes) -> None:
        self._echoes += is_echo(data)

    def _enter(self, state: BoardStatus) -> None:
        before, self.state = self.state.status, state
        self._board.entered(before)


def silence() -> BoardError:
    return BoardSilentError("The board does not answer. Is it switched on? The gateway keeps trying.")


class Heartbeat:
    def __init__(
        self,
        question: Callable[[], Question | None],
        ask: Callable[[Question], Awaitable[bool | None]],
        gone: Callable[[], None],
    ) -> None:
        """`question`: None while none may be sent: no client is connected, something runs, no such board
        answers anything. `ask`: False when no answer came, None when that is unknown.
        """
        self._question = question
        self._ask = ask
        self._gone = gone
        self._runs = False
        self._misses = 0
        self._timer: asyncio.TimerHandle | None = None
        self._polling: asyncio.Task[None] | None = None

    def start(self, *, is_gone: bool) -> None:
        """`is_gone`: it has been silent already, so it is queried more often."""
        self.stop()
        self._runs = True
        self._misses = HEARTBEAT.misses if is_gone else 0
        self._wait()

    def stop(self) -> None:
        self._runs = False
        if self._timer:
            self._timer.cancel()
        if self._polling:
            self._polling.cancel()

    def heard(self) -> None:
        """The board sent a report: no query is needed for a while."""
        self._misses = 0
        if self._runs:
            self._wait()

    def _wait(self) -> None:
        if self._timer:
            self._timer.cancel()
        delay_ms = HEARTBEAT.stale_every_ms if self._misses else HEARTBEAT.every_ms
        self._timer = asyncio.get_running_loop().call_later(delay_ms / 1000, self._begin)

    def _begin(self) -> None:
        self._polling = asyncio.create_task(self._poll())

    async def _poll(self) -> None:
        question = self._question()
        answered = await self._ask(question) if question else None
        if answered is False:
            self._misses += 1
            if self._misses == HEARTBEAT.misses:
                self._gone()  # which may stop it
        if self._runs:
            self._wait()

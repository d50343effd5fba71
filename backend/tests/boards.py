"""Boards for the tests whose other end does its work: stores and erases in its time, and says so."""

from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.timings import wire_s
from tests.fake_port import FakePort
from tests.virtual_time import at, now

RUN, ERASE, DOWNLOAD = 6, 8, 25
# boards.md section 3, typical flash times.
WORK_S = {ERASE: 0.046, DOWNLOAD: 0.225, RUN: 0.001}


class WorkingBoard(FakePort):
    """`answers`: the numbers of the commands that it answers."""

    def __init__(self, *answers: int) -> None:
        super().__init__()
        self._answers = answers

    def write(self, data: bytes) -> None:
        super().write(data)
        command = data[COMMAND_AT]
        if command in self._answers:
            answered_s = now() + wire_s(len(data)) + WORK_S[command]
            at(answered_s, lambda: self.say(bytes((0x55, 0x55, 2, command))))


def old_board() -> WorkingBoard:
    return WorkingBoard(ERASE, DOWNLOAD)


def new_board() -> WorkingBoard:
    return WorkingBoard(RUN, ERASE, DOWNLOAD)

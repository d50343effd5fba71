"""What leaves when a port is opened, whatever another program left on the line: as many stops as a board can
take for the rest of that, then three, then the questions. How long the gateway says that what ran before may
still run, and what follows a STOP. Page: shared/src/robot/faults/leftOver.test.ts and noise.test.ts.
"""

import asyncio

import pytest

from servodeck.api.app import create_app
from servodeck.errors import MovingError
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Frame, Run, ServoTarget
from servodeck.robot.board.download import Group, made_of, packets_of
from servodeck.robot.control import Control
from tests.client import ANNA, Client
from tests.fake_port import FakeHidPort, FakePort, FakePorts
from tests.lockstep import Simulator, SteppedBoard
from tests.running import DEVICE, NO_LIBRARY, client_of, entrance_to
from tests.samples import BATTERY, BATTERY_REPORT, MOVE, STOP, STOPS
from tests.virtual_time import in_virtual_time, now

FOREIGN_SLOT = 7
FRAME = Frame(500, (ServoTarget(1, 1500),))


async def opened(port: FakePort, board: str) -> Control:
    control = Control(FakePorts(port), now, board, identifies_board=True)
    await control.use_port(DEVICE)
    return control


def download(control: Control, board: str) -> None:
    group = Group(5, "", [FRAME])
    control.requests.download([made_of(group, list(packets_of(group, board)), board)], ANNA, lambda: None)


@pytest.mark.parametrize(
    ("board", "count"), [("doc", 127), ("lsc-16", 127), ("unknown", 127), ("learm-esp32", 16)]
)
@in_virtual_time
async def test_a_row_of_stops_leaves_before_any_question(board: str, count: int) -> None:
    port = FakePort()
    control = await opened(port, board)
    await asyncio.sleep(0.05)
    (_, row), *others = port.everything()
    assert row == STOP * count
    assert [packet for _, packet in others] == [*STOPS, BATTERY]
    first_s, second_s, third_s = (at_s for at_s, _ in others[:3])
    assert [second_s - first_s, third_s - second_s] == pytest.approx([0.07, 0.07])
    await control.board.link.close()


@in_virtual_time
async def test_reports_are_whole_packets_so_three_stops_are_enough() -> None:
    port = FakeHidPort()
    control = await opened(port, "lsc-16")
    await asyncio.sleep(0.05)
    assert [packet for _, packet in port.everything()] == [*STOPS, BATTERY]
    await control.board.link.close()


@in_virtual_time
async def test_its_first_answer_is_followed_by_three_stops_and_nothing_is_doubted_any_more() -> None:
    port = FakePort()
    control = await opened(port, "lsc-16")
    await port.until_written(2)
    port.say(BATTERY_REPORT)
    await asyncio.sleep(1.0)
    assert [packet for packet in port.packets() if packet == STOP] == [STOP, *STOPS]
    assert (control.board.link_state.status, control.board.may_be_running) == ("ready", False)
    await control.board.link.close()


@in_virtual_time
async def test_what_a_silent_board_ran_before_may_run_for_its_longest_frame_and_a_download_waits() -> None:
    port = FakePort()
    control = await opened(port, "openarm-old")
    anna = Client(control)
    await control.until_identified()
    assert control.board.may_be_running
    with pytest.raises(MovingError, match="may still run"):
        download(control, "openarm-old")
    await anna.heard()
    control.driving.act(anna, "request")
    await anna.send(MOVE)
    await asyncio.sleep(30.1)
    assert [one["mayBeRunning"] for one in await anna.heard() if one["type"] == "state"][-1] is False
    download(control, "openarm-old")
    await control.board.link.close()


@in_virtual_time
async def test_a_download_of_a_script_waits_for_what_a_silent_board_may_run() -> None:
    port = FakePort()
    control = await opened(port, "openarm-old")
    app = create_app(control, NO_LIBRARY, entrance_to(now=now))
    group = {"slot": 5, "name": "", "frames": [{"durationMs": 500, "positions": {"1": 1500}}]}
    async with client_of(app) as client:
        answer = await client.post("/api/download", json={"groups": [group]})
    assert answer.status_code == 202, answer.text
    assert not control.board.may_be_running
    # Opened, silent to its questions, and its longest frame.
    assert 30 < now() < 34
    await control.board.link.close()


@in_virtual_time
async def test_a_stop_in_the_middle_of_it_latches_and_leaves_behind_the_row() -> None:
    port = FakePort()
    control = Control(FakePorts(port), now, "doc", identifies_board=True)
    opening = asyncio.create_task(control.use_port(DEVICE))
    await asyncio.sleep(0.3)
    await control.stop()
    assert control.latch
    await opening
    assert len(port.rows) == 1
    assert [packet for _, packet in port.everything()][1:4] == STOPS
    await control.board.link.close()


@in_virtual_time
async def test_a_board_that_could_answer_and_does_not_confirms_nothing() -> None:
    port = FakePort()
    control = await opened(port, "lsc-16")
    anna = Client(control)
    await port.until_written(2)
    port.say(BATTERY_REPORT)
    await control.until_identified()
    await control.stop()
    await asyncio.sleep(1)
    halted = [one for one in await anna.heard() if one["type"] == "halted"]
    assert [one["outcome"] for one in halted] == ["sent", "unanswered"]
    assert halted[-1]["unheld"] == {"servos": None, "forMs": None}
    await control.board.link.close()


@in_virtual_time
async def test_a_board_that_answers_behind_the_second_stop_gets_no_more_than_three() -> None:
    port = FakePort()
    control = await opened(port, "lsc-16")
    anna = Client(control)
    await port.until_written(2)
    port.say(BATTERY_REPORT)
    await control.until_identified()
    before, rows = len(port.written), len(port.rows)
    stops = control.stop()
    await port.until_written(before + 3)
    await asyncio.sleep(0.01)
    port.say(BATTERY_REPORT)
    await stops
    await asyncio.sleep(5)
    sent = port.packets()[before:]
    assert (sent[:4], sent.count(STOP), len(port.rows)) == ([STOP, STOP, BATTERY, STOP], 3, rows)
    assert [one["outcome"] for one in await anna.heard() if one["type"] == "halted"] == ["confirmed"]
    await control.board.link.close()


@in_virtual_time
async def test_a_silent_board_is_told_once_a_second_until_a_person_resumes() -> None:
    port = FakePort()
    control = Control(FakePorts(port), now, "doc")
    await control.use_port(DEVICE)
    await control.until_identified()
    await control.stop()
    await asyncio.sleep(1)
    before = len(port.rows)
    await asyncio.sleep(10)
    reminders = [packet for _, packet in port.rows[before:]]
    assert reminders == [STOP] * len(reminders)
    assert 9 <= len(reminders) <= 10
    control.resume(ANNA)
    await asyncio.sleep(5)
    assert len(port.rows) == before + len(reminders)
    await control.board.link.close()


LEFT_OVERS = [
    "",
    "55",
    "5555",
    "555555",
    "5555FE030EF0",
    "55550803",
    "5555080301E8",
    "55550506",
    "5555050607",
]


@pytest.mark.parametrize("board", ["doc", "openarm-old", "openarm-new"])
@pytest.mark.parametrize("left_over", LEFT_OVERS)
@in_virtual_time
async def test_no_group_of_another_program_runs_on(simulator: Simulator, board: str, left_over: str) -> None:
    frames = [{"durationMs": 600, "targets": [{"servo": 2, "position": at}]} for at in (1200, 1700, 1400)]
    history = {"onForMs": 60_000, "hasPad": False, "isSlow": False, "unknown": frames}
    stepped = SteppedBoard(simulator, board, history)
    stepped.take(encode(Run(FOREIGN_SLOT, 0), FAMILIES[board]))
    await asyncio.sleep(1)
    if left_over:
        stepped.note(left_over)
    control = Control(stepped, now, board, identifies_board=True)
    await control.use_port(DEVICE)
    stopped_s = now()
    await asyncio.sleep(5)
    assert not stepped.is_running
    assert max(stepped.moved_s) - stopped_s <= 1.0
    await control.board.link.close()

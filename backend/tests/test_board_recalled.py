"""Of which family the board at a place is, said once and gone by after the next start."""

from servodeck.callers import THIS_COMPUTER
from servodeck.files import Remembered
from servodeck.robot.control import Control
from tests.fake_port import FakePort, FakePorts
from tests.virtual_time import in_virtual_time, now

PLACE = "/dev/board"


async def start(
    remembered: Remembered,
    board: str = "unknown",
    place: str = PLACE,
    *more: FakePort,
    named: bool = False,
    simulated: bool = False,
) -> Control:
    """`named`: by an option. `more` ports than one are opened later."""
    control = Control(
        FakePorts(FakePort(), *more),
        now,
        board,
        PLACE,
        simulated=simulated,
        remembered=remembered,
        recalls_board=not named,
    )
    await control.use_port(place)
    return control


async def family_after_a_start(remembered: Remembered, place: str = PLACE) -> str:
    control = await start(remembered, place=place)
    await control.board.link.close()
    return control.board.family_id


async def say(remembered: Remembered, *boards: str, simulated: bool = False) -> None:
    control = await start(remembered, simulated=simulated)
    for board in boards:
        control.name_board(THIS_COMPUTER, board)
    await control.board.link.close()


@in_virtual_time
async def test_a_chosen_family_is_remembered_after_a_restart_for_that_port_alone() -> None:
    remembered = Remembered()
    await say(remembered, "lsc-6")
    assert await family_after_a_start(remembered) == "lsc-6"
    assert await family_after_a_start(remembered, "/dev/other") == "unknown"


@in_virtual_time
async def test_who_wants_it_asked_again_has_it_asked_again_after_the_next_start_too() -> None:
    remembered = Remembered()
    await say(remembered, "lsc-6", "unknown")
    assert await family_after_a_start(remembered) == "unknown"


@in_virtual_time
async def test_an_option_goes_before_it_also_one_that_wants_the_board_asked() -> None:
    remembered = Remembered()
    await say(remembered, "lsc-6")
    for board in ("doc", "unknown"):
        control = await start(remembered, board, named=True)
        assert control.board.family_id == board
        await control.board.link.close()


@in_virtual_time
async def test_a_family_chosen_with_the_port_is_remembered_too() -> None:
    remembered = Remembered()
    control = await start(remembered, "unknown", PLACE, FakePort())
    await control.use_port("/dev/other", "xarm")
    await control.board.link.close()
    assert await family_after_a_start(remembered, "/dev/other") == "xarm"


@in_virtual_time
async def test_a_simulated_board_is_what_its_starter_says_and_a_family_unknown_here_is_none() -> None:
    remembered = Remembered()
    await say(remembered, "lsc-6", simulated=True)
    assert await family_after_a_start(remembered) == "unknown"
    remembered.remember_board(PLACE, "of-a-newer-version")
    assert await family_after_a_start(remembered) == "unknown"

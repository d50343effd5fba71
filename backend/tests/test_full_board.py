"""A full board: each slot filled, handed over in as many requests as that needs."""

from itertools import repeat
from typing import Any

from servodeck.access.guard import body_bytes
from servodeck.cli.groups import portions_of
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Download, Frame, ServoTarget
from tests.amount import TIMES
from tests.downloading import AnsweringPort, ended
from tests.fake_port import FakePorts
from tests.running import http_to
from tests.test_jobs_of_several import broken
from tests.virtual_time import in_virtual_time, now

DOC = FAMILIES["doc"]
SLOTS = range(DOC.slot.min, DOC.slot.max + 1)
SERVOS = range(1, DOC.servos_per_frame + 1)
STORED_MS = (3.0,)
# All of them would take minutes.
LONGEST_EACH = 8 if TIMES > 1 else len(SLOTS)


def frame_count(slot: int) -> int:
    """Some are as long as can be, more of them in a long run."""
    return DOC.frames_per_group if slot % LONGEST_EACH == 0 else 8


def position(slot: int, index: int, servo: int) -> int:
    """No two frames are alike."""
    return 500 + (slot * 7 + index * 13 + servo * 29) % 2001


def body_of(slot: int) -> dict[str, Any]:
    frames = [
        {"durationMs": 30_000, "positions": {str(servo): position(slot, index, servo) for servo in SERVOS}}
        for index in range(frame_count(slot))
    ]
    return {"slot": slot, "frames": frames}


def packets_of(slot: int) -> list[bytes]:
    count = frame_count(slot)
    frames = [
        Frame(30_000, tuple(ServoTarget(servo, position(slot, index, servo)) for servo in SERVOS))
        for index in range(count)
    ]
    return [encode(Download(slot, count, index, frame), DOC) for index, frame in enumerate(frames)]


@in_virtual_time
async def test_a_full_board_is_downloaded_though_its_client_has_gone() -> None:
    port = AnsweringPort(repeat(STORED_MS))
    portions = portions_of([body_of(slot) for slot in SLOTS])
    async with http_to(FakePorts(port), now) as (client, control):
        job: dict[str, Any] = {}
        for portion in portions:
            behind = {"behind": job["id"]} if job else {}
            taken = await client.post("/api/download", json={"groups": portion, **behind})
            assert len(taken.request.content) <= body_bytes("/api/download")
            assert taken.status_code == 202
            job = taken.json()
        assert job["slots"] == list(SLOTS)
        end = await ended(control, control.board.jobs.find(job["id"]))
        frames = sum(map(frame_count, SLOTS))
        assert (end.status, end.groups_stored, end.frames_stored) == ("done", len(SLOTS), frames)
        assert port.packets()[1:] == [packet for slot in SLOTS for packet in packets_of(slot)]
        assert (broken(control), len(control.board.slot_versions)) == ([], len(SLOTS))

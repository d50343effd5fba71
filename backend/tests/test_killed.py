"""The real process ended, killed or held at random instants, while clients move the robot and save (F15): it
moves nothing afterwards, what was acknowledged is there, and it is ready again soon.
"""

import contextlib
import json
import os
import random
import signal
import threading
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import httpx2
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from tests.amount import named, seeds
from tests.bus import MARGIN_S, PATIENCE_S, Bus, bus_of_pty, serving
from tests.client import lease_of
from tests.samples import MOVE, MOVE_ELSEWHERE, STOP
from tests.test_cli import END_S, Served
from tests.test_library_api import body
from tests.test_ports import Pty

pytestmark = [
    pytest.mark.exhaustive,
    pytest.mark.skipif(os.name != "posix", reason="signals and ptys need POSIX"),
]
OLDEST_MOTION_S = 0.5
LIVES_IN_A_FOLDER = 5  # each saves some hundred documents, and a library takes 5,000
DOWNLOAD_HEAD = bytes.fromhex("55550b1908")


@pytest.fixture
def bus_on() -> Iterator[tuple[Pty, Bus]]:
    with bus_of_pty() as both:
        yield both


class Driver:
    """Moves the robot to and fro as fast as the wire takes it, until it is asked to stand still."""

    def __init__(self, url: str) -> None:
        self._connection = contextlib.ExitStack()
        ws = connect(f"ws{url.removeprefix('http')}/ws", close_timeout=0)
        self._client: ClientConnection = self._connection.enter_context(ws)
        self._nonce = lease_of(self._client)
        self._still = threading.Event()
        self.begun = threading.Event()
        self.answer: dict[str, object] = {}
        self._thread = threading.Thread(target=self._drive, daemon=True)
        self._thread.start()

    def stand(self) -> None:
        """Hears nothing any more, and says nothing."""
        self._still.set()
        self._thread.join()

    def insist(self) -> None:
        """Says again what it had in mind, with old words."""
        for number in range(8):
            self._say(type="packet", id=1000 + number, bytes=MOVE.hex(), nonce=self._nonce)

    def press_stop(self) -> None:
        self._say(type="stop")

    def close(self) -> None:
        self.stand()
        self._connection.close()

    def _drive(self) -> None:
        with contextlib.suppress(ConnectionClosed, OSError):
            for number in range(1_000_000):
                packet = (MOVE, MOVE_ELSEWHERE)[number % 2]
                self._say(type="packet", id=number, bytes=packet.hex(), nonce=self._nonce)
                if self._still.is_set() or not self._hear_answer(number):
                    return
                if self.answer["type"] == "refused":
                    time.sleep(0.02)  # who insists faster is sent away

    def _hear_answer(self, number: int) -> bool:
        while not self._still.is_set():
            with contextlib.suppress(TimeoutError):
                message = json.loads(self._client.recv(timeout=0.05))
                if message["type"] == "tick":
                    self._nonce = message["nonce"]
                    self._say(type="heartbeat", nonce=self._nonce)
                if message["type"] == "done":
                    self.begun.set()
                if message.get("id") == number:
                    self.answer = message
                    return True
        return False

    def _say(self, **message: object) -> None:
        with contextlib.suppress(ConnectionClosed, OSError):
            self._client.send(json.dumps(message))


class Saver:
    """Saves one document after the other and notes which were acknowledged."""

    def __init__(self, url: str, prefix: str) -> None:
        self.acknowledged: dict[str, str] = {}
        self.begun = threading.Event()
        self._url, self._prefix = url, prefix
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._save, daemon=True)
        self._thread.start()

    def end(self) -> None:
        self._ended.set()
        self._thread.join()

    def _save(self) -> None:
        with contextlib.suppress(httpx2.HTTPError), httpx2.Client(timeout=5) as client:
            for number in range(1_000_000):
                if self._ended.is_set():
                    return
                name, text = f"{self._prefix}-{number}", json.dumps({"n": number})
                if client.put(f"{self._url}/api/library/{name}", json=body(text)).status_code == 200:
                    self.acknowledged[name] = text
                    self.begun.set()


def moves_in(data: bytes) -> int:
    """Of a client's; the pose that a stop holds is another one."""
    return data.count(MOVE) + data.count(MOVE_ELSEWHERE)


def behind_stop(data: bytes) -> bytes:
    return data.partition(STOP)[2]


def kill(served: Served, _driver: Driver, bus: Bus, _chance: random.Random) -> None:
    served.process.kill()
    served.process.wait(END_S)
    bus.rest()


def kill_stopped(served: Served, driver: Driver, bus: Bus, chance: random.Random) -> None:
    """STOP has just been pressed: the next process resumes nothing either."""
    pressed_s = time.monotonic()
    driver.press_stop()
    time.sleep(chance.uniform(0.05, 0.4))
    served.process.kill()
    served.process.wait(END_S)
    bus.rest()
    assert moves_in(behind_stop(bus.since(pressed_s))) == 0


def terminate(served: Served, _driver: Driver, bus: Bus, _chance: random.Random) -> None:
    begun_s = time.monotonic()
    served.process.send_signal(signal.SIGTERM)
    served.process.wait(END_S + MARGIN_S)
    bus.rest()
    assert bus.since(begun_s).count(STOP) == 3
    assert moves_in(behind_stop(bus.since(begun_s))) == 0


def hold(served: Served, driver: Driver, bus: Bus, chance: random.Random) -> None:
    """Held by the system; when it continues, what waited for it is too old."""
    served.process.send_signal(signal.SIGSTOP)
    driver.stand()
    bus.rest()
    time.sleep(chance.uniform(OLDEST_MOTION_S + 0.1, 2.5))
    driver.insist()
    woken_s = time.monotonic()
    served.process.send_signal(signal.SIGCONT)
    time.sleep(0.5)
    bus.rest()
    assert moves_in(bus.since(woken_s)) == 0
    kill(served, driver, bus, chance)


ENDS = {"kill -9": kill, "kill -9 behind STOP": kill_stopped, "SIGTERM": terminate, "SIGSTOP": hold}


@pytest.mark.parametrize("end", ENDS)
def test_after_any_end_the_next_start_moves_nothing_and_has_lost_nothing(
    end: str, bus_on: tuple[Pty, Bus], tmp_path: Path
) -> None:
    pty, bus = bus_on
    acknowledged: defaultdict[Path, dict[str, str]] = defaultdict(dict)
    for seed in seeds(2):
        folder = tmp_path / str(seed // LIVES_IN_A_FOLDER)
        with named("test_killed.py", seed, end):
            acknowledged[folder] |= live_and_end(end, pty, bus, folder, random.Random(seed))
    for folder, texts in acknowledged.items():
        with serving(pty, folder) as served, httpx2.Client() as client:
            for name, text in texts.items():
                answer = client.get(f"{served.url}/api/library/{name}")
                assert (name, answer.json().get("text")) == (name, text)


def live_and_end(end: str, pty: Pty, bus: Bus, folder: Path, chance: random.Random) -> dict[str, str]:
    begun_s = time.monotonic()
    with serving(pty, folder) as served:
        bus.until_stopped(begun_s, served)
        bus.rest()
        assert bus.since(begun_s) == STOP
        driver = Driver(served.url)
        saver = Saver(served.url, f"{chance.randrange(10**9)}")
        assert driver.begun.wait(PATIENCE_S), driver.answer
        assert saver.begun.wait(PATIENCE_S)
        time.sleep(chance.uniform(0, 0.8))
        try:
            ENDS[end](served, driver, bus, chance)
        finally:
            served.process.kill()
            saver.end()
            driver.close()
    return saver.acknowledged


def test_half_a_group_that_a_kill_left_behind_is_not_run(bus_on: tuple[Pty, Bus], tmp_path: Path) -> None:
    pty, bus = bus_on
    frames = [{"durationMs": 500, "positions": {"1": 1500}}] * 3
    wish = {"groups": [{"slot": 8, "frames": frames}]}
    begun_s = time.monotonic()
    with serving(pty, tmp_path) as served:
        bus.until_stopped(begun_s, served)
        begun = httpx2.post(f"{served.url}/api/download", json=wish)
        assert begun.status_code == 202
        while DOWNLOAD_HEAD not in bus.since(begun_s):
            assert time.monotonic() - begun_s < PATIENCE_S
            time.sleep(0.001)
        served.process.kill()
    again_s = time.monotonic()
    with serving(pty, tmp_path) as served:
        bus.until_stopped(again_s, served)
        refused = httpx2.post(f"{served.url}/api/slots/8/run", json={})
        assert (refused.status_code, refused.json()["code"]) == (409, "slotBroken")
        bus.rest()
        assert bus.since(again_s) == STOP

"""Moves two servos by the keys of a terminal: a and d turn the base, w and s the elbow, space stops, r
resumes, q quits.

    python drive_by_keys.py

Keys can also come through a pipe: echo aaddq | python drive_by_keys.py
"""

import contextlib
import sys
from collections.abc import Iterator

from servodeck import Robot
from servodeck.errors import GatewayError

STEP = 3.0  # degrees
KEYS = {"a": ("Base", STEP), "d": ("Base", -STEP), "w": ("Elbow", STEP), "s": ("Elbow", -STEP)}


@contextlib.contextmanager
def single_keys() -> Iterator[None]:
    """The terminal gives each key at once, without Enter."""
    if not sys.stdin.isatty():
        yield
        return
    import termios
    import tty

    before = termios.tcgetattr(sys.stdin)
    tty.setcbreak(sys.stdin)
    try:
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


def press(robot: Robot, key: str, degrees: dict[str, float]) -> None:
    if key == " ":
        robot.stop()
    elif key == "r":
        robot.resume()
    elif key in KEYS:
        servo, step = KEYS[key]
        wanted = degrees[servo] + step
        robot.move({servo: wanted}, units="deg", seconds=0.15)
        degrees[servo] = wanted


def main() -> None:
    with Robot() as robot, single_keys():
        robot.pose("home")  # from here on the positions are known
        degrees = dict.fromkeys(("Base", "Elbow"), 0.0)
        print("a d: base, w s: elbow, space: stop, r: resume, q: quit")
        while (key := sys.stdin.read(1)) not in ("", "q"):
            try:
                press(robot, key, degrees)
                print(degrees)
            except GatewayError as error:  # a limit, or a stop: the next key is tried
                print(error)


if __name__ == "__main__":
    main()

"""Dances to a file: plays its frames in time with a beat, by the gateway's clock.

    python dance.py dance.json --bpm 120 --times 4

The file lists where servos are on each beat, in degrees, for so many beats each:

    [{"beats": 1, "Base": 30, "Elbow": 10}, {"beats": 2, "Base": -30}]
"""

import argparse
import json
from pathlib import Path

from servodeck import Robot


def frames_of(steps: list[dict[str, float]], bpm: float) -> list[tuple[float, dict[str, float]]]:
    """The time of each step in seconds, and its servos."""
    return [
        (step["beats"] * 60 / bpm, {name: at for name, at in step.items() if name != "beats"})
        for step in steps
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description="Dance to a file.")
    parser.add_argument("file", type=Path)
    parser.add_argument("--bpm", type=float, default=120)
    parser.add_argument("--times", type=int, default=1)
    wanted = parser.parse_args()
    frames = frames_of(json.loads(wanted.file.read_text("utf-8")), wanted.bpm)
    with Robot() as robot:
        robot.pose("home")
        robot.play(frames, units="deg", times=wanted.times)
        robot.pose("home")
    print(f"Danced {sum(seconds for seconds, _ in frames) * wanted.times:.1f} s.")


if __name__ == "__main__":
    main()

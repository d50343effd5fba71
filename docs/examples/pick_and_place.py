"""Picks something up on one side and puts it down on the other, by the poses of the robot on the board.

    python pick_and_place.py --lift 20 --turn 60 --times 3

Needs servos with the names Base, Elbow and Gripper (change the constants), and one pose, home. It stops the
arm at Ctrl-C and after any error.
"""

import argparse

from servodeck import Robot

BASE, ELBOW, GRIPPER = "Base", "Elbow", "Gripper"
OPEN, CLOSED = -20, 15


def carry(robot: Robot, turn: float, lift: float) -> None:
    """From `turn` degrees on one side to as many on the other; ends lifted."""
    for side, grip in ((turn, CLOSED), (-turn, OPEN)):
        robot.move({BASE: side}, units="deg", seconds=1.5)
        robot.move({ELBOW: 0}, units="deg", seconds=0.8)
        robot.move({GRIPPER: grip}, units="deg", seconds=0.4)
        robot.move({ELBOW: lift}, units="deg", seconds=0.8)


def main() -> None:
    parser = argparse.ArgumentParser(description="Pick and place.")
    parser.add_argument("--turn", type=float, default=60, help="degrees to each side")
    parser.add_argument("--lift", type=float, default=20, help="degrees of the elbow")
    parser.add_argument("--times", type=int, default=1)
    wanted = parser.parse_args()
    with Robot() as robot:
        robot.pose("home")
        robot.move({ELBOW: wanted.lift, GRIPPER: OPEN}, units="deg")
        for _ in range(wanted.times):
            carry(robot, wanted.turn, wanted.lift)
        robot.pose("home")
    print("Done.")


if __name__ == "__main__":
    main()

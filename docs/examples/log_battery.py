"""Writes the battery's voltage to a CSV file, one row each time that the board reports it.

    python log_battery.py battery.csv --rows 100

A gateway reads the battery by itself while a client is connected and the robot is at rest. A token of a
viewer is enough.
"""

import argparse
import asyncio
import csv
from datetime import UTC, datetime
from pathlib import Path

from servodeck import AsyncRobot


async def log(file: Path, rows: int) -> None:
    async with AsyncRobot() as robot:
        with file.open("a", newline="") as opened:
            table = csv.writer(opened)
            if opened.tell() == 0:
                table.writerow(["time", "volts"])
            await robot.battery()  # the first row at once
            async for event in robot.events():
                # The first event has the last report in it.
                battery = event.data.get("battery", {})
                if "batteryMv" not in battery:
                    continue
                table.writerow([datetime.now(UTC).isoformat(timespec="seconds"), battery["batteryMv"] / 1000])
                opened.flush()
                rows -= 1
                if rows == 0:
                    return


def main() -> None:
    parser = argparse.ArgumentParser(description="Log the battery to CSV.")
    parser.add_argument("file", type=Path)
    parser.add_argument("--rows", type=int, default=0, help="0: until Ctrl-C")
    wanted = parser.parse_args()
    asyncio.run(log(wanted.file, wanted.rows))


if __name__ == "__main__":
    main()

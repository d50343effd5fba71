"""Pairs a script with a gateway that is not running yet, and prints its token.
Usage: paired.py FOLDER
"""

import sys
import time
from pathlib import Path

from servodeck.access.devices import DeviceFile, Devices

devices = Devices(DeviceFile(Path(sys.argv[1])), lambda: int(time.time() * 1000))
_, token = devices.admit("token", "Bench", "owner")
devices.close()
sys.stdout.write(token)

"""The command that lets people use a board's own USB cable on Linux: shows the rule, or installs it.

Knows udev's folder and program, no port.
"""

import subprocess
from pathlib import Path
from typing import Annotated

import typer

from servodeck.cli.options import FAILURE, fail
from servodeck.port.hid import UDEV_RULE

# Before 73-seat-late.rules, which gives what `uaccess` promises.
RULE_FILE = Path("/etc/udev/rules.d/70-servodeck.rules")
TELL_UDEV = (("udevadm", "control", "--reload"), ("udevadm", "trigger", "--subsystem-match=hidraw"))


def udev_rule(
    install: Annotated[
        bool, typer.Option("--install", help="Write it to /etc/udev/rules.d, as root, and apply it.")
    ] = False,
) -> None:
    """Show the udev rule (Linux) that lets you use a board on its own USB cable, or install it."""
    if not install:
        print(UDEV_RULE)
        return
    try:
        RULE_FILE.write_text(f"{UDEV_RULE}\n", "utf-8")
        for command in TELL_UDEV:
            subprocess.run(command, check=True, capture_output=True)
    except PermissionError:
        fail(f"{RULE_FILE} cannot be written. Run this as root, with sudo.", FAILURE)
    except (OSError, subprocess.CalledProcessError) as error:
        fail(f"udev does not take the rule: {error}.", FAILURE)
    print(f"{RULE_FILE} is installed. Plug the board's cable in again.")

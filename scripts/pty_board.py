"""Gives a program that speaks bytes on stdin and stdout a serial port: a pty, found through a link.

Knows file descriptors and, for a node of HID reports, where a packet ends; for a board of another speed, how
fast the port is. When the program ends the port hangs up, like a pulled cable.
Usage: pty_board.py [--hid | --baud N] --link PATH -- COMMAND [ARGUMENT...]
(POSIX; prints `pty /dev/pts/N` on stderr)
"""

from __future__ import annotations

import argparse
import contextlib
import errno
import fcntl
import os
import select
import signal
import subprocess
import sys
import termios
import time
import tty
from pathlib import Path
from types import FrameType
from typing import NoReturn

CHUNK_BYTES = 4096
REPORT_BYTES = 64
LENGTH_AT = 2
PARENT_POLL_SECONDS = 0.5
END_SECONDS = 2.0
# A gateway that the same parent started stops the robot and is gone within three seconds.
FAREWELL_SECONDS = 4.0


class Relay:
    """One direction. Reads on only when all it read has been passed on, so a slow reader slows its writer."""

    def __init__(self, source: int, sink: int) -> None:
        self.source = source
        self.sink = sink
        self.pending = b""

    def fill(self) -> bool:
        """Take what is there; False at the end of the source."""
        try:
            self.pending = os.read(self.source, CHUNK_BYTES)
        except BlockingIOError:
            return True
        return self.pending != b""

    def drain(self) -> None:
        try:
            self.pending = self.pending[os.write(self.sink, self.pending) :]
        except BlockingIOError:
            return


class ReportsToProgram(Relay):
    """What is written to a hidraw node: report number 0, the packet, zeros. The program gets the packet."""

    half = b""

    def fill(self) -> bool:
        is_open = super().fill()
        self.half, self.pending = self.half + self.pending, b""
        while len(self.half) > REPORT_BYTES:
            report, self.half = self.half[1 : 1 + REPORT_BYTES], self.half[1 + REPORT_BYTES :]
            self.pending += report[: report[LENGTH_AT] + 2]
        return is_open


class ReportsFromProgram(Relay):
    """Each packet that the program says is a report, zero-padded."""

    half = b""

    def fill(self) -> bool:
        is_open = super().fill()
        self.half, self.pending = self.half + self.pending, b""
        while len(self.half) > LENGTH_AT and len(self.half) >= self.half[LENGTH_AT] + 2:
            size = self.half[LENGTH_AT] + 2
            packet, self.half = self.half[:size], self.half[size:]
            self.pending += packet.ljust(REPORT_BYTES, b"\0")
        return is_open


class AtSpeed(Relay):
    """What a board says that has another speed: it is heard only while the port is open at that one."""

    def __init__(self, source: int, sink: int, baud: int) -> None:
        super().__init__(source, sink)
        self.speed = getattr(termios, f"B{baud}")

    def fill(self) -> bool:
        is_open = super().fill()
        if termios.tcgetattr(self.sink)[5] != self.speed:
            self.pending = b""
        return is_open


class Parent:
    """The process that started this one."""

    def __init__(self) -> None:
        self._id = os.getppid()
        self._gone_at: float | None = None

    def is_gone(self) -> bool:
        if self._gone_at is None and os.getppid() != self._id:
            self._gone_at = time.monotonic()
        return self._gone_at is not None

    def is_forgotten(self) -> bool:
        """Gone for so long that nothing else of it can still be ending."""
        return self._gone_at is not None and time.monotonic() - self._gone_at > FAREWELL_SECONDS


def relay_until_end(to_program: Relay, from_program: Relay, parent: Parent, slave: int) -> None:
    """Pass bytes both ways until the program closes its side. Once the parent process is gone, until the last
    other program has closed the port: a gateway stops the robot first.
    """
    relays = (to_program, from_program)
    holds_slave = True
    while not parent.is_forgotten():
        if parent.is_gone() and holds_slave:
            os.close(slave)
            holds_slave = False
        readers = [relay.source for relay in relays if not relay.pending]
        writers = [relay.sink for relay in relays if relay.pending]
        readable, _, _ = select.select(readers, writers, [], PARENT_POLL_SECONDS)
        for relay in relays:
            if relay.source in readable and not relay.fill():
                return
            if relay.pending:
                relay.drain()


def point_link_at(link: Path, target: str) -> None:
    """Make or move the link in one step, so that it is never missing or half made."""
    link.parent.mkdir(parents=True, exist_ok=True)
    fresh = link.with_name(f".{link.name}.{os.getpid()}")
    fresh.symlink_to(target)
    fresh.replace(link)


def remove_link(link: Path, target: str) -> None:
    """Remove the link unless a newer board has taken it over."""
    try:
        if str(link.readlink()) == target:
            link.unlink()
    except OSError:
        return


def end_program(program: subprocess.Popen[bytes]) -> int:
    """Ask, then insist; returns the exit code."""
    if program.stdin:
        program.stdin.close()
    try:
        return program.wait(END_SECONDS if program.poll() is None else 0)
    except subprocess.TimeoutExpired:
        program.kill()
        return program.wait()


def own_terminal(slave: int) -> None:
    """Ours first: Chromium opens HID nodes so that a pty becomes its terminal, and would end with it."""
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with contextlib.suppress(PermissionError):  # we lead a session already
        os.setsid()
    fcntl.ioctl(slave, termios.TIOCSCTTY, 0)


def serve(link: Path, command: list[str], *, hid: bool = False, baud: int | None = None) -> int:
    parent = Parent()
    # Our own hold on the slave side keeps bytes and the port alive while no other program has it open.
    master, slave = os.openpty()
    tty.setraw(slave)
    if hid:
        own_terminal(slave)
    to_program, from_program = (ReportsToProgram, ReportsFromProgram) if hid else (Relay, Relay)
    name = os.ttyname(slave)
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0) as program:
        assert program.stdin
        assert program.stdout
        voice = program.stdout.fileno()
        said = from_program(voice, master) if baud is None else AtSpeed(voice, master, baud)
        for descriptor in (master, program.stdin.fileno(), program.stdout.fileno()):
            os.set_blocking(descriptor, False)
        point_link_at(link, name)
        try:
            print(f"pty {name}", file=sys.stderr, flush=True)
            relay_until_end(
                to_program(master, program.stdin.fileno()),
                said,
                parent,
                slave,
            )
        except BrokenPipeError:
            pass  # the program died between two turns of the loop
        except OSError as error:
            if error.errno != errno.EIO:  # the last program has closed the port
                raise
        finally:
            remove_link(link, name)
            os.close(master)
            with contextlib.suppress(OSError):  # closed behind the parent's end
                os.close(slave)
            code = end_program(program)
    return code


def leave(_signal: int, _frame: FrameType | None) -> NoReturn:
    # One ending for all signals: unwinds through `serve`, which removes the link and ends the program.
    raise SystemExit(0)


def main() -> int:
    parser = argparse.ArgumentParser(description="Put a program behind a serial port.")
    parser.add_argument("--link", type=Path, required=True, help="path of the link to the port")
    parser.add_argument("--hid", action="store_true", help="the port carries HID reports, as a hidraw node")
    parser.add_argument("--baud", type=int, help="the speed at which the program is heard; else at any")
    parser.add_argument("command", nargs="+", help="the program and its arguments, after --")
    arguments = parser.parse_args()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGQUIT, signal.SIGHUP):
        signal.signal(number, leave)
    return serve(arguments.link, arguments.command, hid=arguments.hid, baud=arguments.baud)


if __name__ == "__main__":
    sys.exit(main())

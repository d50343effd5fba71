"""Counters since the start, as plain numbers; the library for Prometheus is loaded with the first request
(api/prometheus.py). Knows names and numbers.

One set for the process: each module counts here in one line.
"""

from bisect import bisect_left
from collections import Counter

from servodeck.protocol.packets import COMMAND_NUMBER

COMMAND_OF_NUMBER = {number: kind for kind, number in COMMAND_NUMBER.items()}
# A packet on the wire takes 4 to 107 ms, a halt about 200.
WAIT_BUCKETS_S = (0.001, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)


class Totals:
    noise_bytes = 0
    stops = 0
    port_losses = 0
    port_openings = 0


class Waits:
    """`counts`: by bucket, the last one for all that waited longer."""

    def __init__(self) -> None:
        self.counts = [0] * (len(WAIT_BUCKETS_S) + 1)
        self.sum_s = 0.0

    def note(self, waited_s: float) -> None:
        self.counts[bisect_left(WAIT_BUCKETS_S, waited_s)] += 1
        self.sum_s += waited_s


totals = Totals()
queue_wait = Waits()
sent: Counter[str] = Counter()
"""By `name_of` the command, as `received`."""
received: Counter[str] = Counter()
refused: Counter[str] = Counter()
"""By code."""
notified: Counter[str] = Counter()
"""By what became of the notification: sent or dropped."""


def name_of(command: int) -> str:
    """For a label; what has no name in the protocol goes by its number."""
    return COMMAND_OF_NUMBER.get(command) or f"0x{command:02x}"

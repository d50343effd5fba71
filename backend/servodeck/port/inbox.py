"""What the board says: bytes in, packets and noise out. Tells the decoder when the line has been silent.

Knows the decoder and time, no client and no port.
"""

import asyncio
from collections.abc import Callable

from servodeck.protocol.decoder import Decoder, DecoderEvent
from servodeck.protocol.timings import LINE

PAUSE_S = LINE.pause_ms / 1000
SILENCE_S = LINE.idle_ms / 1000


class Inbox:
    def __init__(self, emit: Callable[[DecoderEvent], None]) -> None:
        self._decoder = Decoder(emit)
        self._timers: list[asyncio.TimerHandle] = []

    def push(self, data: bytes) -> None:
        self.close()
        self._decoder.push(data)
        loop = asyncio.get_running_loop()
        self._timers = [
            loop.call_later(PAUSE_S, self._decoder.pause),
            loop.call_later(SILENCE_S, self._decoder.idle),
        ]

    def close(self) -> None:
        for timer in self._timers:
            timer.cancel()

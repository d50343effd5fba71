"""What the board says: bytes in, packets and noise out. Ends a cut packet when the line has been silent.

Knows the decoder and time, no client and no port.
"""

import asyncio
from collections.abc import Callable

from servodeck.packets import Decoder, DecoderEvent

# Far longer than the bytes of one packet are apart (1 ms each, plus what a USB adapter holds back).
SILENCE_S = 0.060


class Inbox:
    def __init__(self, emit: Callable[[DecoderEvent], None]) -> None:
        self._decoder = Decoder(emit)
        self._silence: asyncio.TimerHandle | None = None

    def push(self, data: bytes) -> None:
        self.close()
        self._decoder.push(data)
        self._silence = asyncio.get_running_loop().call_later(SILENCE_S, self._decoder.idle)

    def close(self) -> None:
        if self._silence:
            self._silence.cancel()

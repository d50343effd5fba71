"""A packet that was cut by a lost port leaves the board waiting for the rest of it, for ever: it would
swallow the stop that comes after the return (S2). Knows which filler ends such a packet with the least effect
(docs/adr/0007); no wire. Twin of shared/src/session/resync.ts.
"""

from servodeck.access.gate import DOWNLOAD, RUN
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.timings import LINE


def filler_for(cut: bytes, filler: int) -> bytes:
    """Nobody knows how much of the packet arrived, so the bytes must be harmless at every place of it. A
    first 00 ends the wait for LEN at once (S1) and makes a move whose count is missing an empty one, where
    the filler would have the board read what earlier packets left behind (S13); but it names slot 0, which a
    run and a download must not get. What arrived of a move before the cut takes effect: no byte can prevent
    that.
    """
    if cut[COMMAND_AT] in (RUN, DOWNLOAD):
        return bytes([filler]) * LINE.filler_bytes
    return bytes([0]) + bytes([filler]) * len(cut)

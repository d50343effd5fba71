"""What a STOP could do, in words. Loads nothing: a bare `servodeck stop` is sent before the command line is
there.
"""

import math
from typing import Any

RESUME = "servodeck resume allows motion again."


def stopped_words(stopped: dict[str, Any]) -> str:
    return f"{held_words(stopped['unheld'])} {RESUME}"


def held_words(unheld: dict[str, Any] | None) -> str:
    if unheld is None:
        return "Stopped."
    if unheld["forMs"] is None:
        return "Stopped, but the board may not have heard it. Switch the robot off if it moves."
    for_s = math.ceil(unheld["forMs"] / 100) / 10
    if unheld["servos"] is None:
        return f"Stopped, but a frame in progress cannot be held: servos may move for up to {for_s} s."
    named = ", ".join(map(str, unheld["servos"]))
    who, it = ("servo", "it") if len(unheld["servos"]) == 1 else ("servos", "they")
    return f"Stopped, but {who} {named} cannot be held: {it} may move for up to {for_s} s."

"""The link without Servodeck: pyserial alone on the same kind of port, one question after the other.

Knows bytes only. Prints the microseconds of each round trip as a JSON list.
Usage: plain_serial.py DEVICE QUESTION_HEX ANSWER_HEX TRIPS PAUSE_MS
"""

import json
import sys
import time

import serial

BAUD = 9600
TIMEOUT_S = 2.0


def main() -> None:
    device, question_hex, answer_hex, trips, pause_ms = sys.argv[1:]
    question, answer = bytes.fromhex(question_hex), bytes.fromhex(answer_hex)
    with serial.Serial(device, BAUD, timeout=TIMEOUT_S) as port:
        json.dump(
            [ask(port, question, answer, float(pause_ms) / 1000) for _ in range(int(trips))], sys.stdout
        )


def ask(port: serial.Serial, question: bytes, answer: bytes, pause_s: float) -> float:
    """Waits, asks, and returns how long the answer took."""
    time.sleep(pause_s)
    asked_ns = time.perf_counter_ns()
    port.write(question)
    heard = port.read(len(answer))
    took_us = (time.perf_counter_ns() - asked_ns) / 1000
    if heard != answer:
        raise SystemExit(f"The board said {heard.hex(' ') or 'nothing'} instead of {answer.hex(' ')}.")
    return took_us


if __name__ == "__main__":
    main()

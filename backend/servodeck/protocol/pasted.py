"""The bytes in what people paste: hex in any usual spelling, and the export of a logic analyser. Knows of
packets only the header, by which hex and decimal columns are told apart.
"""

import csv
import re
from collections.abc import Iterator, Sequence

from servodeck.errors import MalformedError
from servodeck.protocol.decoder import HEADER

TOKEN = re.compile(r"[^\s,;|]+")
# The column of the bytes: Saleae Logic 2 says "data", Logic 1 "Value" or "Decoded Protocol Result".
COLUMNS = ("data", "value", "decoded protocol result")
# Of sigrok, one byte a line: "1200-1290 UART: RX data: 55" of PulseView, "uart-1: 55" of sigrok-cli.
ANNOTATION = re.compile(r"^.*\b(?:uart|rx|tx)\b.*:\s*([0-9A-Fa-f]{2})$", re.IGNORECASE)
HEADERS = bytes((HEADER, HEADER))
LARGEST = 0xFF


def bytes_in(text: str) -> bytes:
    """If bytes are marked by 0x, the rest, such as times, is left out. Raises MalformedError."""
    lines = text.splitlines()
    annotated = [found[1] for line in lines if (found := ANNOTATION.match(line.strip()))]
    if annotated:
        return bytes.fromhex("".join(annotated))
    column = column_of(lines)
    if column is not None and not any(one.lower().startswith("0x") for one in column):
        return bytes_of_column(column)
    tokens = TOKEN.findall(text.replace("\\x", " 0x").replace('"', " "))
    marked = [token[2:].zfill(2) for token in tokens if token[:2].lower() == "0x"]
    return hex_bytes(marked or tokens)


def hex_bytes(tokens: Sequence[str]) -> bytes:
    data = bytearray()
    for token in tokens:
        try:
            data += bytes.fromhex(token)
        except ValueError:
            raise MalformedError(f"{token} is no hex byte. Expected two digits for each byte.") from None
    return bytes(data)


def column_of(lines: Sequence[str]) -> list[str] | None:
    """The cells with the bytes; None where no header names such a column."""
    if not lines:
        return None
    separator = max(",;\t", key=lines[0].count)
    header, *rows = csv.reader(lines, delimiter=separator)
    names = [name.strip().lower() for name in header]
    found = next((names.index(name) for name in COLUMNS if name in names), None)
    if found is None:
        return None
    return [row[found].strip() for row in rows if len(row) > found and row[found].strip()]


def bytes_of_column(cells: Sequence[str]) -> bytes:
    """A column says nothing of its base: it is the one in which a packet begins, else hex."""
    decimal = bytes(decimals(cells))
    if HEADERS in decimal:
        return decimal
    return hex_bytes(cells)


def decimals(cells: Sequence[str]) -> Iterator[int]:
    """Nothing where one of them is no byte in decimal."""
    numbers = [int(cell) for cell in cells if cell.isascii() and cell.isdigit()]
    if len(numbers) == len(cells) and max(numbers, default=0) <= LARGEST:
        yield from numbers

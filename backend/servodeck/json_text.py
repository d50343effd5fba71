"""Looks into large JSON before Python makes objects of it, by SQLite's parser: Python's own keeps every other
thread waiting until it is through (3 MB of empty lists: 0.6 s, in which a stop waits), SQLite's does not.

Knows text, no request and no document. Meant for threads.
"""

import sqlite3
from contextlib import closing


def is_object(text: str) -> bool:
    """Whether it is a JSON object as RFC 8259 has it."""
    if "\0" in text:  # SQLite ends there
        return False
    try:
        # json_type takes no text that json_valid refuses.
        asked = "SELECT json_valid(?1) AND CASE WHEN json_valid(?1) THEN json_type(?1) END = 'object'"
        return bool(answer_to(asked, text))
    except UnicodeEncodeError:
        return False


def has_more_values(text: str, most: int) -> bool:
    """Than that, whatever is in whatever. Raises ValueError where it is no JSON."""
    try:
        return int(answer_to("SELECT count(*) FROM json_tree(?)", text)) > most
    except sqlite3.OperationalError as error:
        raise ValueError(str(error)) from error


def answer_to(question: str, text: str) -> int:
    with closing(sqlite3.connect(":memory:")) as db:
        return int(db.execute(question, (text,)).fetchone()[0] or 0)

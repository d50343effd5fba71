"""How much the tests with many inputs try, and how a failing case names itself. Knows no fault."""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

# Set by hand to repeat one failing case.
ONLY_SEED = os.environ.get("FAULT_SEED")
# `npm run test:all -- --long` sets it for every property, here and in TypeScript.
TIMES = 10 if int(os.environ.get("PROPERTY_RUNS", "0")) > 0 else 1


def seeds(count: int) -> Sequence[int]:
    """`count` of them, ten times that in a long run, or the one asked for."""
    return range(count * TIMES) if ONLY_SEED is None else (int(ONLY_SEED),)


def replay(file: str, seed: int) -> str:
    return f"replay: FAULT_SEED={seed} .venv/bin/python -m pytest backend/tests/{file}"


@contextmanager
def named(file: str, seed: int, what: str) -> Iterator[None]:
    """Puts the way to repeat the case in front of whatever it raises."""
    try:
        yield
    except Exception as error:
        raise AssertionError(f"{what}, seed {seed}\n{replay(file, seed)}\n{error!r}") from error

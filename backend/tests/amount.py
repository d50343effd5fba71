"""How much the tests with many inputs try, and how a failing case names itself. Knows no fault."""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

# Set by hand to repeat one failing case.
ONLY_SEED = os.environ.get("FAULT_SEED")
# What a property tries by default. `npm run test:all -- --long` sets PROPERTY_RUNS to ten times that.
USUAL_RUNS = 100
TIMES = max(1, int(os.environ.get("PROPERTY_RUNS", "0")) // USUAL_RUNS)
IS_EXHAUSTIVE = os.environ.get("EXHAUSTIVE") == "1" or TIMES > 1


def seeds(count: int, sample: int | None = None) -> Sequence[int]:
    """`sample` of them, evenly spread, or all `count`, TIMES as many in a long run, or the one asked for."""
    if ONLY_SEED is not None:
        return (int(ONLY_SEED),)
    return range(0, count * TIMES, 1 if IS_EXHAUSTIVE or sample is None else max(1, count // sample))


def replay(file: str, seed: int) -> str:
    return f"replay: FAULT_SEED={seed} .venv/bin/python -m pytest backend/tests/{file}"


@contextmanager
def named(file: str, seed: int, what: str) -> Iterator[None]:
    """Puts the command that repeats the case in front of any error."""
    try:
        yield
    except Exception as error:
        raise AssertionError(f"{what}, seed {seed}\n{replay(file, seed)}\n{error!r}") from error

"""Values: immutable, equal to those of the same class with the same fields.

`dataclass(frozen=True)` compiles six methods for each class: a fifteenth of the gateway's start for all of
ours. Here it compiles `__init__` alone. The others are shared, and the type checker sees that no field is
assigned to.
"""

from dataclasses import dataclass
from typing import Any, TypeVar, dataclass_transform

T = TypeVar("T")


@dataclass_transform(frozen_default=True)
def value(cls: type[T]) -> type[T]:
    """A dataclass with slots, compared, hashed and shown by its fields in their order."""
    cls.__doc__ = (
        cls.__doc__ or cls.__name__
    )  # without one, dataclass takes long to derive it from the signature
    made: Any = dataclass(slots=True, eq=False, repr=False)(cls)
    made.__eq__, made.__hash__, made.__repr__ = equals, hash_of, shown
    return made  # type: ignore[no-any-return]


def fields_of(one: Any) -> tuple[Any, ...]:
    return tuple(getattr(one, name) for name in one.__match_args__)


def equals(one: Any, other: Any) -> Any:
    return fields_of(one) == fields_of(other) if one.__class__ is other.__class__ else NotImplemented


def hash_of(one: Any) -> int:
    return hash(fields_of(one))


def shown(one: Any) -> str:
    fields = ", ".join(f"{name}={getattr(one, name)!r}" for name in one.__match_args__)
    return f"{one.__class__.__qualname__}({fields})"

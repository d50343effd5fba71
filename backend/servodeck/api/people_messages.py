"""What pages and the entrance say to each other over HTTP, as strict models.

The only description of it: `python -m servodeck.api.people_messages` prints the JSON
schema from which the page's types are generated. Knows no secret's making and no route.
"""

import json
import sys
from typing import Annotated, Literal

from pydantic import Field

from servodeck.access.addresses import Mode
from servodeck.access.devices import Kind
from servodeck.callers import Role
from servodeck.schema import Message, schema_of

PersonRole = Literal["viewer", "driver", "owner"]
Name = Annotated[str, Field(max_length=64, pattern=r"^[^\x00-\x1f\x7f]*$")]
GivenName = Annotated[str, Field(max_length=64, pattern=r"^[^\s\x00-\x1f\x7f][^\x00-\x1f\x7f]*$")]


class You(Message):
    id: str
    name: str
    role: Role


class Me(Message):
    """`you` is null for a stranger. `overheard`: what is said here can be read by others on the network."""

    mode: Mode
    overheard: bool
    you: You | None


class PairWish(Message):
    """One of the three: the secret of a link, the digits of a code, or a stop-only link."""

    secret: Annotated[str | None, Field(max_length=200)] = None
    code: Annotated[str | None, Field(pattern=r"^[0-9]{8}$")] = None
    stop: Annotated[str | None, Field(max_length=200)] = None
    name: Name = ""


class OwnName(Message):
    name: GivenName


class Person(Message):
    """A paired device, a script's token or a stop-only link. `here`: it has the page open now,
    and `drives` where it moves the robot. `unattendedSlot`: of the group that runs on without it.
    """

    id: str
    kind: Kind
    name: str
    role: Role
    paired_at_ms: int
    last_seen_ms: int | None
    here: bool
    drives: bool
    unattended_slot: int | None


class People(Message):
    """`openCodes`: the invitations whose digits still count; five wrong ones end that, not their links."""

    people: list[Person]
    open_invites: list[str]
    open_codes: list[str]


class PersonChange(Message):
    name: GivenName | None = None
    role: PersonRole | None = None


class InviteWish(Message):
    role: PersonRole
    name: Name = ""


class Invitation(Message):
    """`picture` is the link as a QR code: the address of an SVG image that holds itself."""

    id: str
    link: str
    code: str | None
    picture: str
    expires_in_ms: int


class TokenWish(Message):
    name: GivenName
    role: PersonRole


class Token(Message):
    """Shown once: only its SHA-256 is kept."""

    id: str
    token: str


class StopLinkWish(Message):
    name: GivenName


class StopLink(Message):
    id: str
    link: str
    picture: str


if __name__ == "__main__":
    said = {"PeopleRequest": PairWish | OwnName | PersonChange | InviteWish | TokenWish | StopLinkWish}
    answered = {"PeopleAnswer": Me | You | People | Person | Invitation | Token | StopLink}
    json.dump(schema_of("PeopleMessage", said, answered), sys.stdout, indent=2)
    sys.stdout.write("\n")

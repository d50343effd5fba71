"""Pairing over HTTP: the identity of the caller, pairing, and for owners the list of devices.

Decides no role and makes no secret. A change takes effect at once and is stored before the answer.

"""

import contextlib
from typing import Annotated, Literal

from fastapi import Depends, Query, Request, Response
from pydantic import Field
from starlette.requests import HTTPConnection

from servodeck.access.addresses import Mode, link_base, pair_link, picture_of, stop_link
from servodeck.access.devices import Device, Devices, Kind
from servodeck.access.entrance import Entrance
from servodeck.access.expiry import Expiry
from servodeck.api.motion import Scripted
from servodeck.api.routes import (
    OWNER,
    PUBLIC,
    VIEWER,
    Audited,
    Controlled,
    Note,
    entrance_of,
    leaves,
    routes,
)
from servodeck.callers import Caller, Role
from servodeck.errors import ForbiddenError, MalformedError, PairingError, StorageError
from servodeck.robot.control import Control
from servodeck.robot.hub import is_of
from servodeck.schema import Message

MAX_TOKEN_DAYS = 3650
MS_PER_DAY = 24 * 3600 * 1000
Page = Literal["robot", "fleet"]
PersonRole = Literal["viewer", "driver", "owner"]
Name = Annotated[str, Field(max_length=64, pattern=r"^[^\x00-\x1f\x7f]*$")]
GivenName = Annotated[str, Field(max_length=64, pattern=r"^[^\s\x00-\x1f\x7f][^\x00-\x1f\x7f]*$")]


class You(Message):
    id: str
    name: str
    role: Role


class Me(Message):
    """`you` is null for an unauthenticated caller. `overheard`: others on the network can read the traffic.
    `pages`: what this gateway has for the caller: a robot of its own, a fleet.
    """

    mode: Mode
    overheard: bool
    you: You | None
    pages: list[Page]


class PairWish(Message):
    """One of the three: the secret of a link, the digits of a code, or a stop-only link."""

    secret: Annotated[str | None, Field(max_length=200)] = None
    code: Annotated[str | None, Field(pattern=r"^[0-9]{8}$")] = None
    stop: Annotated[str | None, Field(max_length=200)] = None
    name: Name = ""


class OwnName(Message):
    name: GivenName


class Person(Message):
    """A paired device, a script's token or a stop-only link. `here`: it has the page open now; `drives`: it
    has the lease. `unattendedSlot`: of its group that runs unattended. `expiresInMs`: 0 where it has
    expired; null where it is valid until it is revoked.

    """

    id: str
    kind: Kind
    name: str
    role: Role
    paired_at_ms: int
    last_seen_ms: int | None
    expires_in_ms: int | None
    here: bool
    drives: bool
    unattended_slot: int | None


class People(Message):
    """`openCodes`: the invitations whose digits are still valid; five wrong codes void the digits, not the
    links.
    """

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
    """`picture` is the link as a QR code: an SVG image as a data address."""

    id: str
    link: str
    code: str | None
    picture: str
    expires_in_ms: int


class TokenWish(Message):
    """`expiresInDays`: from now, of 24 hours each; without it the token is valid until it is revoked."""

    name: GivenName
    role: PersonRole
    expires_in_days: Annotated[int | None, Field(ge=1, le=MAX_TOKEN_DAYS)] = None


class Token(Message):
    """Shown once: only its SHA-256 is stored."""

    id: str
    token: str


class StopLinkWish(Message):
    name: GivenName


class StopLink(Message):
    id: str
    link: str
    picture: str


# As long as browsers keep one: a device stays until it is revoked.
COOKIE_S = 400 * 24 * 3600

Continues = Annotated[
    bool, Query(description="Whether a group that it let continue without it may continue.")
]
Entered = Annotated[Entrance, Depends(entrance_of)]
people_api = routes("/api", "people")


async def base_of(connection: HTTPConnection) -> str:
    return link_base(connection.app.state.entrance.access, connection.headers["host"])


async def expiry_of(connection: HTTPConnection) -> Expiry:
    expiry = connection.app.state.expiry
    assert isinstance(expiry, Expiry)
    return expiry


Base = Annotated[str, Depends(base_of)]
Expiring = Annotated[Expiry, Depends(expiry_of)]


@people_api.get("/me")
async def me(request: Request, entrance: Entered, caller: Annotated[Caller | None, PUBLIC]) -> Me:
    """The caller as this gateway knows it."""
    access = entrance.access
    return Me(
        mode=access.mode,
        overheard=access.needs_pairing and not access.is_secure,
        you=you_of(caller) if caller else None,
        pages=pages_for(caller, request),
    )


def pages_for(caller: Caller | None, request: Request) -> list[Page]:
    if caller is None or not caller.may("viewer"):
        return []
    control: Control = request.app.state.control
    has: dict[Page, bool] = {
        "robot": control.board.port.device is not None,
        "fleet": request.app.state.fleet is not None,
    }
    return [page for page in has if has[page]]


async def saved(entrance: Entrance, note: Note) -> None:
    """The change stands in memory, and its act is noted, also where the file cannot be written."""
    note.has_taken_effect = True
    await entrance.devices.save()


async def called_by_browser(request: Request) -> None:
    if "origin" not in request.headers:
        raise ForbiddenError("Only a page can pair, and it must send a name. Programs use a token.")


def you_of(caller: Caller) -> You:
    return You(id=caller.id, name=caller.name, role=caller.role)


@people_api.patch("/me", dependencies=[Depends(called_by_browser)])
async def rename_me(
    wanted: OwnName,
    entrance: Entered,
    control: Controlled,
    caller: Annotated[Caller, VIEWER],
    note: Annotated[Note, leaves("renamed")],
) -> You:
    """Changes the name of the caller; a number is added where the name is taken."""
    changed = entrance.devices.change(caller.id, wanted.name, None)
    note.whom = changed.name
    spread_name(changed, control)
    await saved(entrance, note)
    return you_of(changed.caller)


def spread_name(device: Device, control: Control) -> None:
    """Nothing ends by it: a driver continues under the new name."""
    control.hub.rename(device.id, device.name)
    control.driving.send_states()


@people_api.post("/pair", dependencies=[Depends(called_by_browser)])
async def pair(
    wish: PairWish,
    response: Response,
    entrance: Entered,
    present: Annotated[Caller | None, PUBLIC],
    scripts: Scripted,
    audit: Audited,
    note: Annotated[Note, leaves("paired")],
) -> You:
    """Pairs by a link, a code or a stop-only link, and sets a cookie; a device with at least that role keeps
    its own.
    """
    try:
        caller, credential = accept_invite(wish, entrance, present)
    except PairingError:
        audit.note("pairRefused", present.name if present else None)
        raise
    note.who, note.about = caller.name, caller.role
    if credential is None:
        note.act = None  # it keeps what it has
    if present and not entrance.still_lets_in(present):
        reason = "This device was paired again."
        await scripts.disconnect(present.id, reason, caller.name, run_continues=True)
    if credential:
        access = entrance.access
        response.set_cookie(
            access.cookie,
            credential,
            max_age=COOKIE_S,
            path="/",
            secure=access.is_secure,
            httponly=True,
            samesite="strict",
        )
        with contextlib.suppress(StorageError):  # a full disk does not undo it; until the next start it holds
            await entrance.devices.save()
    return you_of(caller)


def accept_invite(wish: PairWish, entrance: Entrance, present: Caller | None) -> tuple[Caller, str | None]:
    if wish.stop is not None:
        device = entrance.stop_link(wish.stop)
        return (present, None) if present else (device.caller, wish.stop)
    if wish.secret is not None:
        return entrance.accept_invite(entrance.pairing.find_by_link(wish.secret), wish.name, present)
    if wish.code is not None:
        return entrance.accept_invite(entrance.pairing.find_by_code(wish.code), wish.name, present)
    raise MalformedError("Pairing needs the secret of a link, a code or a stop-only link.")


@people_api.get("/people", dependencies=[OWNER])
async def people(entrance: Entered, control: Controlled) -> People:
    """All devices, tokens and links, and the open invitations."""
    return People(
        people=[person_of(one, entrance.devices, control) for one in entrance.devices.all],
        open_invites=[invite.id for invite in entrance.pairing.open],
        open_codes=[invite.id for invite in entrance.pairing.open if invite.code],
    )


def person_of(device: Device, devices: Devices, control: Control) -> Person:
    driver, unattended = control.driving.driver, control.board.unattended
    own = unattended.snapshot() if is_of(unattended.by, device.id) else None
    return Person(
        id=device.id,
        kind=device.kind,
        name=device.name,
        role=device.role,
        paired_at_ms=device.paired_at_ms,
        last_seen_ms=device.last_seen_ms,
        expires_in_ms=devices.expires_in_ms(device),
        here=control.hub.holds(device.id),
        drives=is_of(driver, device.id),
        unattended_slot=own.slot if own else None,
    )


@people_api.patch("/people/{person}")
async def change(
    person: str,
    wanted: PersonChange,
    entrance: Entered,
    control: Controlled,
    scripts: Scripted,
    by: Annotated[Caller, OWNER],
    note: Annotated[Note, leaves("roleChanged")],
) -> Person:
    """Changes name or role. Connections under the old role are closed and may be opened again; if the new
    role may not drive, an unattended group is stopped and a download ends.

    """
    before = entrance.devices.get(person)
    changed = entrance.devices.change(person, wanted.name, wanted.role)
    note.whom = before.name
    if changed.role == before.role:
        note.act, note.about = "renamed", changed.name
        spread_name(changed, control)
    else:
        note.about = changed.role
        reason, still_drives = "Your role is another one now.", changed.caller.may("driver")
        await scripts.disconnect(person, reason, by.name, still_drives=still_drives)
    await saved(entrance, note)
    return person_of(changed, entrance.devices, control)


@people_api.delete("/people/{person}", status_code=204)
async def revoke(
    person: str,
    entrance: Entered,
    scripts: Scripted,
    by: Annotated[Caller, OWNER],
    note: Annotated[Note, leaves("revoked")],
    continues: Continues = False,
) -> None:
    """Revokes it: its connections are closed at once, its motion is stopped, and none of its commands leaves
    the gateway after the answer.

    """
    note.whom = entrance.devices.get(person).name
    entrance.devices.revoke(person)
    reason = "This device is not paired any more."
    await scripts.disconnect(person, reason, by.name, run_continues=continues)
    await saved(entrance, note)


@people_api.post("/invites", dependencies=[OWNER])
async def invite(
    wish: InviteWish, entrance: Entered, base: Base, note: Annotated[Note, leaves("invited")]
) -> Invitation:
    """A link and a code for one device, for two minutes."""
    note.whom, note.about = wish.name, wish.role
    made = entrance.pairing.invite(wish.role, wish.name)
    link = pair_link(base, made.secret)
    expires_in_ms = round(entrance.pairing.seconds_left(made) * 1000)
    return Invitation(
        id=made.id, link=link, code=made.code, picture=picture_of(link), expires_in_ms=expires_in_ms
    )


@people_api.delete("/invites/{invitation}", status_code=204, dependencies=[OWNER, leaves("withdrew")])
async def withdraw(invitation: str, entrance: Entered) -> None:
    """Ends an invitation that was not used."""
    entrance.pairing.withdraw(invitation)


@people_api.post("/tokens", dependencies=[OWNER])
async def make_token(
    wish: TokenWish, entrance: Entered, expiry: Expiring, note: Annotated[Note, leaves("tokenMade")]
) -> Token:
    """A token for a script: `Authorization: Bearer TOKEN`. When it expires, its connections and its motion
    end as with a revocation; it stays in the list until an owner revokes it.
    """
    valid_ms = None if wish.expires_in_days is None else wish.expires_in_days * MS_PER_DAY
    device, token = entrance.devices.admit("token", wish.name, wish.role, valid_ms)
    note.whom, note.about = device.name, device.role
    expiry.plan()
    await saved(entrance, note)
    return Token(id=device.id, token=token)


@people_api.post("/stop-links", dependencies=[OWNER])
async def make_stop_link(
    wish: StopLinkWish, entrance: Entered, base: Base, note: Annotated[Note, leaves("stopLinkMade")]
) -> StopLink:
    """A link that can stop the robot and do nothing else, for a sticker; valid until it is revoked."""
    device, credential = entrance.devices.admit("stopLink", wish.name, "stopper")
    note.whom = device.name
    await saved(entrance, note)
    link = stop_link(base, credential)
    return StopLink(id=device.id, link=link, picture=picture_of(link))

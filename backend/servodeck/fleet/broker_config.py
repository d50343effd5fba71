"""A configuration of Mosquitto for a site: who may write which topics, passwords, and limits (ADR 48).

Writes files of one folder; starts and asks no broker. Passwords are hashed by Mosquitto's own program.
"""

import secrets
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from servodeck.callers import RANKS, Role
from servodeck.fleet.home_assistant import USER as HOME_ASSISTANT
from servodeck.fleet.home_assistant import config_topic, is_prefix
from servodeck.fleet.rules import DOWNLOAD_BYTES
from servodeck.fleet.topics import ALL, REPLY, ROOT, is_gateway_name, is_name
from servodeck.value import value

HASHING = "mosquitto_passwd"
# With 100 a storm of messages made it drop `online` of some; with these none of 1,000 gateways.
QUEUED_MESSAGES = 1000
TOPIC_BYTES = 4096


@value
class Listener:
    """`host` 127.0.0.1 for this computer alone."""

    port: int
    host: str = "0.0.0.0"


@value
class Encryption:
    """Files in PEM. With `clients_ca` each client needs a certificate of it, too."""

    certificate: Path
    key: Path
    clients_ca: Path | None = None


@value
class Plan:
    """`users` by name; gateways are users, too. `websocket`: a second listener, for browsers.
    `home_assistant`: the prefix below which that finds devices; empty: it has no user.
    """

    site: str
    gateways: Sequence[str]
    users: Mapping[str, Role]
    listener: Listener
    websocket: Listener | None = None
    encryption: Encryption | None = None
    home_assistant: str = ""

    def names(self) -> list[str]:
        """Of all that have a password."""
        return [*self.gateways, *self.users, *([HOME_ASSISTANT] if self.home_assistant else ())]

    def check(self) -> None:
        """Raises ValueError."""
        if self.home_assistant and not is_prefix(self.home_assistant):
            raise ValueError(f"{self.home_assistant} is no prefix of topics")
        for name in self.gateways:
            if not is_gateway_name(name):
                raise ValueError(f"a gateway cannot be called {name}")
        for name in (self.site, *self.users):
            if not is_name(name):
                raise ValueError(f"{name} is no name: letters, digits and . _ @ - are allowed")
        if twice := {name for name in self.names() if self.names().count(name) > 1}:
            raise ValueError(f"{', '.join(sorted(twice))}: gateways and users need different names")


def write_config(plan: Plan, folder: Path) -> None:
    """`mosquitto.conf`, `acl`, `passwords`, and a file with the password of each in `secrets`; passwords that
    are there stay. Raises ValueError, or OSError, also where Mosquitto is not installed.
    """
    plan.check()
    program = shutil.which(HASHING)
    if program is None:
        raise FileNotFoundError(2, f"{HASHING} is not installed; it comes with Mosquitto", HASHING)
    secret_of = passwords_of(plan, folder)
    plain = folder / "passwords.new"
    private(plain, "".join(f"{name}:{secret}\n" for name, secret in secret_of.items()))
    subprocess.run([program, "-U", str(plain)], check=True, capture_output=True)
    plain.replace(folder / "passwords")
    (folder / "acl").write_text(acl(plan), "utf-8")
    (folder / "mosquitto.conf").write_text(configuration(plan, folder.resolve()), "utf-8")


def passwords_of(plan: Plan, folder: Path) -> dict[str, str]:
    """By name; made where there is none."""
    return {name: password_in(folder / "secrets" / name) for name in plan.names()}


def password_in(file: Path) -> str:
    try:
        return file.read_text("utf-8").strip()
    except FileNotFoundError:
        secret = secrets.token_urlsafe(24)
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        private(file, secret + "\n")
        return secret


def private(file: Path, text: str) -> None:
    """For its owner alone, from the first moment."""
    file.unlink(missing_ok=True)
    file.touch(0o600)
    file.write_text(text, "utf-8")


@value
class Rights:
    """The topics that a user may write and read."""

    user: str
    written: Sequence[str]
    read: Sequence[str]


def rights_of(plan: Plan) -> list[Rights]:
    found = [gateway_rights(plan, name) for name in plan.gateways]
    found += [user_rights(plan.site, name, role) for name, role in plan.users.items()]
    if plan.home_assistant:
        found.append(home_assistant_rights(plan.site, plan.home_assistant))
    return found


def gateway_rights(plan: Plan, name: str) -> Rights:
    """Its own topics, requests to it, and answers. Its own state comes back: so it knows that it is heard."""
    site, own = plan.site, f"{ROOT}/{plan.site}/{name}"
    announced = [config_topic(plan.home_assistant, site, name)] if plan.home_assistant else []
    written = [f"{own}/{kind}" for kind in ("about", "state", "online", "live")]
    read = [f"{own}/state", f"{own}/online", f"{own}/do/#", f"{ROOT}/{site}/{ALL}/#"]
    return Rights(name, [*written, *announced, f"{ROOT}/{site}/{REPLY}/#"], read)


def user_rights(site: str, name: str, role: Role) -> Rights:
    """Requests in their own name and role, and the answers to them. Who may resume withdraws all holds. An
    owner sees how the broker is.
    """
    base = f"{ROOT}/{site}"
    holds = f"{base}/{ALL}/hold/+/+"
    own_hold = holds if RANKS[role] >= RANKS["driver"] else f"{base}/{ALL}/hold/{role}/{name}"
    read = [f"{base}/+/{kind}" for kind in ("about", "state", "online", "live")]
    figures = ["$SYS/#"] if role == "owner" else []
    written = [f"{base}/+/do/{role}/{name}/+", own_hold]
    return Rights(name, written, [*read, holds, f"{base}/{REPLY}/{name}/#", *figures])


def home_assistant_rights(site: str, prefix: str) -> Rights:
    """Less than a driver's: to stop, and to press buttons."""
    base = f"{ROOT}/{site}/+"
    written = [f"{base}/do/driver/{HOME_ASSISTANT}/{verb}" for verb in ("stop", "press")]
    read = [f"{base}/{kind}" for kind in ("about", "state", "online")]
    return Rights(HOME_ASSISTANT, [*written, f"{prefix}/status"], [*read, f"{prefix}/#"])


def acl(plan: Plan) -> str:
    return "\n".join(map(block_of, rights_of(plan)))


def block_of(rights: Rights) -> str:
    lines = [f"user {rights.user}", *(f"topic write {topic}" for topic in rights.written)]
    return "\n".join([*lines, *(f"topic read {topic}" for topic in rights.read)]) + "\n"


def configuration(plan: Plan, folder: Path) -> str:
    lines = [
        "per_listener_settings false",
        "allow_anonymous false",
        f"password_file {folder / 'passwords'}",
        f"acl_file {folder / 'acl'}",
        "persistence false",
        f"max_packet_size {DOWNLOAD_BYTES + TOPIC_BYTES}",
        f"max_queued_messages {QUEUED_MESSAGES}",
        "max_keepalive 60",
        # Otherwise an answer behind an acknowledgement comes 40 ms later.
        "set_tcp_nodelay true",
        "log_dest stderr",
        *listener_lines(plan.listener, plan.encryption),
    ]
    if plan.websocket:
        lines += listener_lines(plan.websocket, plan.encryption)
        # Without a family of addresses it would listen on every interface, whatever its host.
        lines += ["protocol websockets", "socket_domain ipv4"]
    return "\n".join(lines) + "\n"


def listener_lines(listener: Listener, encryption: Encryption | None) -> list[str]:
    lines = [f"listener {listener.port} {listener.host}"]
    if encryption:
        lines += [f"certfile {encryption.certificate.resolve()}", f"keyfile {encryption.key.resolve()}"]
        if encryption.clients_ca:
            lines += [f"cafile {encryption.clients_ca.resolve()}", "require_certificate true"]
    return lines

"""What the terminal says of who may come in: addresses, the first owner's link, and who can listen in.

Knows words and the entrance; prints nothing itself.
"""

from servodeck.access.addresses import Access, drawn_for_terminal, pair_link
from servodeck.access.devices import is_owners
from servodeck.access.entrance import Entrance

OVERHEARD = (
    "Others on this network can read plain http and could take the place of a paired device. On a network\n"
    "that is not yours use Tailscale or an SSH tunnel, or put Caddy with https in front of it\n"
    "and start with --public-url."
)


def greeting(entrance: Entrance, urls: list[str], *, invites: bool, only_here: str = "") -> str:
    """`urls` are the addresses for others, the best first; `invites` one more owner where there is one.

    `only_here` is what to listen on instead, where nobody else reaches it.
    """
    lines = [reached_at(urls, only_here)]
    if invites or needs_owner(entrance):
        lines += invitation(entrance, urls)
    if not entrance.access.is_secure:
        lines.append(OVERHEARD)
    return "\n".join(lines)


def reached_at(urls: list[str], only_here: str) -> str:
    if only_here:
        return f"Only this computer can reach it. For other devices use --listen {only_here}."
    return f"Other devices reach it at {' or '.join(urls)}"


def needs_owner(entrance: Entrance) -> bool:
    return not any(is_owners(one) for one in entrance.devices.all)


def invitation(entrance: Entrance, urls: list[str]) -> list[str]:
    invite = entrance.pairing.invite("owner", "")
    code = invite.code or ""
    begin = f"Within two minutes, type {code[:4]} {code[4:]} there, or open"
    link = pair_link(urls[0], invite.secret)
    return ["To pair as its owner:", f"{begin} {link}", drawn_for_terminal(link)]


def urls_for_others(access: Access, addresses: list[str], own_url: str) -> list[str]:
    if access.mode == "proxy":
        return [access.url_of(name) for name in access.names]
    return [access.url_of(address) for address in addresses] or [own_url]

"""The command that sends a test notification, and the receivers from the options of `servodeck serve`. Ends
with an explanation that repeats no address, because addresses may hold secrets.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from servodeck.cli.options import FAILURE, USAGE, commands_of, fail

if TYPE_CHECKING:
    from servodeck.notify.receivers import Receiver


def receivers(addresses: Sequence[str], file: Path | None) -> "list[Receiver]":
    from servodeck.notify.receivers import receivers_from

    try:
        return receivers_from(addresses, file)
    except OSError as error:
        fail(f"--notify-file {file} cannot be read: {error.strerror}.", USAGE)
    except ValueError as error:
        fail(f"A receiver of notifications is not valid: {error}.", USAGE)


def notify_test(context: typer.Context) -> None:
    """Send a test notification to each receiver that `serve` would use with the same options."""
    from servodeck.notify.conditions import Due
    from servodeck.notify.notifications import notice_of
    from servodeck.notify.sender import Sender

    with commands_of(context)["serve"].make_context("serve", context.args, parent=context.parent) as made:
        found = receivers(made.params["notify"], made.params["notify_file"])
    if not found:
        fail("No receiver: give one by --notify-file FILE, --notify URL or SERVODECK_NOTIFY.", USAGE)
    notice = notice_of(Due("test", "Notifications of this robot arrive here."))
    outcomes = [Sender(receiver, pauses_s=()).deliver(notice) for receiver in found]
    for receiver, outcome in zip(found, outcomes, strict=True):
        print(f"{receiver.kind} at {receiver.host}: {outcome.detail or 'sent'}")
    if any(outcome.status != "sent" for outcome in outcomes):
        raise typer.Exit(FAILURE)

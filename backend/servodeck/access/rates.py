"""How fast each paired device and each token may ask over HTTP (docs/adr/0013).

Knows who asks and the time; no request. This computer's own page and scripts share one name and are never
counted: a script that runs away would shut the page out.
"""

from collections.abc import Callable

from servodeck.access.devices import MAX_DEVICES, Device
from servodeck.access.intake import Rate
from servodeck.callers import Role
from servodeck.errors import TooManyError

# Requests a second, and at once after a rest.
OF_DRIVERS, OF_VIEWERS = (30.0, 60), (2.0, 10)
# A page that opens reads each robot of the library at once: 57 requests were counted with 50 of them.
PAGE_BURST = 200


class Rates:
    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._rates: dict[tuple[str, Role], Rate] = {}

    def take(self, device: Device) -> None:
        """One more request of theirs. Raises TooManyError."""
        rate = self._rate_of(device)
        if not rate.take():
            raise TooManyError(
                f"{device.name} asks too often: come again in {rate.wait_s:.1f} s.", rate.wait_s
            )

    def _rate_of(self, device: Device) -> Rate:
        key = device.id, device.role
        if key not in self._rates:
            if len(self._rates) >= 2 * MAX_DEVICES:  # whoever was revoked meanwhile
                del self._rates[next(iter(self._rates))]
            per_second, burst = OF_DRIVERS if device.caller.may("driver") else OF_VIEWERS
            is_page = device.kind == "device"
            self._rates[key] = Rate(per_second, PAGE_BURST if is_page else burst, self._now)
        return self._rates[key]

"""Bluetooth modules of the boards: finds one, opens it as a port, says in a sentence why it cannot be had.

The only module that imports bleak, which is an extra, and only once a module is requested. bleak runs on an
event loop of its own in a thread, so that what it hears of a whole room never delays the gateway. Knows no
packet.
"""

import asyncio
import contextlib
import queue
import threading
from collections.abc import Awaitable, Callable, Coroutine, Iterable, Sequence
from concurrent.futures import Future
from functools import cache
from typing import TYPE_CHECKING, Any, Final, Protocol, TypeVar

from servodeck.errors import (
    OtherDeviceError,
    PortBusyError,
    PortDeniedError,
    PortError,
    PortLostError,
    PortMissingError,
)
from servodeck.port.ports import READ_WAIT_S, PortInfo
from servodeck.port.reader import Gathered
from servodeck.port.whereabouts import BLUETOOTH
from servodeck.protocol import load_shared
from servodeck.protocol.decoder import LONGEST_PACKET
from servodeck.protocol.families import Withheld
from servodeck.protocol.timings import wire_s

if TYPE_CHECKING:
    from bleak import BleakClient
    from bleak.backends.characteristic import BleakGATTCharacteristic
    from bleak.backends.device import BLEDevice
    from bleak.backends.scanner import AdvertisementData

FIND_S = 5.0
# Robots of one class often bear one name: so long is listened for another one after the first.
NAMESAKES_S = 1.0

_MODULE: Final = load_shared("bluetooth")
SERVICES: Final = [f"0000{short}-0000-1000-8000-00805f9b34fb" for short in _MODULE["services"]]
NAMES: Final = tuple(_MODULE["names"])
CHUNK_BYTES: Final[int] = _MODULE["chunkBytes"]
GATHER_S: Final = _MODULE["gatherMs"] / 1000
CONNECT_S: Final = _MODULE["connectTimeoutMs"] / 1000
WRITE_S: Final = _MODULE["writeTimeoutMs"] / 1000
DRAIN_S: Final = _MODULE["drainMs"] / 1000

INSTALL = (
    "Bluetooth needs one more package: pip install 'servodeck[ble]', "
    "or for a Servodeck of pipx: pipx inject servodeck bleak."
)
NOT_RUNNING = (
    "Bluetooth is not running on this computer. On Linux: sudo apt install bluez, "
    "then sudo systemctl start bluetooth."
)
SWITCHED_OFF = (
    "Bluetooth is switched off on this computer. Switch it on in the system's settings; "
    "on Linux: bluetoothctl power on."
)
NO_ADAPTER = (
    "This computer has no Bluetooth adapter that can connect to the module. "
    "A USB one needs Bluetooth 4.0 or newer."
)
DENIED = (
    "This account may not use Bluetooth. On Linux: sudo usermod -aG bluetooth $USER, then log in again; "
    "on macOS allow it under Privacy & Security, Bluetooth."
)

T = TypeVar("T")


class Characteristic(Protocol):
    """What is looked at of one to choose it."""

    @property
    def uuid(self) -> str: ...

    @property
    def properties(self) -> Sequence[str]: ...


C = TypeVar("C", bound=Characteristic)


def choose(characteristics: Iterable[C]) -> tuple[C, C] | None:
    """Where the board is heard and where it is written to: by what each can do, because modules differ."""
    found = list(characteristics)

    def first(shorts: list[str], *wanted: str) -> C | None:
        able = [one for one in found if any(name in one.properties for name in wanted)]
        return next((one for short in shorts for one in able if short_of(one.uuid) == short), None)

    notifies = first(_MODULE["notifies"], "notify")
    takes = first(_MODULE["takes"], "write-without-response", "write")
    return (notifies, takes) if notifies and takes else None


def short_of(uuid: str) -> str:
    """The four digits of a UUID of the Bluetooth base."""
    return uuid[4:8].lower()


class Bluetooth:
    """This computer's adapter. Every call but those of an open port may block for seconds."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        # The system connects to one module at a time, and one that is being left cannot be had yet.
        self._changing = asyncio.Lock()
        self._addresses: dict[str, str] = {}
        threading.Thread(target=self._loop.run_forever, name="bluetooth", daemon=True).start()

    def open(self, device: str) -> "BluetoothPort":
        """`ble:ADDRESS` or `ble:NAME`. A name stands for the module that was found by it first. Raises a
        PortError with a sentence.
        """
        name = device[len(BLUETOOTH) :]
        if not name:
            raise PortMissingError(
                "Name the module: ble:ADDRESS or ble:NAME. servodeck ports --bluetooth lists them."
            )
        return self._run(device, self._open(device, name))

    def scan(self, seconds: float = FIND_S) -> list[PortInfo]:
        """The modules that are heard in that time, the strongest first. Raises a PortError."""
        return self._run("Bluetooth", self._scan(seconds))

    def _run(self, device: str, work: Coroutine[Any, Any, T]) -> T:
        try:
            import bleak  # noqa: F401 (whether it is there)
        except ImportError as error:
            work.close()
            raise PortMissingError(INSTALL) from error
        try:
            return self.submit(work).result()
        except PortError:
            raise
        except Exception as error:
            raise explain(device, error) from error

    def submit(self, work: Coroutine[Any, Any, T]) -> Future[T]:
        return asyncio.run_coroutine_threadsafe(work, self._loop)

    async def _open(self, device: str, name: str) -> "BluetoothPort":
        from bleak import BleakClient

        async with self._changing:
            found = await self._find(device, name)
            port = BluetoothPort(device, self)
            client = BleakClient(found, lambda _: port.lose(), SERVICES, timeout=CONNECT_S)
            await client.connect()
            try:
                await port.begin(client)
            except BaseException:
                await client.disconnect()
                raise
            return port

    async def close(self, client: "BleakClient") -> None:
        """What was written last gets its time to leave."""
        async with self._changing:
            await asyncio.sleep(DRAIN_S)
            await client.disconnect()

    async def _find(self, device: str, name: str) -> "BLEDevice":
        from bleak import BleakAdapter, BleakScanner

        address = self._addresses.get(name)
        found: dict[str, BLEDevice] = {}
        heard = asyncio.Event()

        def note(one: "BLEDevice", _advertisement: "AdvertisementData | None" = None) -> None:
            names = (one.address,) if address else (one.address, one.name or "")
            if (address or name).upper() in (known.upper() for known in names):
                found[one.address] = one
                heard.set()

        # A gateway that was killed leaves its module connected, and then it does not advertise itself.
        adapter = await BleakAdapter.get()
        for one in await adapter.get_connected_devices(SERVICES):
            note(one)
        if not found:
            async with BleakScanner(note):
                with contextlib.suppress(TimeoutError):
                    async with asyncio.timeout(FIND_S):
                        await heard.wait()
                if found and not address and name.upper() not in (one.upper() for one in found):
                    await asyncio.sleep(NAMESAKES_S)
        if not found:
            known = f" ({address})" if address and address.upper() != name.upper() else ""
            raise PortMissingError(
                f"No Bluetooth module answers to {device}{known}. Is the robot switched on and near? "
                "A module has one connection at a time: end that of a phone's app or of another computer. "
                "It is not paired in the system's settings."
            )
        if len(found) > 1:
            choice = " or ".join(f"{BLUETOOTH}{one}" for one in sorted(found))
            raise OtherDeviceError(f"Several modules are called {name}. Choose one by its address: {choice}.")
        (only,) = found.values()
        self._addresses[name] = only.address
        return only

    async def _scan(self, seconds: float) -> list[PortInfo]:
        from bleak import BleakScanner

        heard = (await BleakScanner.discover(timeout=seconds, return_adv=True)).values()
        named = [(advertisement.rssi, one) for one, advertisement in heard if is_module(one, advertisement)]
        return [
            PortInfo(f"{BLUETOOTH}{one.address}", f"{one.name or 'without a name'}, Bluetooth", likely=True)
            for _, one in sorted(named, key=lambda pair: -pair[0])
        ]


@cache
def this_computer() -> Bluetooth:
    """The one for the whole program, from the first call on."""
    return Bluetooth()


def is_module(device: "BLEDevice", advertisement: "AdvertisementData") -> bool:
    return (device.name or "").startswith(NAMES) or not set(SERVICES).isdisjoint(advertisement.service_uuids)


class BluetoothPort:
    """One connected module, with the face of a serial port. Every failure of it is a PortLostError."""

    longest_packet = LONGEST_PACKET
    shortest_s = 0.0
    in_reports = False
    withheld: frozenset[Withheld] = frozenset()

    def __init__(self, device: str, bluetooth: Bluetooth) -> None:
        self._device = device
        self._bluetooth = bluetooth
        self._inbox: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._gathered = Gathered(self._inbox.put, CHUNK_BYTES, GATHER_S)
        self._client: BleakClient | None = None
        self._takes: BleakGATTCharacteristic | None = None

    async def begin(self, client: "BleakClient") -> None:
        """From here on the module is heard and can be written to."""
        chosen = choose(one for service in client.services for one in service.characteristics)
        if chosen is None:
            raise PortMissingError(
                f"{self._device} is another kind of Bluetooth device: it has no serial service."
            )
        notifies, takes = chosen
        await client.start_notify(notifies, lambda _, data: self.receive(bytes(data)))
        self._client, self._takes = client, takes

    def receive(self, data: bytes) -> None:
        self._gathered.add(data)

    def lose(self) -> None:
        self._inbox.put(None)

    def fileno(self) -> int | None:
        return None

    def read(self) -> bytes:
        try:
            data = self._inbox.get(timeout=READ_WAIT_S)
        except queue.Empty:
            return b""
        if data is None:
            self.lose()  # for the next call
            raise self._lost()
        return data

    def read_now(self) -> bytes:
        return self.read()

    def write(self, data: bytes) -> asyncio.Future[None]:
        """Resolves when the system has taken all of it."""
        # Shielded: half a packet would keep the board waiting for the rest.
        return asyncio.shield(asyncio.wrap_future(self._bluetooth.submit(self._write(data))))

    def close(self) -> None:
        client, self._client = self._client, None
        if client:
            with contextlib.suppress(Exception):  # it is gone, as requested
                self._bluetooth.submit(self._bluetooth.close(client)).result()

    async def _write(self, data: bytes) -> None:
        client, takes = self._client, self._takes
        if client is None or takes is None:
            raise self._lost()
        responds = "write-without-response" not in takes.properties
        try:
            async with asyncio.timeout(WRITE_S):
                await write_in_chunks(data, lambda chunk: client.write_gatt_char(takes, chunk, responds))
        except Exception as error:
            self.lose()
            raise self._lost() from error

    def _lost(self) -> PortLostError:
        return PortLostError(
            f"The Bluetooth connection to {self._device} broke off. Is the robot switched on and near?"
        )


async def write_in_chunks(data: bytes, write: Callable[[bytes], Awaitable[None]]) -> None:
    """In pieces that every module takes, each once the UART behind it is through with the one before."""
    clock = asyncio.get_running_loop()
    free_at = clock.time()
    for at in range(0, len(data), CHUNK_BYTES):
        chunk = data[at : at + CHUNK_BYTES]
        await asyncio.sleep(max(0.0, free_at - clock.time()))
        free_at = clock.time() + wire_s(len(chunk))
        await write(chunk)


def explain(device: str, error: Exception) -> PortError:
    """The error's class and the sentence for the person."""
    from bleak.exc import BleakBluetoothNotAvailableError, BleakDBusError
    from bleak.exc import BleakBluetoothNotAvailableReason as Reason

    if isinstance(error, BleakBluetoothNotAvailableError):
        if error.reason in (Reason.DENIED_BY_USER, Reason.DENIED_BY_SYSTEM, Reason.DENIED_BY_UNKNOWN):
            return PortDeniedError(DENIED)
        return PortMissingError(SWITCHED_OFF if error.reason is Reason.POWERED_OFF else NO_ADAPTER)
    name = error.dbus_error if isinstance(error, BleakDBusError) else ""
    if name.endswith((".AccessDenied", ".NotAuthorized", ".NotPermitted")):
        return PortDeniedError(DENIED)
    if name.endswith((".ServiceUnknown", ".NameHasNoOwner")) or isinstance(
        error, (FileNotFoundError, ConnectionError)
    ):
        return PortMissingError(NOT_RUNNING)
    if name.endswith(".NotReady"):
        return PortMissingError(SWITCHED_OFF)
    return PortBusyError(
        f"{device} is there and does not let itself be connected ({str(error) or type(error).__name__}). "
        "Switch the robot off and on, and end the connection of a phone's app."
    )

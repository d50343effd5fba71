"""Put a program behind a Bluetooth module: a stand-in for bluetoothd on a system bus of its own.

bleak and Chromium find one adapter there and the serial module of these boards. Needs dbus-daemon and Linux;
no radio, no root, no BlueZ. Knows no packet.

    bluetooth_board.py --folder FOLDER [--module NAME[/SERVICE]]... -- COMMAND [ARGUMENT...]

Prints `bluetooth ADDRESS` on stderr: what goes into DBUS_SYSTEM_BUS_ADDRESS. The program stands behind the
first module. A line on stdin is an event: `drop` (the link breaks, the board keeps its power), `off` and `on`
(of the module and its program), `adapter off` and `adapter on`. The end of stdin ends all.
"""

import argparse
import asyncio
import contextlib
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from dbus_fast import BusType, Message, MessageType, Variant
from dbus_fast.aio import MessageBus

Properties = dict[str, Variant]

BLUEZ = "org.bluez"
ADAPTER = "/org/bluez/hci0"
ADAPTER_1, DEVICE_1 = "org.bluez.Adapter1", "org.bluez.Device1"
SERVICE_1, CHARACTERISTIC_1 = "org.bluez.GattService1", "org.bluez.GattCharacteristic1"
DESCRIPTOR_1 = "org.bluez.GattDescriptor1"
PROPERTIES = "org.freedesktop.DBus.Properties"
OBJECTS = "org.freedesktop.DBus.ObjectManager"
# What a notification carries is 3 bytes shorter.
MTU_BYTES = 23
ADVERTISED_EVERY_S = 0.05
CONNECT_S = 0.02

BUS_CONFIG = """<!DOCTYPE busconfig PUBLIC
  "-//freedesktop//DTD D-Bus Bus Configuration 1.0//EN" "busconfig.dtd">
<busconfig>
  <type>servodeck</type><listen>unix:path={socket}</listen><auth>EXTERNAL</auth>
  <policy context="default">
    <allow user="*"/><allow own="*"/>
    <allow send_type="method_call"/><allow send_type="signal"/>
    <allow send_requested_reply="true" send_type="method_return"/>
    <allow send_requested_reply="true" send_type="error"/>
    <allow receive_type="method_call"/><allow receive_type="method_return"/>
    <allow receive_type="error"/><allow receive_type="signal"/>
  </policy>
</busconfig>"""


def uuid(short: str) -> str:
    return f"0000{short}-0000-1000-8000-00805f9b34fb"


class Tree:
    """The objects that bluetoothd shows, and the signals that tell of their changes."""

    def __init__(self, bus: MessageBus) -> None:
        self._bus = bus
        self.objects: dict[str, dict[str, Properties]] = {}

    def add(self, path: str, interface: str, properties: Properties) -> None:
        self.objects.setdefault(path, {})[interface] = properties

    def change(self, path: str, interface: str, **properties: Variant) -> None:
        self.objects[path][interface] |= properties
        self._signal(path, PROPERTIES, "PropertiesChanged", "sa{sv}as", [interface, properties, []])

    def show(self, path: str) -> None:
        self._signal("/", OBJECTS, "InterfacesAdded", "oa{sa{sv}}", [path, self.objects[path]])

    def value(self, path: str, interface: str, name: str) -> Any:
        return self.objects[path][interface][name].value

    def _signal(self, path: str, interface: str, member: str, signature: str, body: list[Any]) -> None:
        self._bus.send(Message.new_signal(path, interface, member, signature, body))


class Module:
    """One module that advertises itself, and the serial service behind it. FFE0 has one characteristic for
    both directions, FFF0 one for each.
    """

    def __init__(self, tree: Tree, number: int, name: str, service: str) -> None:
        self._tree = tree
        self.address = f"48:87:2D:62:C6:{number:02X}"
        self.path = f"{ADAPTER}/dev_{self.address.replace(':', '_')}"
        self.is_on = True
        self.received: Callable[[bytes], None] = lambda _data: None
        service_path = f"{self.path}/service000c"
        self.notifier = f"{service_path}/char000d"
        writer = self.notifier if service == "ffe0" else f"{service_path}/char0010"
        tree.add(self.path, DEVICE_1, device_properties(self.address, name, service))
        tree.add(service_path, SERVICE_1, service_properties(self.path, service))
        both = ["read", "write-without-response", "write"]
        flags = [*both, "notify"] if writer == self.notifier else ["read", "notify"]
        tree.add(self.notifier, CHARACTERISTIC_1, characteristic_properties(service_path, "ffe1", flags))
        # Chromium starts notifications only where there is exactly one of these.
        tree.add(f"{self.notifier}/desc000f", DESCRIPTOR_1, descriptor_properties(self.notifier))
        if writer != self.notifier:
            tree.add(writer, CHARACTERISTIC_1, characteristic_properties(service_path, "ffe2", both))

    @property
    def is_connected(self) -> bool:
        return bool(self._tree.value(self.path, DEVICE_1, "Connected"))

    def advertise(self) -> None:
        if self.is_on and not self.is_connected:
            self._tree.show(self.path)
            strength = -60 if self._tree.value(self.path, DEVICE_1, "RSSI") == -61 else -61
            self._tree.change(self.path, DEVICE_1, RSSI=Variant("n", strength))

    async def connect(self) -> bool:
        await asyncio.sleep(CONNECT_S)
        if self.is_on:
            self._tree.change(self.path, DEVICE_1, Connected=Variant("b", True))
            self._tree.change(self.path, DEVICE_1, ServicesResolved=Variant("b", True))
        return self.is_on

    def disconnect(self) -> None:
        if self.is_connected:
            self._tree.change(self.notifier, CHARACTERISTIC_1, Notifying=Variant("b", False))
            self._tree.change(self.path, DEVICE_1, ServicesResolved=Variant("b", False))
            self._tree.change(self.path, DEVICE_1, Connected=Variant("b", False))

    def notify(self, data: bytes) -> None:
        """Reports of the board without a listener are lost."""
        size = MTU_BYTES - 3
        if self._tree.value(self.notifier, CHARACTERISTIC_1, "Notifying"):
            for at in range(0, len(data), size):
                value = Variant("ay", data[at : at + size])
                self._tree.change(self.notifier, CHARACTERISTIC_1, Value=value)


def device_properties(address: str, name: str, service: str) -> Properties:
    flags = dict.fromkeys(
        ("Paired", "Bonded", "Trusted", "Blocked", "LegacyPairing", "Connected", "ServicesResolved"), False
    )
    return {
        "Address": Variant("s", address),
        "AddressType": Variant("s", "public"),
        "Name": Variant("s", name),
        "Alias": Variant("s", name),
        "RSSI": Variant("n", -60),
        "UUIDs": Variant("as", [uuid(service)]),
        "Adapter": Variant("o", ADAPTER),
        **{flag: Variant("b", value) for flag, value in flags.items()},
    }


def service_properties(device: str, service: str) -> Properties:
    return {
        "UUID": Variant("s", uuid(service)),
        "Primary": Variant("b", True),
        "Device": Variant("o", device),
        "Includes": Variant("ao", []),
    }


def characteristic_properties(service: str, short: str, flags: list[str]) -> Properties:
    return {
        "UUID": Variant("s", uuid(short)),
        "Service": Variant("o", service),
        "Value": Variant("ay", b""),
        "Notifying": Variant("b", False),
        "Flags": Variant("as", flags),
        "MTU": Variant("q", MTU_BYTES),
    }


def descriptor_properties(characteristic: str) -> Properties:
    return {
        "UUID": Variant("s", uuid("2902")),
        "Characteristic": Variant("o", characteristic),
        "Value": Variant("ay", b"\0\0"),
    }


def adapter_properties() -> Properties:
    return {
        "Address": Variant("s", "00:1A:7D:DA:71:13"),
        "AddressType": Variant("s", "public"),
        "Name": Variant("s", "stand-in"),
        "Alias": Variant("s", "stand-in"),
        "Class": Variant("u", 0),
        "Powered": Variant("b", True),
        "Discoverable": Variant("b", False),
        "DiscoverableTimeout": Variant("u", 0),
        "Pairable": Variant("b", False),
        "PairableTimeout": Variant("u", 0),
        "Discovering": Variant("b", False),
        "UUIDs": Variant("as", []),
        "Modalias": Variant("s", "usb:v1D6Bp0246d0540"),
        "Roles": Variant("as", ["central"]),
    }


class Bluetoothd:
    """Answers what bleak and Chromium ask of bluetoothd; what else they call succeeds and does nothing."""

    def __init__(self, bus: MessageBus, modules: list[tuple[str, str]]) -> None:
        self._bus = bus
        self.tree = Tree(bus)
        self.tree.add("/org/bluez", "org.bluez.AgentManager1", {})
        self.tree.add(ADAPTER, ADAPTER_1, adapter_properties())
        self.tree.add(ADAPTER, "org.bluez.GattManager1", {})
        self.modules = [Module(self.tree, number, *one) for number, one in enumerate(modules)]
        self._discovery: asyncio.Task[None] | None = None
        self._connecting: set[asyncio.Task[None]] = set()
        bus.add_message_handler(self._answer)

    def power(self, is_on: bool) -> None:
        for module in self.modules:
            if not is_on:
                module.disconnect()
        self.tree.change(ADAPTER, ADAPTER_1, Powered=Variant("b", is_on))

    def _answer(self, call: Message) -> Message | None:
        if call.message_type is not MessageType.METHOD_CALL:
            return None
        path, interface = call.path or "", call.interface or ""
        if interface == OBJECTS:
            return Message.new_method_return(call, "a{oa{sa{sv}}}", [self.tree.objects])
        if path not in self.tree.objects:
            return None
        if interface == PROPERTIES:
            return self._answer_property(call, path)
        if interface == DEVICE_1:
            return self._answer_device(call, path)
        if interface == ADAPTER_1:
            return self._answer_adapter(call)
        if interface == CHARACTERISTIC_1:
            self._handle_characteristic(call, path)
        if call.member == "ReadValue":
            return Message.new_method_return(call, "ay", [self.tree.value(path, interface, "Value")])
        return Message.new_method_return(call) if interface.startswith(BLUEZ) else None

    def _answer_property(self, call: Message, path: str) -> Message | None:
        properties = self.tree.objects[path].get(call.body[0], {})
        if call.member == "GetAll":
            return Message.new_method_return(call, "a{sv}", [properties])
        if call.member == "Get":
            return Message.new_method_return(call, "v", [properties[call.body[1]]])
        return Message.new_method_return(call)

    def _answer_adapter(self, call: Message) -> Message:
        is_on = self.tree.value(ADAPTER, ADAPTER_1, "Powered")
        if call.member == "StartDiscovery" and not is_on:
            return Message.new_error(call, "org.bluez.Error.NotReady", "Resource Not Ready")
        if call.member == "StartDiscovery":
            self._stop_discovery()
            self._discovery = asyncio.create_task(self._discover())
            self.tree.change(ADAPTER, ADAPTER_1, Discovering=Variant("b", True))
        if call.member == "StopDiscovery":
            self._stop_discovery()
            self.tree.change(ADAPTER, ADAPTER_1, Discovering=Variant("b", False))
        return Message.new_method_return(call)

    def _answer_device(self, call: Message, path: str) -> Message | None:
        module = next(one for one in self.modules if one.path == path)
        if call.member == "Connect":
            task = asyncio.create_task(self._connect(call, module))
            self._connecting.add(task)
            task.add_done_callback(self._connecting.discard)
            # The library's word for a reply that comes later.
            return True  # type: ignore[return-value]
        if call.member == "Disconnect":
            module.disconnect()
        return Message.new_method_return(call)

    async def _connect(self, call: Message, module: Module) -> None:
        if await module.connect():
            await self._bus.send(Message.new_method_return(call))
        else:
            await self._bus.send(Message.new_error(call, "org.bluez.Error.Failed", "Host is down"))

    def _handle_characteristic(self, call: Message, path: str) -> None:
        module = next(one for one in self.modules if path.startswith(one.path))
        if call.member == "WriteValue":
            module.received(bytes(call.body[0]))
        if call.member in ("StartNotify", "StopNotify"):
            is_notifying = Variant("b", call.member == "StartNotify")
            self.tree.change(path, CHARACTERISTIC_1, Notifying=is_notifying)

    def _stop_discovery(self) -> None:
        if self._discovery:
            self._discovery.cancel()

    async def _discover(self) -> None:
        while True:
            await asyncio.sleep(ADVERTISED_EVERY_S)
            for module in self.modules:
                module.advertise()


class Board:
    """The program behind a module: started with its power, ended with it."""

    def __init__(self, module: Module, command: list[str]) -> None:
        self._module = module
        self._command = command
        self._program: asyncio.subprocess.Process | None = None
        self._reading: asyncio.Task[None] | None = None
        module.received = self._write

    async def power_on(self) -> None:
        pipe = asyncio.subprocess.PIPE
        self._program = await asyncio.create_subprocess_exec(*self._command, stdin=pipe, stdout=pipe)
        self._reading = asyncio.create_task(self._read(self._program))
        self._module.is_on = True

    async def power_off(self) -> None:
        self._module.is_on = False
        self._module.disconnect()
        program, self._program = self._program, None
        if program:
            with contextlib.suppress(ProcessLookupError):
                program.terminate()
            await program.wait()

    def _write(self, data: bytes) -> None:
        if self._program and self._program.stdin:
            self._program.stdin.write(data)

    async def _read(self, program: asyncio.subprocess.Process) -> None:
        assert program.stdout
        while data := await program.stdout.read(4096):
            self._module.notify(data)


@contextlib.contextmanager
def private_bus(folder: Path) -> Any:
    """A system bus that this program alone has started; its address."""
    folder.mkdir(parents=True, exist_ok=True)
    config = folder / "bus.conf"
    config.write_text(BUS_CONFIG.format(socket=folder / "bus"))
    options = ["--nofork", "--nopidfile", "--print-address=1"]
    command = ["dbus-daemon", f"--config-file={config}", *options]
    # Where it may not open thousands of files it says so, and serves all the same.
    daemon = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    try:
        assert daemon.stdout
        yield daemon.stdout.readline().decode().strip()
    finally:
        daemon.terminate()
        daemon.wait()


async def lines_of_stdin() -> asyncio.StreamReader:
    reader = asyncio.StreamReader()
    loop = asyncio.get_running_loop()
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), sys.stdin)
    return reader


async def serve(folder: Path, modules: list[tuple[str, str]], command: list[str]) -> None:
    with private_bus(folder) as address:
        bus = await MessageBus(bus_address=address, bus_type=BusType.SYSTEM).connect()
        bluetoothd = Bluetoothd(bus, modules)
        await bus.request_name(BLUEZ)
        module = bluetoothd.modules[0]
        board = Board(module, command)
        await board.power_on()
        print(f"bluetooth {address}", file=sys.stderr, flush=True)
        try:
            events = await lines_of_stdin()
            while line := (await events.readline()).decode():
                match line.strip():
                    case "drop":
                        module.disconnect()
                    case "off":
                        await board.power_off()
                    case "on":
                        await board.power_on()
                    case "adapter off" | "adapter on" as power:
                        bluetoothd.power(power.endswith("on"))
                    case other:
                        print(f"no such event: {other}", file=sys.stderr, flush=True)
        finally:
            await board.power_off()
            bus.disconnect()


def named_module(text: str) -> tuple[str, str]:
    name, _, service = text.partition("/")
    return name, service or "ffe0"


async def main() -> None:
    parser = argparse.ArgumentParser(description="Put a program behind a Bluetooth module.")
    parser.add_argument("--folder", type=Path, required=True, help="for the bus")
    parser.add_argument("--module", type=named_module, action="append", metavar="NAME[/ffe0|/fff0]")
    parser.add_argument("command", nargs="+", help="the program and its arguments, after --")
    arguments = parser.parse_args()
    life = asyncio.create_task(
        serve(arguments.folder.resolve(), arguments.module or [("Hiwonder", "ffe0")], arguments.command)
    )
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        asyncio.get_running_loop().add_signal_handler(number, life.cancel)
    with contextlib.suppress(asyncio.CancelledError):
        await life


if __name__ == "__main__":
    asyncio.run(main())

"""What has been counted since the start, for Prometheus. Knows names and numbers, nothing of what they count.

One registry for the process: whoever has something to count does it here in one line.
"""

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, ProcessCollector

from servodeck.protocol.packets import COMMAND_NUMBER

REGISTRY = CollectorRegistry()
ProcessCollector(registry=REGISTRY)  # memory, time, open files
COMMAND_OF_NUMBER = {number: kind for kind, number in COMMAND_NUMBER.items()}
# A packet on the wire takes 4 to 107 ms, a halt about 200.
WAIT_BUCKETS_S = (0.001, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5)

sent = Counter("servodeck_packets_sent", "Packets put on the wire", ["command"], registry=REGISTRY)
received = Counter("servodeck_packets_received", "Packets of the board", ["command"], registry=REGISTRY)
noise = Counter("servodeck_noise_bytes", "Bytes of the board that were no packet", registry=REGISTRY)
refused = Counter("servodeck_refused", "What was asked for and refused", ["code"], registry=REGISTRY)
queue_wait = Histogram(
    "servodeck_queue_wait_seconds",
    "From being asked for to the first byte on the wire",
    buckets=WAIT_BUCKETS_S,
    registry=REGISTRY,
)
stops = Counter("servodeck_stops", "Halts begun, of whatever cause", registry=REGISTRY)
port_losses = Counter("servodeck_port_losses", "An open port went away unasked", registry=REGISTRY)
port_openings = Counter("servodeck_port_openings", "The port was opened", registry=REGISTRY)
port_state = Gauge("servodeck_port_state", "1 for the state it is in", ["status"], registry=REGISTRY)
latched = Gauge("servodeck_latched", "1 while motion waits for Resume", registry=REGISTRY)
clients = Gauge("servodeck_clients", "Clients on the WebSocket", registry=REGISTRY)
battery = Gauge("servodeck_battery_millivolts", "As the board told last", registry=REGISTRY)
loop_delay = Gauge(
    "servodeck_loop_delay_seconds", "The longest wait for the event loop lately", registry=REGISTRY
)


def name_of(command: int) -> str:
    """For a label; what has no name in the protocol is told by its number."""
    return COMMAND_OF_NUMBER.get(command) or f"0x{command:02x}"

"""The gateway's counters and state in Prometheus's text format. Reads state, and sends nothing to the
board.
"""

from collections.abc import Iterator, Mapping
from itertools import accumulate
from typing import get_args

from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, ProcessCollector, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily, Metric
from prometheus_client.registry import Collector
from prometheus_client.utils import floatToGoString

from servodeck import metrics
from servodeck.robot.control import Control
from servodeck.snapshots import FleetStatus, PortStatus

MEDIA_TYPE = CONTENT_TYPE_LATEST


def numbers_text(control: Control, loop_delay_s: float, fleet: FleetStatus | None) -> bytes:
    registry = CollectorRegistry()
    ProcessCollector(registry=registry)  # memory, time, open files
    registry.register(Numbers(control, loop_delay_s, fleet))
    return generate_latest(registry)


class Numbers(Collector):
    def __init__(self, control: Control, loop_delay_s: float, fleet: FleetStatus | None) -> None:
        self._control = control
        self._loop_delay_s = loop_delay_s
        self._fleet = fleet

    def collect(self) -> Iterator[Metric]:
        totals, control = metrics.totals, self._control
        yield counts("servodeck_packets_sent", "Packets put on the wire", "command", metrics.sent)
        yield counts("servodeck_packets_received", "Packets of the board", "command", metrics.received)
        yield CounterMetricFamily(
            "servodeck_noise_bytes", "Bytes of the board that were no packet", totals.noise_bytes
        )
        yield counts("servodeck_refused", "Requests that were refused", "code", metrics.refused)
        yield counts(
            "servodeck_notifications", "Notifications to a receiver, by outcome", "outcome", metrics.notified
        )
        yield waits()
        yield CounterMetricFamily("servodeck_stops", "Halts begun, for any cause", totals.stops)
        yield CounterMetricFamily("servodeck_port_losses", "Losses of an open port", totals.port_losses)
        yield CounterMetricFamily("servodeck_port_openings", "The port was opened", totals.port_openings)
        states = GaugeMetricFamily("servodeck_port_state", "1 for the state it is in", labels=["status"])
        for status in get_args(PortStatus):
            states.add_metric([status], status == control.board.port.status)
        yield states
        yield GaugeMetricFamily("servodeck_latched", "1 while motion waits for Resume", control.latch)
        yield GaugeMetricFamily("servodeck_clients", "Clients on the WebSocket", len(control.hub))
        reading = control.board.battery.newest
        battery_mv = reading.battery_mv if reading else float("nan")
        yield GaugeMetricFamily("servodeck_battery_millivolts", "As the board reported last", battery_mv)
        yield GaugeMetricFamily(
            "servodeck_loop_delay_seconds", "The longest wait for the event loop lately", self._loop_delay_s
        )
        if self._fleet:
            yield GaugeMetricFamily(
                "servodeck_broker_connected", "1 while connected to the MQTT broker", self._fleet.is_connected
            )
            yield counts(
                "servodeck_broker_refused", "Messages refused at the door", "code", self._fleet.refused
            )


def counts(name: str, about: str, label: str, numbers: Mapping[str, int]) -> CounterMetricFamily:
    family = CounterMetricFamily(name, about, labels=[label])
    for value, number in sorted(numbers.items()):
        family.add_metric([value], number)
    return family


def waits() -> HistogramMetricFamily:
    limits = [*map(floatToGoString, metrics.WAIT_BUCKETS_S), "+Inf"]
    return HistogramMetricFamily(
        "servodeck_queue_wait_seconds",
        "From the request to the first byte on the wire",
        buckets=[*zip(limits, accumulate(metrics.queue_wait.counts), strict=True)],
        sum_value=metrics.queue_wait.sum_s,
    )

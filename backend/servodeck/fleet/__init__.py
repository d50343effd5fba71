"""Many gateways on an MQTT 5 broker: the gateway as its client, and the consoles on the other side."""

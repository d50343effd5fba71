"""Access to the gateway: addresses, devices, roles and rates."""

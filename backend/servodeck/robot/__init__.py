"""The robot behind the port: what may be requested of it, by whom and when, and what it does."""

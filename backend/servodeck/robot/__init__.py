"""The robot behind the port: what may be asked of it, by whom and when, and what it does."""

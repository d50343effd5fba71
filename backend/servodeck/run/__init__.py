"""The gateway as a process: put together, started, watched and ended."""

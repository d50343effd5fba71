"""How many descriptors the process may have. Knows the system's limit, not what takes them."""

import os

# pyserial waits with select(), which takes no descriptor of a higher number.
WANTED = 1024


def allow_descriptors() -> None:
    """As many as are wanted, or as the system lets us have."""
    if os.name != "posix":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    most = WANTED if hard == resource.RLIM_INFINITY else min(WANTED, hard)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))

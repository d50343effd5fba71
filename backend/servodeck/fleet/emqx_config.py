"""The same as broker_config for EMQX 5.8 or later: packaging/broker/emqx.compose.yaml reads these files.

Formats: https://docs.emqx.com/en/emqx/latest/access-control/authz/file.html and authn/mnesia.html there.
"""

import json
from collections.abc import Sequence
from pathlib import Path

from servodeck.fleet.broker_config import (
    QUEUED_MESSAGES,
    TOPIC_BYTES,
    Plan,
    passwords_of,
    private,
    rights_of,
)
from servodeck.fleet.rules import DOWNLOAD_BYTES

# EMQX puts its own folder in place of the variable.
BASE = """\
authentication = [
  {
    mechanism = password_based
    backend = built_in_database
    user_id_type = username
    password_hash_algorithm { name = sha256, salt_position = suffix }
    bootstrap_file = "${EMQX_ETC_DIR}/users.csv"
    bootstrap_type = plain
  }
]
authorization {
  no_match = deny
  deny_action = ignore
  sources = [{ type = file, enable = true, path = "${EMQX_ETC_DIR}/acl.conf" }]
}
"""


def write_emqx(plan: Plan, folder: Path) -> None:
    """`base.hocon`, `acl.conf` and `users.csv`; listeners and certificates are the compose file's. EMQX reads
    the users at its first start. Raises ValueError or OSError.
    """
    plan.check()
    users = "".join(f"{name},{secret},false\n" for name, secret in passwords_of(plan, folder).items())
    private(folder / "users.csv", f"user_id,password,is_superuser\n{users}")
    packet_kib = -(-(DOWNLOAD_BYTES + TOPIC_BYTES) // 1024)
    limits = f'mqtt {{ max_packet_size = "{packet_kib}KB", max_mqueue_len = {QUEUED_MESSAGES} }}\n'
    (folder / "base.hocon").write_text(BASE + limits, "utf-8")
    (folder / "acl.conf").write_text(acl_of(plan), "utf-8")


def acl_of(plan: Plan) -> str:
    """What is not allowed is denied, as in a file of Mosquitto."""
    lines = [
        rule(rights.user, action, topics)
        for rights in rights_of(plan)
        for action, topics in (("publish", rights.written), ("subscribe", rights.read))
    ]
    return "\n".join([*lines, "{deny, all}."]) + "\n"


def rule(user: str, action: str, topics: Sequence[str]) -> str:
    return f"{{allow, {{user, {json.dumps(user)}}}, {action}, {json.dumps(topics)}}}."

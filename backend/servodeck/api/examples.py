"""One example for each route of the HTTP interface: request, response, and its own errors.

Data only. A test checks each against the models, and that no route is missing.

"""

from typing import Any, NamedTuple

from servodeck.errors import ErrorCode


class Example(NamedTuple):
    """`request` and `response` are None where there is no body. `errors`: those that not every route has."""

    response: Any
    request: Any = None
    errors: tuple[ErrorCode, ...] = ()


PORT = {
    "device": "/dev/serial/by-id/usb-1a86_USB_Serial-if00-port0",
    "status": "open",
    "simulated": False,
    "code": None,
    "detail": None,
    "heldBy": [],
    "retryInMs": None,
}
PLAY = {
    "id": "45c48cce2e2d",
    "by": "Dance",
    "status": "playing",
    "frameIndex": 1,
    "frameCount": 12,
    "times": 2,
    "lateFrames": 0,
    "latestMs": 0,
    "skippedFrames": 0,
    "code": None,
    "detail": None,
}
CLOSED = PORT | {"device": None, "status": "closed"}
STATUS = {
    "version": "0.1.0",
    "board": "lsc-16",
    "port": PORT,
    "link": {"status": "ready", "code": None, "detail": None},
    "identity": {
        "evidence": [
            {
                "kind": "answered",
                "question": "readBattery",
                "report": {"kind": "battery", "batteryMv": 7500},
            },
            {"kind": "silent", "question": "readPositions"},
        ],
        "candidates": ["doc", "lsc-6", "lsc-16", "lsc-24", "lsc-32"],
    },
    "latch": False,
    "clients": 2,
    "battery": {"batteryMv": 7500, "ageMs": 4200},
    "driver": "Anna's tablet",
    "running": {"slot": 3, "times": 2, "endsInMs": 4200},
    "play": PLAY,
    "unattended": {"slot": 3, "times": 2, "by": "Anna's tablet", "endsInMs": 245000},
    "notifications": [{"kind": "ntfy", "host": "ntfy.sh", "latest": "sent", "detail": None}],
    "fleet": None,
}
LEASE = {
    "you": "Dance",
    "driver": "Dance",
    "drives": True,
    "requestedBy": None,
    "hasRequested": False,
    "grantedInMs": None,
    "mayDrive": True,
    "mayTake": False,
    "grantedBy": None,
    "candidates": [{"id": "5d41402abc4b2a76", "name": "Anna's tablet"}],
}
JOB = {
    "id": "8f14e45fceea",
    "by": "Dance",
    "status": "running",
    "slots": [5, 6],
    "groupsStored": 0,
    "slot": 5,
    "name": "Wave",
    "framesStored": 1,
    "frameCount": 3,
    "bytesSent": 13,
    "bytesTotal": 39,
    "remainingMs": 420,
    "code": None,
    "detail": None,
}
TEXT = '{"format": "servodeck-group", "version": 1}'
FACTS = {
    "kind": "group",
    "name": "Wave",
    "robot": "Arm",
    "tags": ["greeting"],
    "updatedAtMs": 1795284000000,
    "frames": 21,
    "durationMs": 8400,
    "unit": "us",
    "pose": [{"servo": 1, "position": 1500}],
}
DOCUMENT = "6f1c2a9e-77aa-4b0e-9c5e-2f6a1d3b8c40"
LISTED = {"id": DOCUMENT, "revision": 4, "isRemoved": False, "facts": FACTS}
POSES = {
    "robot": "Arm",
    "poses": [{"id": 1, "name": "Greeting", "unit": "us", "targets": [{"servo": 1, "position": 1800}]}],
}
YOU = {"id": "5d41402abc4b2a76", "name": "Anna's tablet", "role": "owner"}
PERSON = {
    "id": "5d41402abc4b2a76",
    "kind": "device",
    "name": "Anna's tablet",
    "role": "owner",
    "pairedAtMs": 1795284000000,
    "lastSeenMs": 1795287600000,
    "expiresInMs": None,
    "here": True,
    "drives": False,
    "unattendedSlot": None,
}
AUDIT_FILE = (
    "at,until,act,who,whom,about,count\r\n"
    "2026-11-21T18:00:00.000+00:00,2026-11-21T18:01:30.000+00:00,moved,Anna's tablet,,,212\r\n"
)
FLEET_TASK = {
    "id": "7",
    "verb": "run",
    "names": ["Wave"],
    "by": "Ben",
    "parts": [
        {"robot": "arm-1", "status": "done", "share": None, "detail": None},
        {"robot": "arm-2", "status": "failed", "share": None, "detail": "The robot is stopped."},
    ],
    "spreadMs": 3.2,
}
FLEET_CUE = {"name": "Wave", "robots": "Table 1", "times": 2, "stopsOthers": True}
FLEET_ROBOT = {
    "id": "arm-1",
    "name": "Arm 1",
    "robot": "Arm",
    "board": "lsc-16",
    "version": "0.1.0",
    "page": "http://arm-1.local:8300/",
    "limits": [{"servo": 1, "name": "Base", "min": 600, "max": 2400}],
    "lowBatteryMv": 6900,
    "slots": [{"slot": 3, "name": "Wave"}],
    "groups": ["Table 1"],
    "presence": "present",
    "seenMsAgo": None,
    "state": {
        "link": "ready",
        "latch": False,
        "stoppedBy": None,
        "driver": None,
        "running": {"slot": 3, "name": "Wave"},
        "batteryMv": 7500,
    },
}
QR = "data:image/svg+xml;base64,PHN2Zy8+"
ON_THE_WIRE: tuple[ErrorCode, ...] = (
    "closed",
    "lost",
    "boardUnknown",
    "wrongBoard",
    "echo",
    "boardSilent",
    "latched",
    "notDriving",
    "outOfRange",
    "busy",
)

EXAMPLES: dict[tuple[str, str], Example] = {
    ("GET", "/api/status"): Example(STATUS),
    ("GET", "/api/health"): Example({"status": "ready", "version": "0.1.0", "troubles": []}),
    ("GET", "/api/events"): Example(
        'data: {"type": "state", "board": "doc", "latch": true}\n\n', errors=("busy",)
    ),
    ("GET", "/api/cameras"): Example([{"id": 0, "name": "Bench"}]),
    ("GET", "/api/cameras/{camera_id}/stream"): Example(
        "--frame\r\nContent-Type: image/jpeg\r\n\r\n", errors=("notFound", "busy", "cameraFailed")
    ),
    ("GET", "/api/fleet"): Example(
        {
            "revision": 41,
            "isWhole": True,
            "site": "lab",
            "broker": {"status": "connected", "detail": ""},
            "robots": [FLEET_ROBOT],
            "removed": [],
            "tasks": [FLEET_TASK],
            "events": [{"atMs": 1795287600000, "robot": "Arm 1", "kind": "stopped", "by": "Ben"}],
            "cues": [FLEET_CUE],
        },
        errors=("notFound",),
    ),
    ("POST", "/api/fleet/stop"): Example(
        {"reached": ["arm-1"], "notReached": ["arm-2"]}, {"robots": ["arm-1", "arm-2"]}, ("notFound",)
    ),
    ("POST", "/api/fleet/run"): Example(
        FLEET_TASK,
        {"name": "Wave", "runs": [{"robot": "arm-1", "slot": 3}], "times": 2, "together": True},
        ("notFound",),
    ),
    ("POST", "/api/fleet/download"): Example(
        FLEET_TASK | {"verb": "download"},
        {
            "robots": ["arm-1", "arm-2"],
            "groups": [
                {"slot": 3, "name": "Wave", "frames": [{"durationMs": 400, "positions": {"1": 1200}}]}
            ],
        },
        ("notFound", "outOfRange"),
    ),
    ("POST", "/api/fleet/resume"): Example(
        FLEET_TASK | {"verb": "resume"}, {"robots": ["arm-2"]}, ("notFound",)
    ),
    ("POST", "/api/fleet/tasks/{task}/retry"): Example(FLEET_TASK, errors=("notFound", "conflict")),
    ("PUT", "/api/fleet/cues"): Example(None, {"cues": [FLEET_CUE]}, ("notFound",)),
    ("POST", "/api/fleet/groups"): Example(
        None, {"robots": ["arm-1", "arm-2"], "group": "Table 1"}, ("notFound",)
    ),
    ("GET", "/api/battery"): Example({"batteryMv": 7500}, errors=("closed", "lost", "noAnswer")),
    ("POST", "/api/stop"): Example(
        {"latch": True, "halted": True, "unheld": None}, errors=("closed", "lost")
    ),
    ("POST", "/api/resume"): Example(STATUS, errors=("lost",)),
    ("POST", "/api/move"): Example(
        {"packets": 1, "overInMs": 1500, "firstMoves": [1], "ended": True},
        {"timeMs": 1500, "positions": {"1": 1500, "2": 900}, "take": False, "waitMs": 10000},
        (*ON_THE_WIRE, "cancelled"),
    ),
    ("POST", "/api/slots/{slot}/run"): Example(
        {"outcome": "acknowledged"},
        {"times": 2, "continueForMs": 60000, "take": False, "anyway": False},
        (*ON_THE_WIRE, "slotBroken", "batteryLow"),
    ),
    ("POST", "/api/download"): Example(
        JOB,
        {
            "groups": [
                {
                    "slot": 5,
                    "name": "Wave",
                    "frames": [
                        {"durationMs": 400, "positions": {"1": 1200}},
                        {"durationMs": 400, "positions": {"1": 1800}},
                    ],
                },
                {"slot": 6, "name": "Bow", "frames": [{"durationMs": 900, "positions": {"1": 1500}}]},
            ],
            "behind": None,
            "nonce": None,
            "take": False,
        },
        (*ON_THE_WIRE, "slotChanged", "notFound", "cancelled"),
    ),
    ("POST", "/api/play"): Example(
        PLAY,
        {
            "frames": [
                {"durationMs": 1500, "positions": {"1": 1200}},
                {"durationMs": 400, "positions": {"1": 1800}},
            ],
            "times": 2,
            "loopFrom": 0,
            "id": None,
            "nonce": None,
            "continueForMs": 60000,
            "take": False,
        },
        (*ON_THE_WIRE, "cancelled"),
    ),
    ("DELETE", "/api/play"): Example(
        PLAY | {"status": "ended", "code": "cancelled", "detail": "The group was stopped."}
    ),
    ("GET", "/api/jobs/{job}"): Example(JOB, errors=("notFound",)),
    ("DELETE", "/api/jobs/{job}"): Example(
        JOB | {"status": "cancelled", "code": "cancelled", "detail": "Called off.", "remainingMs": 0},
        errors=("notFound",),
    ),
    ("POST", "/api/erase"): Example({"erased": True}, {"take": False}, (*ON_THE_WIRE, "noAnswer")),
    ("POST", "/api/lease"): Example(LEASE, {"action": "heartbeat"}, ("busy", "notDriving")),
    ("PUT", "/api/driver"): Example(
        LEASE | {"driver": "Anna's tablet", "drives": False, "candidates": []},
        {"id": "5d41402abc4b2a76"},
        ("notDriving", "notFound"),
    ),
    ("GET", "/api/poses"): Example(POSES),
    ("POST", "/api/poses/{pose}/apply"): Example(
        {"packets": 1, "overInMs": 1500, "firstMoves": []},
        {"timeMs": 1500, "take": False},
        (*ON_THE_WIRE, "cancelled", "notFound"),
    ),
    ("PUT", "/api/robot"): Example(
        None,
        {"id": DOCUMENT, "insteadOf": None},
        ("conflict", "notDriving", "notFound", "outOfRange"),
    ),
    ("GET", "/api/ports"): Example(
        [
            {
                "device": "/dev/ttyUSB0",
                "description": "USB Serial",
                "likely": True,
                "lasting": PORT["device"],
                "inUse": True,
            }
        ],
    ),
    ("PUT", "/api/port"): Example(
        PORT,
        {"device": "/dev/ttyUSB0", "board": "lsc-16"},
        ("outOfRange", "portMissing", "portBusy", "portDenied", "otherDevice"),
    ),
    ("DELETE", "/api/port"): Example(CLOSED),
    ("POST", "/api/port/listen"): Example(
        {"baud": 115200, "kind": "text"},
        errors=("busy", "closed", "notDriving", "notSupported", "portBusy", "portMissing"),
    ),
    ("PUT", "/api/board"): Example(STATUS, {"board": "lsc-16"}, ("busy", "notDriving", "outOfRange")),
    ("GET", "/api/library"): Example({"documents": [LISTED], "damagedFile": None, "changesLost": False}),
    ("POST", "/api/library/drafts"): Example(
        {"id": "draft-6f0b7a52c1d3e489"},
        {
            "text": '{"format": "servodeck-group"}',
            "facts": FACTS | {"tags": ["draft", "by Assistant"]},
        },
        ("storageFull", "storageBusy"),
    ),
    ("POST", "/api/library/remove"): Example(None, {"ids": [DOCUMENT]}, ("notFound",)),
    ("POST", "/api/library/restore"): Example(None, {"ids": [DOCUMENT]}, ("notFound",)),
    ("GET", "/api/library/{document}"): Example({"text": TEXT, "revision": 4}, errors=("notFound",)),
    ("PUT", "/api/library/{document}"): Example(
        {"revision": 5},
        {"text": TEXT, "facts": FACTS, "expected": 4, "isRemoved": False},
        ("conflict", "notDriving", "tooLarge", "storageFull", "storageBusy"),
    ),
    ("GET", "/api/library/{document}/versions"): Example(
        [{"id": "v1", "name": "Before the show", "atMs": 1795284000000}],
    ),
    ("GET", "/api/library/{document}/versions/{version}"): Example({"text": TEXT}, errors=("notFound",)),
    ("PUT", "/api/library/{document}/versions/{version}"): Example(
        None, {"name": "Before the show", "atMs": 1795284000000, "text": TEXT}, ("notFound", "storageFull")
    ),
    ("DELETE", "/api/library/{document}/versions/{version}"): Example(None, errors=("notFound",)),
    ("GET", "/api/me"): Example({"mode": "lan", "overheard": True, "you": YOU, "pages": ["robot"]}),
    ("PATCH", "/api/me"): Example(YOU, {"name": "Anna's tablet"}, ("notFound",)),
    ("POST", "/api/pair"): Example(
        YOU,
        {"secret": None, "code": "12345678", "stop": None, "name": "Anna's tablet"},
        ("pairingFailed", "pairingLocked"),
    ),
    ("GET", "/api/audit"): Example(
        {
            "entries": [
                {
                    "id": 4711,
                    "act": "moved",
                    "who": "Anna's tablet",
                    "whom": "",
                    "about": "",
                    "atMs": 1795284000000,
                    "untilMs": 1795284090000,
                    "count": 212,
                }
            ],
            "more": True,
            "names": ["Anna's tablet", "Dance"],
            "problem": None,
        }
    ),
    ("GET", "/api/audit/file"): Example(AUDIT_FILE),
    ("GET", "/api/people"): Example({"people": [PERSON], "openInvites": [], "openCodes": []}),
    ("PATCH", "/api/people/{person}"): Example(
        PERSON, {"name": "Anna's tablet", "role": "owner"}, ("notFound",)
    ),
    ("DELETE", "/api/people/{person}"): Example(None, errors=("notFound",)),
    ("POST", "/api/invites"): Example(
        {
            "id": "9a0364b9e99bb480",
            "link": "http://servodeck.local:8300/#pair=SECRET",
            "code": "12345678",
            "picture": QR,
            "expiresInMs": 120000,
        },
        {"role": "driver", "name": "Bert's phone"},
    ),
    ("DELETE", "/api/invites/{invitation}"): Example(None),
    ("POST", "/api/tokens"): Example(
        {"id": "1679091c5a880faf", "token": "1679091c5a880faf.SECRET"},
        {"name": "Dance", "role": "driver", "expiresInDays": 30},
    ),
    ("POST", "/api/stop-links"): Example(
        {"id": "8f14e45fceea167a", "link": "http://servodeck.local:8300/#stop=SECRET", "picture": QR},
        {"name": "On the robot"},
    ),
}

PROBLEMS: dict[ErrorCode, str] = {
    "boardSilent": "The board does not answer. Is it switched on? The gateway keeps trying.",
    "boardUnknown": "The board has not been named. It answers like: bus-ctrl, xarm.",
    "busy": "A group runs for up to 4.2 s more: wait, or release the lease to end it.",
    "cancelled": "The robot was stopped or taken over before all packets were sent.",
    "closed": "No serial port is open.",
    "cameraFailed": "The camera Bench does not answer: timed out. Check that it is on, and its address.",
    "conflict": "Another client has changed this document since it was read.",
    "echo": "The line returns what is sent: RX and TX may be connected to each other.",
    "forbidden": "Dance is a viewer; this needs the role driver.",
    "latched": "Stopped: motion is refused until a person resumes.",
    "lost": "The serial port is lost.",
    "malformed": "body.timeMs: Input should be a valid integer",
    "noAnswer": "The board did not report its battery voltage. Not every board can.",
    "notDriving": 'Anna drives. An owner may take over with "take": true.',
    "notFound": "The library has no such document.",
    "notPaired": "This device is not paired with the gateway.",
    "notSupported": "Only a serial port of this computer has other speeds, not hid:497223563535.",
    "otherDevice": "Another device answers under that name now.",
    "outOfRange": "Elbow (servo 2): position is 1900, allowed 900..1800",
    "pairingFailed": "That code is wrong or too old.",
    "pairingLocked": "Too many wrong codes: ask for a new one.",
    "portBusy": "Another program uses the port.",
    "portDenied": "This user may not open the port.",
    "portMissing": "There is no such port.",
    "batteryLow": "The battery is at 6.50 V, its alarm at 6.60 V: new runs are refused.",
    "slotBroken": "Slot 5 holds half a group: download it again.",
    "slotChanged": "Something else was stored in slot 5 in the meantime.",
    "storageBusy": "The library is busy.",
    "storageFailed": "library.sqlite in the data folder cannot be used: disk I/O error.",
    "storageFull": "The disk is full.",
    "wrongBoard": "The answers of the board do not match lsc-6.",
    "tooMany": "Dance sends too many requests: try again in 0.4 s.",
    "tooLarge": "The request is larger than 3145728 bytes.",
}

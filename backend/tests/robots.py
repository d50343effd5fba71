"""Robot documents as a page stores them."""

import json
from collections.abc import Sequence
from typing import Any

Json = dict[str, Any]


def servo(number: int, name: str, least: int = 500, most: int = 2500) -> Json:
    return {
        "servo": number,
        "name": name,
        "group": "",
        "min": least,
        "max": most,
        "home": 1500,
        "isReversed": False,
        "trim": 0,
        "degreesPerUnit": 0.09,
        "mirror": None,
        "place": {"x": 50, "y": 50},
    }


def robot_text(*servos: Json, poses: Sequence[Json] = (), **fields: Any) -> str:
    robot = {
        "name": "Arm",
        "board": "doc",
        "body": "arm",
        "battery": "2s",
        "batteryCare": {"policy": "tell", "thresholds": None},
        "servos": list(servos) or [servo(1, "Gripper")],
        **fields,
    }
    book = {"poses": list(poses), "restId": None, "applied": None, "nextId": len(poses) + 1}
    kit = {
        "robot": json.dumps({"format": "servodeck-robot", "version": 1, "robot": robot}),
        "poses": json.dumps({"format": "servodeck-poses", "version": 1, "content": book}),
        "buttons": None,
        "pad": None,
    }
    return json.dumps({"format": "servodeck-robot-kit", "version": 1, "kit": kit})


def care(policy: str, warn_mv: int, alarm_mv: int) -> Json:
    return {"policy": policy, "thresholds": {"warnMv": warn_mv, "alarmMv": alarm_mv}}


def written(text: str, expected: int = 0, **rest: Any) -> Json:
    """The body of its request."""
    return {"text": text, "expected": expected, "isRemoved": False, **rest}

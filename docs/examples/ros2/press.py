"""Runs a group of the robot for each slot that comes on /servodeck/ROBOT/run (std_msgs/Int32)."""

import json
import sys


def press_of(state: str, slot: int) -> str:
    """With number and nonce of the newest state: one that is older than 3 s is refused by the gateway."""
    newest = json.loads(state)
    return json.dumps({"v": 1, "n": newest["count"], "nonce": newest["nonce"], "slot": slot})


def main(robot: str) -> None:
    import rclpy
    from std_msgs.msg import Int32, String

    rclpy.init()
    node = rclpy.create_node(f"servodeck_{robot}")
    presses = node.create_publisher(String, f"/servodeck/{robot}/press", 1)
    newest: list[str] = []

    def heard(message: String) -> None:
        newest[:] = [message.data]

    def run(message: Int32) -> None:
        if newest:
            presses.publish(String(data=press_of(newest[0], message.data)))

    node.create_subscription(String, f"/servodeck/{robot}/state", heard, 1)
    node.create_subscription(Int32, f"/servodeck/{robot}/run", run, 1)
    rclpy.spin(node)


if __name__ == "__main__":
    main(sys.argv[1])

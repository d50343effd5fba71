"""The bridge to the broker, and the node that presses: `ros2 launch ./servodeck.launch.py`."""

import sys
from pathlib import Path

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.actions import Node

HERE = Path(__file__).parent


def generate_launch_description() -> LaunchDescription:
    bridge = Node(
        package="mqtt_client",
        executable="mqtt_client",
        name="mqtt_client",
        parameters=[str(HERE / "params.yaml")],
        output="screen",
    )
    press = ExecuteProcess(cmd=[sys.executable, str(HERE / "press.py"), "arm_1"], output="screen")
    return LaunchDescription([bridge, press])

"""Poses as a picture: an arm from the side where the robot is one, and a bar for each servo between its
limits. For models that read pictures; people have the page.

Pure; loads Pillow.
"""

import io
import math
from collections.abc import Mapping, Sequence

from PIL import Image, ImageDraw

from servodeck.assistant.bodies import Body, Joint

WIDTH, HEIGHT = 320, 300
ARM_HEIGHT = 190
LINKS = ((5, 62.0), (4, 58.0), (3, 44.0))
"""Shoulder, elbow and wrist of the usual arm, with the length that each turns (boards.md section 9)."""
PAPER, INK, DIM, ACCENT = "#ffffff", "#1b1b1a", "#b8b6b0", "#1b5bcb"
MOST_POSES = 8

Pose = Mapping[int, float]
"""Positions by servo number, in the units of the robot's document. A servo that is missing is unknown."""


def picture(body: Body, poses: Sequence[Pose]) -> bytes:
    """A PNG with the poses side by side, of many some that are evenly apart."""
    shown = spread(poses)
    columns = min(4, len(shown))
    rows = math.ceil(len(shown) / columns)
    image = Image.new("RGB", (WIDTH * columns, HEIGHT * rows), PAPER)
    pen = ImageDraw.Draw(image)
    for place, (index, pose) in enumerate(shown):
        left, top = WIDTH * (place % columns), HEIGHT * (place // columns)
        title = "Now" if len(poses) == 1 else f"Frame {index + 1}"
        pen.text((left + 8, top + 6), title, fill=INK)
        if body.is_arm:
            draw_arm(pen, body, pose, left + WIDTH / 2, top + ARM_HEIGHT)
        draw_bars(pen, body, pose, left, top + (ARM_HEIGHT + 12 if body.is_arm else 30))
    file = io.BytesIO()
    image.save(file, "PNG")
    return file.getvalue()


def spread(poses: Sequence[Pose]) -> list[tuple[int, Pose]]:
    """With their index; the first and the last among them."""
    count = min(len(poses), MOST_POSES)
    if count <= 1:
        return list(enumerate(poses))
    chosen = [round(number * (len(poses) - 1) / (count - 1)) for number in range(count)]
    return [(index, poses[index]) for index in chosen]


def draw_arm(pen: ImageDraw.ImageDraw, body: Body, pose: Pose, x: float, ground: float) -> None:
    """Straight up where every servo is at home. A joint whose position is unknown is pale."""
    pen.line((x - 110, ground, x + 110, ground), fill=DIM, width=2)
    pen.rectangle((x - 18, ground - 18, x + 18, ground), fill=DIM)
    y, turned, is_known = ground - 18, 0.0, True
    for number, length in LINKS:
        joint = body.joints.get(number)
        place = pose.get(number)
        is_known = is_known and joint is not None and place is not None
        turned += joint.degrees_at(place) if joint is not None and place is not None else 0.0
        end_x = x + length * math.sin(math.radians(turned))
        end_y = y - length * math.cos(math.radians(turned))
        pen.line((x, y, end_x, end_y), fill=INK if is_known else DIM, width=9)
        pen.ellipse((x - 6, y - 6, x + 6, y + 6), fill=PAPER, outline=INK, width=2)
        x, y = end_x, end_y
    for side in (-14, 14):
        tip = math.radians(turned + side)
        pen.line((x, y, x + 18 * math.sin(tip), y - 18 * math.cos(tip)), fill=INK, width=4)


def draw_bars(pen: ImageDraw.ImageDraw, body: Body, pose: Pose, left: float, top: float) -> None:
    room = HEIGHT - (top % HEIGHT) - 8
    joints = list(body.joints.values())
    step = min(16.0, room / max(1, len(joints)))
    for row, joint in enumerate(joints):
        y = top + row * step
        pen.text((left + 8, y), f"{joint.number} {joint.name}"[:16], fill=INK)
        draw_bar(pen, joint, pose.get(joint.number), left + 120, y + step / 2)


def draw_bar(pen: ImageDraw.ImageDraw, joint: Joint, place: float | None, x: float, y: float) -> None:
    width = 120
    pen.line((x, y, x + width, y), fill=DIM, width=3)
    if place is None:
        pen.text((x + width + 8, y - 6), "unknown", fill=INK)
        return
    least, most = joint.range_degrees
    degrees = joint.degrees_at(place)
    at = x + width * (degrees - least) / max(0.1, most - least)
    pen.ellipse((at - 4, y - 4, at + 4, y + 4), fill=ACCENT)
    pen.text((x + width + 8, y - 6), f"{degrees:g} deg", fill=INK)

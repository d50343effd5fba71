"""Groups that are stored on several robots: split into messages that a robot has read in time, and how far
each robot is. What a robot has stored is not sent to it again when the download is tried again.

Knows groups and the driver of the fleet; no topic, no HTTP.
"""

from collections import Counter
from collections.abc import Sequence

from servodeck.fleet.driving import FleetDriver, Share
from servodeck.intents import GroupBody
from servodeck.snapshots import JobState

# Of a message; the largest group that there is has less. A small computer reads so much in the time for which
# an answer is waited for, and its board takes a minute to store it.
MESSAGE_BYTES = 128 * 1024


class Download:
    def __init__(self, driver: FleetDriver, groups: Sequence[GroupBody]) -> None:
        self._driver = driver
        self._groups = groups
        self._sizes = [len(group.model_dump_json()) for group in groups]
        self._frames = sum(len(group.frames) for group in groups)
        self._stored: Counter[str] = Counter()

    async def carry_out(self, robot: str, share: Share) -> None:
        """Until all groups are stored on it. Raises a FleetError."""
        messages = self._messages(self._stored[robot])

        def progress(message: int, job: JobState) -> None:
            before = messages[message].start
            self._stored[robot] = before + job.groups_stored
            frames_before = sum(len(group.frames) for group in self._groups[:before])
            share((frames_before + job.frames_stored) / self._frames)

        await self._driver.download(
            robot, [[self._groups[each] for each in message] for message in messages], progress
        )

    def _messages(self, begin: int) -> list[range]:
        """The groups from that one on, by their places; those of one message are together."""
        messages: list[range] = []
        bytes_of_last = 0
        for place in range(begin, len(self._groups)):
            bytes_of_last += self._sizes[place]
            if not messages or bytes_of_last > MESSAGE_BYTES:
                messages.append(range(place, place))
                bytes_of_last = self._sizes[place]
            messages[-1] = range(messages[-1].start, place + 1)
        return messages

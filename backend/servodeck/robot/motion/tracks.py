"""The course of each servo: linear, in whole ticks of the board (S25-S27, L5). Knows targets and times;
no group, no command. The board's ticks cannot be seen, so a servo under way may be one tick
off, either way. Twin of shared/src/motion/tracks.ts.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import inf
from typing import Literal

from servodeck.protocol.families import Family
from servodeck.protocol.timings import MOVE, STOP
from servodeck.protocol.values import ServoTarget
from servodeck.value import value

LONGEST_MOVE_MS = MOVE.longest_ms


@value
class Track:
    """One servo's way. `start` is None where it is unknown where it began. `start_leeway` and `to_leeway`:
    how far off the two ends may be; a servo whose way is changed or halted keeps what was open then. If one
    is infinite, the position is unknown, and the way says only until when the servo may move.
    """

    start: float | None
    to: float
    start_ms: float
    duration_ms: float
    start_leeway: float = 0
    to_leeway: float = 0


Tracks = Mapping[int, Track]


def board_duration_ms(duration_ms: float, family: Family) -> float:
    """The board's own duration: clamped, in whole ticks."""
    clamped = min(max(duration_ms, family.shortest_move_ms), LONGEST_MOVE_MS)
    return math.floor(clamped / family.motion.tick_ms) * family.motion.tick_ms


def end_ms(track: Track) -> float:
    return track.start_ms + track.duration_ms


def starting_at(to: float, at_ms: float) -> Track:
    """A servo that sets out then, from anywhere."""
    return astray(to, at_ms, 0)


def standing_at(at: float) -> Track:
    """A servo that rests there."""
    return Track(at, at, -inf, 0)


def stands(track: Track, now_ms: float) -> bool:
    """It has arrived, or was there from the start."""
    return end_ms(track) <= now_ms or (track.start == track.to and track.start_leeway == 0)


def last_end_ms(tracks: Tracks, at_ms: float) -> float:
    """When the last of them arrives; `at_ms` where all have."""
    return max([at_ms, *map(end_ms, tracks.values())])


def share(track: Track, now_ms: float) -> float:
    return 1 if now_ms >= end_ms(track) else max(0.0, now_ms - track.start_ms) / track.duration_ms


def position_of(track: Track, now_ms: float) -> float | None:
    """Exact, not rounded; None while it is unknown."""
    done = share(track, now_ms)
    if done == 1:
        return None if track.to_leeway == inf else track.to
    if track.start is None or track.start_leeway == inf:
        return None
    return track.start + (track.to - track.start) * done


def astray(to: float, start_ms: float, duration_ms: float) -> Track:
    """A way until then, of which no position is known."""
    return Track(None, to, start_ms, duration_ms, inf, inf)


def doubted(tracks: Tracks) -> Tracks:
    """An unknown group may move these servos from now on: their positions are void, only their times stay."""
    return {servo: astray(way.to, way.start_ms, way.duration_ms) for servo, way in tracks.items()}


def leeway_of(track: Track, now_ms: float, family: Family) -> float:
    """How far off that may be: its way of one tick, held up by what the board says, and what the ends leave
    open.
    """
    traits, position = family.motion, family.position
    if now_ms >= end_ms(track) + traits.talk_ms:
        return track.to_leeway
    if track.start_leeway == inf:
        return inf
    way = position.max - position.min if track.start is None else abs(track.to - track.start)
    tick = min(1.0, (traits.tick_ms + traits.talk_ms) / track.duration_ms) if track.duration_ms else 1.0
    # What was open at its start the board may have left behind one tick later than we.
    left = min(1.0, 1 - share(track, now_ms) + tick)
    return way * tick + track.to_leeway + (track.start_leeway - track.to_leeway) * left


def unrest_after(until_ms: float, requested_ms: float, at_ms: float, family: Family) -> float:
    """Where the board re-times every servo, those of an unknown group, which may move until then, arrive with
    what takes effect at `at_ms` (S26).
    """
    traits = family.motion
    if traits.timing == "perServo" or until_ms <= at_ms:
        return until_ms
    arrived_ms = at_ms + board_duration_ms(requested_ms, family) + traits.tick_ms + traits.talk_ms
    return arrived_ms if traits.timing == "shared" else max(until_ms, arrived_ms)


@value
class Order:
    """The targets of a move or of a frame, when they take effect and arrive, and what was under way then."""

    by: Literal["move", "frame"]
    targets: Sequence[ServoTarget]
    at_ms: float
    end_ms: float
    before: Tracks


def is_near(order: Order, at_ms: float, family: Family) -> bool:
    """The board may take up orders that are no farther apart in another order than they are computed in."""
    return at_ms - order.at_ms <= family.motion.tick_ms + family.motion.talk_ms


def ordered(recent: Sequence[Order], order: Order, family: Family) -> tuple[Order, ...]:
    """`order` behind those that are near it."""
    return (*(other for other in recent if is_near(other, order.at_ms, family)), order)


def torn(track: Track, until_ms: float) -> Track:
    """Somewhere on its way to one of two places, until the later of two times."""
    return replace(lengthened(track, until_ms), start_leeway=inf, to_leeway=inf)


def contested(tracks: Tracks, recent: Sequence[Order], family: Family, since_ms: float = -inf) -> Tracks:
    """After the last of `recent`, where moves and frames are near it that the board may take up behind it: a
    servo that they send elsewhere goes to one of two places, and where each re-times every servo (S26)
    whatever is under way may arrive when they end. What the board heard before `since_ms` is ahead of it for
    sure.
    """
    latest = recent[-1]
    if not latest.targets:
        return tracks
    rivals = [order for order in recent if order.by != latest.by and order.targets]
    is_shared = family.motion.timing == "shared"
    retimers = [rival for rival in rivals if is_shared and rival.at_ms >= since_ms]
    changed = dict(tracks)
    for servo, track in tracks.items():
        against = [rival for rival in rivals if contests(rival, latest, servo)]
        behind_ms = [rival.end_ms for rival in (*against, *retimers)]
        if against:
            changed[servo] = torn(track, max(behind_ms))
        elif not stands(track, latest.at_ms) and any(until_ms != end_ms(track) for until_ms in behind_ms):
            changed[servo] = lengthened(track, max(behind_ms))
    return changed


def contests(one: Order, other: Order, servo: int) -> bool:
    """Both send it, and to different places."""
    return len({target.position for target in (*one.targets, *other.targets) if target.servo == servo}) > 1


def stopped_before(tracks: Tracks, recent: Sequence[Order], at_ms: float, family: Family) -> dict[int, Track]:
    """After a stop at `at_ms`: frames that began just before it may not have begun. Then what was under way
    continues, and what stood still stands; that a hold would throw to where a frame has sent it that is too
    short to need one.
    """
    changed = dict(tracks)
    for frame in recent:
        if frame.by != "frame" or not is_near(frame, at_ms, family):
            continue
        for target in frame.targets:
            # Nothing else has moved it: it may still be anywhere.
            if target.servo in changed and target.servo not in frame.before:
                first = changed[target.servo]
                changed[target.servo] = torn(first, end_ms(first))
        for servo, former in frame.before.items():
            track = changed.get(servo)
            if track is None:
                continue
            is_elsewhere = former.to != track.to
            if stands(former, frame.at_ms):
                is_open = is_elsewhere and end_ms(track) <= at_ms + STOP.held_within_ms
            else:
                is_open = is_elsewhere or end_ms(former) > end_ms(track)
            if is_open:
                changed[servo] = torn(track, end_ms(former))
    return changed


def redirected(track: Track | None, to: float, at_ms: float, duration_ms: float, family: Family) -> Track:
    """Its way from `at_ms` on to `to`."""
    start = position_of(track, at_ms) if track else None
    carried = leeway_of(track, at_ms, family) if track and start is not None else 0
    # Positions are whole numbers to the board, wherever it cuts a way short.
    return Track(start, to, at_ms, duration_ms, start_leeway=0 if carried == 0 else carried + 1)


def retarget(
    tracks: Tracks,
    targets: Sequence[ServoTarget],
    requested_ms: float,
    at_ms: float,
    family: Family,
    *,
    is_sure: bool = True,
) -> Tracks:
    """After new targets took effect at `at_ms`; `is_sure` False where an unknown group may overrule
    them.
    """
    if not targets:
        return tracks
    duration_ms = board_duration_ms(requested_ms, family)

    def aimed(servo: int, to: float, *, sure: bool) -> Track:
        if sure:
            return redirected(tracks.get(servo), to, at_ms, duration_ms, family)
        return astray(to, at_ms, duration_ms)

    changed = dict(tracks)
    if family.motion.timing == "shared":
        for servo, track in tracks.items():
            is_known = track.to_leeway != inf
            # One of unknown position that has surely arrived goes nowhere.
            if is_known or end_ms(track) + family.motion.tick_ms + family.motion.talk_ms > at_ms:
                changed[servo] = aimed(servo, track.to, sure=is_known)
    for target in targets:
        changed[target.servo] = aimed(target.servo, target.position, sure=is_sure)
    return changed


def frozen(tracks: Tracks, family: Family, at_ms: float) -> Tracks:
    """After a stop: those that it halts are where they were."""
    after = dict(tracks)
    for servo in family.motion.halted_by_stop:
        track = tracks.get(servo)
        if track is None or end_ms(track) <= at_ms:
            continue
        to, leeway = position_of(track, at_ms), leeway_of(track, at_ms, family) + 1
        if to is None:
            del after[servo]
        else:
            after[servo] = Track(to, to, at_ms, 0, leeway, leeway)
    return after


def lengthened(track: Track, until_ms: float) -> Track:
    """It arrives, but from where and when is unknown: by then at the latest."""
    return replace(track, start=None, duration_ms=max(end_ms(track), until_ms) - track.start_ms)


def only(tracks: Tracks, keep: Callable[[Track, int], bool]) -> Tracks:
    """Those of the tracks that `keep` says."""
    return {servo: track for servo, track in tracks.items() if keep(track, servo)}

// Every waiting time of the session, each with its source. Milliseconds. Knows nothing else.

/** Just above the latency timer of USB adapters (16 ms): bytes of one packet come no further apart, usually. */
export const LINE_PAUSE_MS = 20;
/** Far longer than the bytes of one packet are apart, whatever is between: a half packet was cut. */
export const LINE_IDLE_MS = 60;

export { FIRST_MOVE_MS, STOP_REPEATS_MS } from '../motion/haltPlan.ts';

/** Flash erase before the first frame and count table after the last: worst case 1.6 s and 0.4 s (S33, S34). */
export const EDGE_FRAME_TIMEOUT_MS = 2_500;
export const MIDDLE_FRAME_TIMEOUT_MS = 300;
/** How often a download begins again at its first frame before it is given up. */
export const DOWNLOAD_RESTARTS = 2;
/** More late answers in a row than a board can owe: one a packet sent, each doubled on the way, and some. */
export const BABBLE_LIMIT = 12;
/** Count table only: 46 ms typical, 403 ms worst (boards.md section 3, flash times). */
export const ERASE_TIMEOUT_MS = 1_000;
export const BATTERY_TIMEOUT_MS = 500;
/** The acknowledgement comes before the slot is looked up (S18); the margin is for a board busy with its pad (S52). */
export const RUN_TIMEOUT_MS = 500;
/** After this many silent questions in a row the board is taken to have no battery answer. */
export const BATTERY_SILENT_LIMIT = 3;

/** Up to 450 ms for six servos (X7). */
export const POSITION_READ_MS = 75;
/** For adapters that hold bytes back and a board that is busy for a moment. */
export const POSITION_MARGIN_MS = 100;
/** A LeArm takes up to 30 ms (L13); the rest is wire and margin. */
export const DETAIL_TIMEOUT_MS = 300;

/** The soft limit: a whole range in 0.7 s, what a common servo of these robots manages at 6 V with a load. */
export const RANGE_MS = 700;
/** Such servos start this far apart: enough to see which one moves, and not all of them draw their starting current at once. */
export const FIRST_MOVE_STAGGER_MS = 250;

/**
 * Nothing asked for longer ago may still move the robot (safety.md section 5, I3). Hidden pages, whose timers browsers let wait
 * for a second, are to drive nothing either.
 */
export const OVERSLEPT_MS = 500;

/** A group whose end the board did not report is taken to have ended this long after its computed end. */
export const RUN_END_GRACE_MS = 2_000;

/** Waits between attempts to bring a lost link back; the last one repeats. */
export const RECONNECT_DELAYS_MS = [250, 500, 1_000, 2_000, 5_000] as const;

/** A board that has just restarted speaks at once. */
export const IDENTIFY_LISTEN_MS = 200;
/** A LeArm answers nothing for 2.5 to 3 s after a restart (L1). */
export const BOOT_MS = 3_000;
/** Battery and position answers take at most that long (boards.md chapter 6 and X7, for one servo). */
export const IDENTIFY_TIMEOUT_MS = 400;
/** A question may fall into a full mailbox (S52) or a byte of it be lost. */
export const IDENTIFY_ATTEMPTS = 2;

/** An idle board that can answer is asked this often whether it is still there, and more often while it is not. */
export const HEARTBEAT_MS = 5_000;
export const STALE_HEARTBEAT_MS = 2_000;
/** So many silent heartbeats in a row mean that the board is gone: one may have been lost. */
export const HEARTBEAT_MISSES = 2;

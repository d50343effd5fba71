// Every waiting time of the session by its name; the values with their sources are in shared/protocol/timings.json, which the gateway
// reads, too. Milliseconds. Knows nothing else.

import timings from '../../protocol/timings.json' with { type: 'json' };

export const LINE_PAUSE_MS = timings.line.pauseMs;
export const LINE_IDLE_MS = timings.line.idleMs;
export const RECONNECT_DELAYS_MS = timings.line.reconnectMs;

export const STOP_REPEATS = timings.stop.repeats;
export const STOP_EVERY_MS = timings.stop.repeatEveryMs;
export const STRAY_BYTES = timings.stop.strayBytes;
export const HOLDS_AGAIN = timings.stop.holdsAgain;
export const HOLD_AGAIN_MS = timings.stop.holdAgainMs;
export const STOP_AGAIN_MS = timings.stop.againEveryMs;

export const FIRST_MOVE_MS = timings.move.firstMs;
export const FIRST_MOVE_STAGGER_MS = timings.move.firstStaggerMs;
export const RANGE_MS = timings.move.rangeMs;
export const LONGEST_MOVE_MS = timings.move.longestMs;
/** Hidden pages, whose timers browsers let wait for a second, are to drive nothing either. */
export const OVERSLEPT_MS = timings.move.expiresMs;

export const EDGE_FRAME_TIMEOUT_MS = timings.download.edgeFrameTimeoutMs;
export const MIDDLE_FRAME_TIMEOUT_MS = timings.download.middleFrameTimeoutMs;
export const DOWNLOAD_RESTARTS = timings.download.restarts;
export const DOWNLOAD_PORTION_BYTES = timings.download.portionBytes;
export const BABBLE_LIMIT = timings.download.babbleLimit;
export const ERASE_TIMEOUT_MS = timings.erase.timeoutMs;

export const RUN_TIMEOUT_MS = timings.run.timeoutMs;
export const RUN_END_GRACE_MS = timings.run.endGraceMs;

export const CATCH_UP = timings.play.catchUpShare;
export const LATE_MS = timings.play.lateMs;
export const LOOK_MS = timings.play.lookMs;
export const GIVE_UP_MS = timings.play.giveUpMs;
export const MESSAGE_BYTES = timings.play.messageBytes;

export const BATTERY_TIMEOUT_MS = timings.battery.timeoutMs;
export const BATTERY_SILENT_LIMIT = timings.battery.silentLimit;
export const BATTERY_EVERY_MS = timings.battery.everyMs;
export const BATTERY_AFTER_RUN_MS = timings.battery.afterRunMs;
export const POSITION_READ_MS = timings.read.positionMs;
export const POSITION_MARGIN_MS = timings.read.marginMs;
export const DETAIL_TIMEOUT_MS = timings.read.detailTimeoutMs;

export const IDENTIFY_LISTEN_MS = timings.identify.listenMs;
export const BOOT_MS = timings.identify.bootMs;
export const IDENTIFY_TIMEOUT_MS = timings.identify.timeoutMs;
export const IDENTIFY_ATTEMPTS = timings.identify.attempts;
export const HEARTBEAT_MS = timings.heartbeat.everyMs;
export const STALE_HEARTBEAT_MS = timings.heartbeat.staleEveryMs;
export const HEARTBEAT_MISSES = timings.heartbeat.misses;

// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change backend/servodeck/events.py instead.

export type Message = ClientMessage | GatewayMessage;
export type ClientMessage =
  | MoveMessage
  | PlayMessage
  | StopPlayingMessage
  | RunMessage
  | StopGroupMessage
  | EraseMessage
  | SetSpeedMessage
  | ReleaseMessage
  | PacketMessage
  | StopMessage
  | ResumeMessage
  | BoardMessage
  | ReadMessage
  | CalibrateMessage
  | LeaseMessage
  | GrantMessage
  | ContinueMessage
  | HeartbeatMessage;
export type GatewayMessage =
  | WelcomeMessage
  | ActivityMessage
  | BatteryMessage
  | DoneMessage
  | RefusedMessage
  | ReceivedMessage
  | NoiseMessage
  | HaltedMessage
  | ResumedMessage
  | StateMessage
  | RobotMessage
  | LeaseStateMessage
  | TickMessage
  | LeftMessage
  | JobMessage
  | PlayStateMessage
  | PlayedMessage;

/**
 * Move servos. Of each the newest value counts; waiting values leave together, servos of unknown position
 * slowly and one after another. `durationMs` 0: as fast as the servos and the link allow. `nonce` proves
 * that the driver sent it just now. Answered only where it is refused: `left` has the commands that left.
 */
export interface MoveMessage {
  type: 'move';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  /**
   * @minItems 1
   * @maxItems 253
   */
  targets: Target[];
  durationMs: number;
  nonce: string | null;
}
/**
 * The target of a servo, in its board's unit.
 */
export interface Target {
  servo: number;
  position: number;
}
/**
 * Have the gateway play a group; `played` follows when it has ended, or `refused`. One that does not fit
 * into a message: `POST /api/play`.
 */
export interface PlayMessage {
  /**
   * @minItems 1
   * @maxItems 8192
   */
  frames: FrameBody[];
  times?: number;
  loopFrom?: number;
  /**
   * A person wants it although the battery is at its alarm and new runs are refused.
   */
  anyway?: boolean;
  type: 'play';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  /**
   * Of the latest `tick`: shows how old the message is.
   */
  nonce: string;
}
/**
 * Positions by servo number, in the board's unit, reached after `durationMs`.
 */
export interface FrameBody {
  durationMs: number;
  positions: {
    /**
     * This interface was referenced by `undefined`'s JSON-Schema definition
     * via the `patternProperty` "^[1-9][0-9]{0,2}$".
     */
    [k: string]: number;
  };
}
/**
 * The driver ends the play of the gateway with its frame in progress.
 */
export interface StopPlayingMessage {
  type: 'stopPlaying';
}
/**
 * Run the group in `slot`; `times` 0: until it is stopped. A motion in progress ends first.
 */
export interface RunMessage {
  type: 'run';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  slot: number;
  times: number;
  nonce: string | null;
  /**
   * A person wants it although the battery is at its alarm and new runs are refused.
   */
  anyway?: boolean;
}
/**
 * End the running group behind its frame in progress. Everything else is free to move.
 */
export interface StopGroupMessage {
  type: 'stopGroup';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
}
/**
 * Erase every slot of the board.
 */
export interface EraseMessage {
  type: 'erase';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  nonce: string | null;
}
/**
 * Set the speed of the group in `slot`, `null` for every group, until the board is switched off.
 */
export interface SetSpeedMessage {
  type: 'setSpeed';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  slot: number | null;
  percent: number;
  nonce: string | null;
}
/**
 * Take the torque off these servos: what they carry drops.
 */
export interface ReleaseMessage {
  type: 'release';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  /**
   * @minItems 1
   * @maxItems 253
   */
  servos: number[];
  nonce: string | null;
}
/**
 * Put one packet on the wire as it is. A question needs no `nonce`.
 */
export interface PacketMessage {
  type: 'packet';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  /**
   * Bytes of one packet, two hex digits each, no spaces.
   */
  bytes: string;
  nonce: string | null;
}
/**
 * STOP: drop all that waits, send stop three times, hold the robot where it is, and latch. Unknown fields
 * are ignored.
 */
export interface StopMessage {
  type: 'stop';
  reason?: 'person' | 'battery';
}
/**
 * Allow motion again. Moves nothing.
 */
export interface ResumeMessage {
  type: 'resume';
}
/**
 * The family of the board, as a person has chosen it; `unknown`: identify it again.
 */
export interface BoardMessage {
  type: 'board';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  board: string;
}
/**
 * Ask the board now; every client gets its report, and this one `done`. Needs no lease. `servos`:
 * whose positions; some boards report all of them, whichever are named.
 */
export interface ReadMessage {
  type: 'read';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  what: 'battery' | 'positions' | 'version' | 'offsets';
  /**
   * @maxItems 253
   */
  servos: number[];
}
/**
 * This client calibrates `servo` and may move it beyond its present limits, until `null` or the
 * end of its connection.
 */
export interface CalibrateMessage {
  type: 'calibrate';
  servo: number | null;
}
/**
 * `request` the lease: granted at once where it is free, otherwise unless its driver refuses. `release`
 * it, to the client that has requested it if there is one; also withdraws a request. `refuse` a request.
 * `take` it, without a request.
 */
export interface LeaseMessage {
  type: 'lease';
  action: 'request' | 'release' | 'take' | 'refuse';
}
/**
 * The driver or an owner grants the lease to the connected client of that id, without a request.
 */
export interface GrantMessage {
  type: 'grant';
  to: string;
}
/**
 * The driver lets the run in progress continue without one, for so long at most. `null`: not at all.
 */
export interface ContinueMessage {
  type: 'continue';
  forMs: number | null;
}
/**
 * The driver's answer to each `tick`.
 */
export interface HeartbeatMessage {
  type: 'heartbeat';
  /**
   * Of the latest `tick`: shows how old the message is.
   */
  nonce: string;
}
/**
 * The first message on each connection.
 */
export interface WelcomeMessage {
  board: string;
  port: PortState;
  link: LinkState;
  identity: IdentityState;
  latch: boolean;
  latchedBy: ('person' | 'battery' | 'silence' | 'loss') | null;
  stoppedBy: string | null;
  clients: number;
  unattended: UnattendedRun | null;
  brokenSlots: number[];
  slotVersions: {
    [k: string]: StoredGroup;
  };
  waitingToStart: number[];
  mayBeRunning: boolean;
  type: 'welcome';
  version: string;
  robot: RobotState | null;
  lease: LeaseState;
  job: JobState | null;
  play: PlayState | null;
  motion: MotionState;
  activity: ActivityState;
  battery: BatteryUnread | BatteryRead | BatterySilent;
}
/**
 * The state of the serial port. `code` and `detail` say why it is lost, `heldBy` which programs have it
 * open where the system lists them, `retryInMs` when the next attempt follows. `simulated`: it leads to a
 * simulated board. `withheld`: commands that this cable does not carry, although the board may know them.
 */
export interface PortState {
  device: string | null;
  status: 'closed' | 'opening' | 'open' | 'lost';
  simulated: boolean;
  withheld: ('download' | 'erase')[];
  code:
    | (
        | 'closed'
        | 'lost'
        | 'portMissing'
        | 'portBusy'
        | 'portDenied'
        | 'hidDenied'
        | 'otherDevice'
        | 'boardUnknown'
        | 'wrongBoard'
        | 'echo'
        | 'boardSilent'
        | 'noAnswer'
        | 'notSupported'
        | 'notOnThisCable'
        | 'latched'
        | 'notDriving'
        | 'expired'
        | 'busy'
        | 'slotBroken'
        | 'slotChanged'
        | 'batteryLow'
        | 'cancelled'
        | 'outOfRange'
        | 'malformed'
        | 'forbidden'
        | 'notPaired'
        | 'pairingFailed'
        | 'pairingLocked'
        | 'wrongType'
        | 'notFound'
        | 'methodNotAllowed'
        | 'conflict'
        | 'tooLarge'
        | 'tooMany'
        | 'cameraFailed'
        | 'storageFull'
        | 'storageBusy'
        | 'storageFailed'
        | 'damaged'
        | 'internal'
      )
    | null;
  detail: string | null;
  heldBy: string[];
  retryInMs: number | null;
}
/**
 * The link to the board: `identifying` while it is queried, `stale` while it does not answer a
 * question that such a board always answers, `refused` until a person says which board it is. `code` and
 * `detail` say why it is not ready.
 */
export interface LinkState {
  status: 'closed' | 'opening' | 'identifying' | 'ready' | 'stale' | 'refused' | 'lost';
  code:
    | (
        | 'closed'
        | 'lost'
        | 'portMissing'
        | 'portBusy'
        | 'portDenied'
        | 'hidDenied'
        | 'otherDevice'
        | 'boardUnknown'
        | 'wrongBoard'
        | 'echo'
        | 'boardSilent'
        | 'noAnswer'
        | 'notSupported'
        | 'notOnThisCable'
        | 'latched'
        | 'notDriving'
        | 'expired'
        | 'busy'
        | 'slotBroken'
        | 'slotChanged'
        | 'batteryLow'
        | 'cancelled'
        | 'outOfRange'
        | 'malformed'
        | 'forbidden'
        | 'notPaired'
        | 'pairingFailed'
        | 'pairingLocked'
        | 'wrongType'
        | 'notFound'
        | 'methodNotAllowed'
        | 'conflict'
        | 'tooLarge'
        | 'tooMany'
        | 'cameraFailed'
        | 'storageFull'
        | 'storageBusy'
        | 'storageFailed'
        | 'damaged'
        | 'internal'
      )
    | null;
  detail: string | null;
}
/**
 * The answers of the board to its identification, and the families that answer like that.
 */
export interface IdentityState {
  evidence: (AnsweredEvidence | SilentEvidence | EchoedEvidence | NoiseEvidence)[];
  candidates: string[];
}
/**
 * The board answered that question of its identification.
 */
export interface AnsweredEvidence {
  kind: 'answered';
  question: 'readBattery' | 'readVersion' | 'readPositions';
  report: BatteryReport | VersionReport | PositionsReport;
}
export interface BatteryReport {
  kind: 'battery';
  batteryMv: number;
}
/**
 * The kind of the board's servos, by the unit of their positions, and its firmware.
 */
export interface VersionReport {
  kind: 'version';
  unit: 'us' | 'steps';
  version: number;
}
export interface PositionsReport {
  kind: 'positions';
  positions: ServoPosition[];
}
/**
 * In the board's unit.
 */
export interface ServoPosition {
  servo: number;
  position: number;
}
/**
 * It did not answer that question.
 */
export interface SilentEvidence {
  kind: 'silent';
  question: 'readBattery' | 'readVersion' | 'readPositions';
}
/**
 * The request itself came back.
 */
export interface EchoedEvidence {
  kind: 'echoed';
}
/**
 * Bytes came that are no packets.
 */
export interface NoiseEvidence {
  kind: 'noise';
  byteCount: number;
}
/**
 * A run that may continue without its driver `by`, for `endsInMs` at most. `slot` is null where the
 * gateway plays. `isMove`: it is a move of the program `by`, which ends by itself.
 */
export interface UnattendedRun {
  slot: number | null;
  times: number;
  by: string;
  endsInMs: number;
  isMove: boolean;
}
/**
 * The group that was last stored in a slot: its version, name, document in the library, author and time
 * in milliseconds since 1970; null where unknown.
 */
export interface StoredGroup {
  version: string;
  name: string;
  document: string | null;
  by: string;
  atMs: number | null;
}
/**
 * The robot on the board: which document of the library, at which revision; 0 while it is read.
 */
export interface RobotState {
  id: string;
  revision: number;
}
/**
 * The lease, by name: who drives, and who has requested it. `drives` and `hasRequested`: this client
 * does or has. `grantedInMs`: until then the driver may refuse the request. `grantedBy`: the driver or owner
 * who granted it to this client, which drives. `candidates`: the clients to which this one may grant it.
 * `you`: this client's own name; several windows of one browser share it.
 */
export interface LeaseState {
  you: string;
  driver: string | null;
  drives: boolean;
  requestedBy: string | null;
  hasRequested: boolean;
  grantedInMs: number | null;
  mayDrive: boolean;
  mayTake: boolean;
  grantedBy: string | null;
  candidates: Candidate[];
}
/**
 * A connected client that may drive.
 */
export interface Candidate {
  id: string;
  name: string;
}
/**
 * A download and its progress. `slots`: of its groups, in this order; `slot` and `name`: of the one that
 * is being stored, or was last; frames and bytes are of all of them. `by`: the client that began it. `code`
 * and `detail` say why it failed or was cancelled.
 */
export interface JobState {
  id: string;
  by: string;
  status: 'running' | 'done' | 'failed' | 'cancelled';
  slots: number[];
  groupsStored: number;
  slot: number;
  name: string;
  framesStored: number;
  frameCount: number;
  bytesSent: number;
  bytesTotal: number;
  remainingMs: number;
  code:
    | (
        | 'closed'
        | 'lost'
        | 'portMissing'
        | 'portBusy'
        | 'portDenied'
        | 'hidDenied'
        | 'otherDevice'
        | 'boardUnknown'
        | 'wrongBoard'
        | 'echo'
        | 'boardSilent'
        | 'noAnswer'
        | 'notSupported'
        | 'notOnThisCable'
        | 'latched'
        | 'notDriving'
        | 'expired'
        | 'busy'
        | 'slotBroken'
        | 'slotChanged'
        | 'batteryLow'
        | 'cancelled'
        | 'outOfRange'
        | 'malformed'
        | 'forbidden'
        | 'notPaired'
        | 'pairingFailed'
        | 'pairingLocked'
        | 'wrongType'
        | 'notFound'
        | 'methodNotAllowed'
        | 'conflict'
        | 'tooLarge'
        | 'tooMany'
        | 'cameraFailed'
        | 'storageFull'
        | 'storageBusy'
        | 'storageFailed'
        | 'damaged'
        | 'internal'
      )
    | null;
  detail: string | null;
}
/**
 * A play of the gateway by its own clock, and its progress. `times` 0: until stopped. `by`: the client
 * that began it. `lateFrames` began so late that later frames were delayed, by `latestMs` at most;
 * `skippedFrames` did not leave. `batteryUnknown`: new runs are refused at an alarm, and its battery could
 * not be judged. `ended`: before its last frame had ended; `code` and `detail` say why.
 */
export interface PlayState {
  id: string;
  by: string;
  status: 'playing' | 'done' | 'ended';
  frameIndex: number;
  frameCount: number;
  times: number;
  lateFrames: number;
  latestMs: number;
  skippedFrames: number;
  batteryUnknown: boolean;
  code:
    | (
        | 'closed'
        | 'lost'
        | 'portMissing'
        | 'portBusy'
        | 'portDenied'
        | 'hidDenied'
        | 'otherDevice'
        | 'boardUnknown'
        | 'wrongBoard'
        | 'echo'
        | 'boardSilent'
        | 'noAnswer'
        | 'notSupported'
        | 'notOnThisCable'
        | 'latched'
        | 'notDriving'
        | 'expired'
        | 'busy'
        | 'slotBroken'
        | 'slotChanged'
        | 'batteryLow'
        | 'cancelled'
        | 'outOfRange'
        | 'malformed'
        | 'forbidden'
        | 'notPaired'
        | 'pairingFailed'
        | 'pairingLocked'
        | 'wrongType'
        | 'notFound'
        | 'methodNotAllowed'
        | 'conflict'
        | 'tooLarge'
        | 'tooMany'
        | 'cameraFailed'
        | 'storageFull'
        | 'storageBusy'
        | 'storageFailed'
        | 'damaged'
        | 'internal'
      )
    | null;
  detail: string | null;
}
/**
 * The moves of the servos since the port opened, and their reported positions; the position of a servo
 * without either is unknown. `runSlot`: the group that may run. `released`: they have no torque, so a person
 * may have turned them.
 */
export interface MotionState {
  servos: ServoWay[];
  runSlot: number | null;
  released: number[];
  reported: ReportedPosition[];
}
/**
 * A move of a servo, in progress or ended: the time since its start (below 0: not started yet), and its
 * duration. `start` is null where its position at the start is unknown. `goal`: where it goes on to in later
 * parts of its move, in `goal_within_ms`.
 */
export interface ServoWay {
  servo: number;
  start: number | null;
  target: number;
  begunMsAgo: number;
  durationMs: number;
  goal: number | null;
  goalWithinMs: number;
}
/**
 * The position that the board reported for a servo, with its age. `isCurrent`: as far as the gateway
 * knows, the servo has not moved since.
 */
export interface ReportedPosition {
  servo: number;
  position: number;
  ageMs: number;
  isCurrent: boolean;
}
/**
 * What the robot does, whoever began it: the group that may run, and `mayMove`: anything moves, or may as
 * far as the gateway knows, also behind the end of a group.
 */
export interface ActivityState {
  running: ShownRun | null;
  mayMove: boolean;
}
/**
 * `begunMsAgo`: since it left, or since the board reported it. `acknowledged`: the board has received
 * it.
 */
export interface ShownRun {
  slot: number;
  times: number;
  endsInMs: number | null;
  begunMsAgo: number;
  acknowledged: boolean;
}
export interface BatteryUnread {
  kind: 'unread';
}
export interface BatteryRead {
  kind: 'read';
  batteryMv: number;
  ageMs: number;
}
/**
 * Several questions in a row stayed unanswered; `lastMv` is its last report.
 */
export interface BatterySilent {
  kind: 'silent';
  lastMv: number | null;
}
/**
 * What the robot does has changed.
 */
export interface ActivityMessage {
  type: 'activity';
  activity: ActivityState;
}
/**
 * The board has reported its battery, or has stopped answering about it.
 */
export interface BatteryMessage {
  type: 'battery';
  battery: BatteryUnread | BatteryRead | BatterySilent;
}
/**
 * The request with that `id` is done. `outcome`: of a command for the board. `batteryUnknown`: of a run,
 * which is refused at an alarm of its battery, that could not be judged.
 */
export interface DoneMessage {
  type: 'done';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  outcome: ('acknowledged' | 'silent' | 'sent') | null;
  batteryUnknown: boolean;
}
/**
 * `id` is null where the message itself could not be read, and for a stop.
 */
export interface RefusedMessage {
  type: 'refused';
  id: number | null;
  code:
    | 'closed'
    | 'lost'
    | 'portMissing'
    | 'portBusy'
    | 'portDenied'
    | 'hidDenied'
    | 'otherDevice'
    | 'boardUnknown'
    | 'wrongBoard'
    | 'echo'
    | 'boardSilent'
    | 'noAnswer'
    | 'notSupported'
    | 'notOnThisCable'
    | 'latched'
    | 'notDriving'
    | 'expired'
    | 'busy'
    | 'slotBroken'
    | 'slotChanged'
    | 'batteryLow'
    | 'cancelled'
    | 'outOfRange'
    | 'malformed'
    | 'forbidden'
    | 'notPaired'
    | 'pairingFailed'
    | 'pairingLocked'
    | 'wrongType'
    | 'notFound'
    | 'methodNotAllowed'
    | 'conflict'
    | 'tooLarge'
    | 'tooMany'
    | 'cameraFailed'
    | 'storageFull'
    | 'storageBusy'
    | 'storageFailed'
    | 'damaged'
    | 'internal';
  detail: string;
}
/**
 * A report of the board; `bytes` are its packet, for logs.
 */
export interface ReceivedMessage {
  type: 'received';
  report:
    | RunStartedReport
    | RunFinishedReport
    | BatteryReport
    | PositionsReport
    | AllPositionsReport
    | OffsetsReport
    | VersionReport
    | PlainReport
    | UnreadableReport;
  bytes: string;
}
export interface RunStartedReport {
  kind: 'runStarted';
  slot: number;
  times: number;
}
/**
 * `slot` where the board names it.
 */
export interface RunFinishedReport {
  kind: 'runFinished';
  slot: number | null;
}
export interface AllPositionsReport {
  kind: 'allPositions';
  positions: ServoPosition[];
}
export interface OffsetsReport {
  kind: 'offsets';
  offsets: ServoTrim[];
}
/**
 * The trim that a board adds to the positions of a servo, in its unit.
 */
export interface ServoTrim {
  servo: number;
  offset: number;
}
export interface PlainReport {
  kind: 'runAccepted' | 'runStopped' | 'erased' | 'frameStored';
}
/**
 * A packet that no such board is known to send.
 */
export interface UnreadableReport {
  kind: 'unknown';
  command: number;
}
/**
 * Bytes of the board that belong to no packet, or to one that the silence cut short.
 */
export interface NoiseMessage {
  type: 'noise';
  reason: 'garbage' | 'truncated';
  bytes: string;
}
/**
 * The stop sequence has left the wire. `unheld`: servos that may continue to move, if any. It comes again
 * where more is known later.
 */
export interface HaltedMessage {
  type: 'halted';
  outcome: 'sent' | 'confirmed' | 'unanswered';
  unheld: UnheldServos | null;
}
/**
 * Motion that a STOP could not hold: `servos`, `null` where unknown, that may move for `forMs` after the
 * press at most; `null` where the board may not have received the stop.
 */
export interface UnheldServos {
  servos: number[] | null;
  forMs: number | null;
}
/**
 * Another client has resumed: motion is allowed again.
 */
export interface ResumedMessage {
  type: 'resumed';
  by: string;
}
/**
 * Some part of the state has changed.
 */
export interface StateMessage {
  board: string;
  port: PortState;
  link: LinkState;
  identity: IdentityState;
  latch: boolean;
  latchedBy: ('person' | 'battery' | 'silence' | 'loss') | null;
  stoppedBy: string | null;
  clients: number;
  unattended: UnattendedRun | null;
  brokenSlots: number[];
  slotVersions: {
    [k: string]: StoredGroup;
  };
  waitingToStart: number[];
  mayBeRunning: boolean;
  type: 'state';
}
/**
 * Another robot is on the board now, or a robot of the library has changed.
 */
export interface RobotMessage {
  type: 'robot';
  robot: RobotState | null;
}
/**
 * The lease has changed.
 */
export interface LeaseStateMessage {
  type: 'lease';
  lease: LeaseState;
}
/**
 * To the driver, four times a second. It is answered with `heartbeat`; its nonce goes into each message
 * that moves.
 */
export interface TickMessage {
  type: 'tick';
  nonce: string;
}
/**
 * The commands that have left the wire since the last such message, for all clients.
 */
export interface LeftMessage {
  type: 'left';
  commands: (MoveCommand | RunCommand | DownloadCommand | SetSpeedCommand | ServosCommand | PlainCommand)[];
}
/**
 * `goals`: of the servos for which it is a part of a longer move.
 */
export interface MoveCommand {
  kind: 'move';
  durationMs: number;
  targets: ServoPosition[];
  goals: ServoGoal[];
}
/**
 * Where a servo goes on to in later parts of its move, and in how many milliseconds it is there.
 */
export interface ServoGoal {
  servo: number;
  position: number;
  withinMs: number;
}
/**
 * `times` 0 repeats until stopped.
 */
export interface RunCommand {
  kind: 'run';
  slot: number;
  times: number;
}
/**
 * Frame `frameIndex`, from 0, of `frameCount` for `slot`.
 */
export interface DownloadCommand {
  kind: 'download';
  slot: number;
  frameCount: number;
  frameIndex: number;
  frame: StoredFrame;
}
/**
 * Targets reached together after `durationMs`.
 */
export interface StoredFrame {
  durationMs: number;
  targets: ServoPosition[];
}
/**
 * `slot` is null for every group.
 */
export interface SetSpeedCommand {
  kind: 'setSpeed';
  slot: number | null;
  percent: number;
}
/**
 * Releases these servos, or reads their positions.
 */
export interface ServosCommand {
  kind: 'release' | 'readPositions';
  servos: number[];
}
export interface PlainCommand {
  kind: 'stop' | 'erase' | 'readBattery' | 'readVersion' | 'readAllPositions' | 'readOffsets';
}
/**
 * A download began, progressed or ended; the latest one of all clients.
 */
export interface JobMessage {
  type: 'job';
  job: JobState;
}
/**
 * A play of the gateway began, progressed or ended; the latest one of all clients.
 */
export interface PlayStateMessage {
  type: 'play';
  play: PlayState;
}
/**
 * To the client that requested it: that play has ended, and how.
 */
export interface PlayedMessage {
  type: 'played';
  /**
   * Chosen by the client; comes back in the answer.
   */
  id: number;
  play: PlayState;
}
/** Of these messages. */
export const PROTOCOL = 9;

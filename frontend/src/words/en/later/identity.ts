// Words about which board this is: the questions it was asked, what its answers mean, and each family in one line.

import type { Family } from '#shared/protocol/families.ts';
import type { ServoOffset } from '#shared/protocol/reports.ts';
import type { Evidence } from '#shared/session/identity.ts';
import { counted, formatVolts, formatWhole, unitSymbol } from '../numbers.ts';
import { identityWords } from '../identity.ts';

export const wholeIdentityWords = {
  ...identityWords,
  title: { none: 'No robot yet', which: 'Which board is this?', changed: 'Another board answers here' },
  unasked: 'Plug the robot in, switch it on and choose its port. That moves nothing.',
  choosePort: 'Choose its port',
  beforehand: 'Say beforehand which board it is',
  evidence: 'What it answered',
  evidenceOf,
  summary,
  likely: 'Boards that answer like this',
  about: (family: Family): string =>
    `${DESCRIBED[family.id]} ${formatWhole(family.position.min)}–${formatWhole(family.position.max)} ${unitSymbol(family.unit)}`,
  again: 'Ask again',
  againHint: 'Three harmless questions; on a LeArm they end a running group.',
  others: 'Another board',
  silentHint:
    'These always answer something. Choose one only if yours is off at the moment: it is waited for.',
  ruledOut: (names: readonly string[]): string =>
    names.length === 0 ? '' : `Ruled out by what it answered: ${names.join(', ')}.`,
  nickname: 'Name of this board',
  nicknameHint: 'For example “Desk arm”. Kept in this browser.',
  takenFor: (name: string): string => `Taken for: ${name}`,
  change: 'Change the board',
  thisBoard: 'The board at hand',
  notThis: 'Ask it again',
  version: (version: number): string => `Firmware version ${formatWhole(version)}`,
  offsets: (offsets: readonly ServoOffset[]): string => {
    const set = offsets.filter(({ offset }) => offset !== 0);
    const list = set.map(({ servo, offset }) => `servo ${formatWhole(servo)} ${formatWhole(offset)}`);
    return set.length === 0 ? 'No servo has an offset' : `Offsets: ${list.join(', ')}`;
  },
  askDetails: 'Ask for version and offsets',
  unproven: 'Such boards answer no questions, so nothing proves it.',
};

/** By family id; the range is added. */
const DESCRIBED: Readonly<Record<Family['id'], string>> = {
  unknown: '',
  doc: 'By the protocol document: stores groups, up to 32 servos.',
  'openarm-old': 'Arm or hand that says nothing when a group runs.',
  'openarm-new': 'Arm or hand with six servos, on a CH340 cable.',
  'lsc-6': '6 outputs.',
  'lsc-16': '16 outputs.',
  'lsc-24': '24 outputs.',
  'lsc-32': '32 outputs.',
  'bus-ctrl': 'Serial bus servos in a chain.',
  xarm: 'Arm of six bus servos.',
  'learm-esp32': '2025, ESP32 core, PWM servos.',
  'learm-esp32-bus': '2025, ESP32 core, bus servos.',
};

const SILENT: Readonly<Record<string, string>> = {
  readBattery: 'It did not tell its battery.',
  readVersion: 'It did not tell its version.',
  readPositions: 'It did not tell where servo 1 stands.',
};

function evidenceOf(evidence: Evidence): string {
  switch (evidence.kind) {
    case 'silent':
      return SILENT[evidence.question] ?? '';
    case 'echoed':
      return 'Our own question came back.';
    case 'noise':
      return `${counted(evidence.byteCount, 'byte was', 'bytes were')} no packets.`;
    case 'answered':
      return answerOf(evidence.report);
  }
}

function answerOf(report: Extract<Evidence, { kind: 'answered' }>['report']): string {
  switch (report.kind) {
    case 'battery':
      return `It told its battery: ${formatVolts(report.batteryMv)}.`;
    case 'version':
      return `It told its version, ${formatWhole(report.version)}, with ${report.unit === 'us' ? 'PWM' : 'bus'} servos.`;
    case 'positions':
      return `It told where its servos stand: ${report.positions.map(({ position }) => formatWhole(position)).join(', ')}.`;
    default:
      return 'It answered.';
  }
}

/** The whole in a sentence that says what to do. */
function summary(evidence: readonly Evidence[]): string {
  const has = (kind: Evidence['kind']): boolean => evidence.some((one) => one.kind === kind);
  if (has('echoed'))
    return 'This port sends back everything it is given. Check the wiring between adapter and board: RX to TX, TX to RX.';
  if (has('answered'))
    return 'It answered. Choose yours; Servodeck keeps it in mind and checks it at every connection.';
  if (has('noise'))
    return 'Something speaks here, but not in packets. A LeArm does that when it starts: wait until it is ready, press its K1 key once for PC mode, then ask again.';
  return 'Nothing answered. uHand and OpenArm boards never do; choose yours if it is one. Any other is off, not wired, or listens to the phone app: press K1 once on a LeArm, then ask again.';
}

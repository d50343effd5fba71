// A board on this computer's serial port, through the browser's Web Serial. Knows how a port is found and opened; no packets.

import type { ByteChannel } from '#shared/robot/byteChannel.ts';
import { createTabChannel } from './tabChannel.ts';
import { openPort } from './portConnection.ts';
import { createPortFinder } from './portFinder.ts';
import { portLabel } from './serialPorts.ts';

export function createWebSerialChannel(chosen: SerialPort): ByteChannel {
  const label = portLabel(chosen);
  const finder = createPortFinder(chosen);
  return createTabChannel({
    label,
    longestPacket: Infinity,
    lockName: `servodeck port ${label}`,
    connect: async (events) => openPort(await finder.find(), events),
    wentAway: finder.wentAway,
    watch(mayBeBack) {
      navigator.serial.addEventListener('connect', mayBeBack);
      return () => navigator.serial.removeEventListener('connect', mayBeBack);
    },
  });
}

// A board in the page, behind the same interface as a real one. Knows the simulator and how long a packet is on the wire.

import { sleep, type Clock } from '../clock.ts';
import { wireMs } from '../codec/packet.ts';
import { LinkError } from '../session/linkError.ts';
import type { Transport, TransportEvents } from '../session/transport.ts';
import { createBoard, type Board, type BoardOptions } from './board.ts';

export interface SimulatedTransport extends Transport {
  readonly board: Board;
  /** Pulls the cable: the link is lost and opening it fails until `plugIn`. The board itself goes on. */
  unplug(): void;
  plugIn(): void;
}

export function createSimulatedTransport(
  clock: Clock,
  options: Omit<BoardOptions, 'clock' | 'send' | 'onUnplug'> = {},
): SimulatedTransport {
  let events: TransportEvents | null = null;
  let plugged = true;
  let notifyAvailable = (): void => undefined;
  const board = createBoard({ ...options, clock, send: (bytes) => events?.received(bytes), onUnplug: cut });

  function cut(): void {
    const told = events;
    plugged = false;
    events = null;
    told?.lost(new LinkError('lost', 'the simulated cable was pulled'));
  }

  return {
    kind: 'simulated',
    isSimulated: true,
    label: 'Simulated board',
    board,
    open(next) {
      if (!plugged) return Promise.reject(new LinkError('portMissing', 'the simulated cable is pulled'));
      events = next;
      return Promise.resolve();
    },
    async send(packet) {
      if (events === null) throw new LinkError('lost', 'the simulated cable is pulled');
      board.receive(packet);
      await sleep(clock, wireMs(packet.length));
    },
    whenAvailable(notify) {
      notifyAvailable = notify;
      return () => (notifyAvailable = () => undefined);
    },
    close() {
      events = null;
      return Promise.resolve();
    },
    unplug: () => board.unplug(),
    plugIn() {
      plugged = true;
      board.plugIn();
      notifyAvailable();
    },
  };
}

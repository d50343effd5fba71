// A browser's HID devices for tests, below the channel: granted devices, reports, and what Chromium does with a device that went:
// it stays `opened`, and what it is given never settles.

import { splitReport } from './webHid.ts';

export interface FakeBoard {
  readonly device: HIDDevice;
  /** Reports in the order in which the device took them. */
  readonly reports: Uint8Array[];
  /** The packets in them. */
  packets(): readonly Uint8Array[];
  isOpen(): boolean;
  /** As a report; `padding` bytes of zeros behind it, as many as fit without. */
  say(bytes: readonly number[]): void;
  /** From now on it takes reports and never says so. */
  jam(): void;
  /** What is open goes, and the browser reports it. */
  unplug(): void;
}

export interface FakeHid {
  readonly hid: EventTarget;
  /** The next opening fails so. */
  failOpen(name: string): void;
  /** A device that the page may see, as the browser reports it. */
  plugIn(productName?: string): FakeBoard;
  /** The filters of the chooser. */
  readonly requested: HIDDeviceRequestOptions[];
}

export function createHid(): FakeHid {
  const granted = new Set<HIDDevice>();
  const requested: HIDDeviceRequestOptions[] = [];
  let openFailure: string | null = null;
  const hid = Object.assign(new EventTarget(), {
    getDevices: () => Promise.resolve([...granted]),
    requestDevice(options: HIDDeviceRequestOptions) {
      requested.push(options);
      return Promise.resolve([...granted].slice(0, 1));
    },
  });

  function tell(type: 'connect' | 'disconnect', device: HIDDevice): void {
    hid.dispatchEvent(Object.assign(new Event(type), { device }));
  }

  return {
    hid,
    requested,
    failOpen: (name) => (openFailure = name),
    plugIn(productName = 'LOBOT') {
      const reports: Uint8Array[] = [];
      let isThere = true;
      let isJammed = false;
      const never = new Promise<void>(() => undefined);
      const device = Object.assign(new EventTarget(), {
        opened: false,
        vendorId: 0x0483,
        productId: 0x5750,
        productName,
        async open() {
          await Promise.resolve();
          const name = openFailure;
          openFailure = null;
          if (name !== null) throw new DOMException('made for a test', name);
          if (!isThere) throw new DOMException('Failed to open the device.', 'NotAllowedError');
          device.opened = true;
        },
        async close() {
          if (!isThere) await never;
          device.opened = false;
        },
        async sendReport(reportId: number, data: Uint8Array) {
          if (reportId !== 0 || data.length !== 64) throw new TypeError('the device takes no such report');
          if (!isThere) await never;
          reports.push(Uint8Array.from(data));
          if (isJammed) await never;
        },
      });
      const board: FakeBoard = {
        device: device as unknown as HIDDevice,
        reports,
        packets: () => reports.map((report) => splitReport(report).packet),
        isOpen: () => isThere && device.opened,
        say(bytes) {
          const report = new Uint8Array(64);
          report.set(bytes);
          const data = new DataView(report.buffer);
          device.dispatchEvent(Object.assign(new Event('inputreport'), { data, reportId: 0, device }));
        },
        jam: () => void (isJammed = true),
        unplug() {
          isThere = false;
          granted.delete(board.device);
          tell('disconnect', board.device);
        },
      };
      granted.add(board.device);
      tell('connect', board.device);
      return board;
    },
  };
}

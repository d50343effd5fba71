// A pty dressed up as a board's own USB cable, which is HID, for a real Chromium and a real gateway: a mock sysfs for umockdev, with the
// pty as the node of its one board. Linux only.

import { mkdirSync, readlinkSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { python } from './python.mjs';
import { at, mustRun } from './steps.mjs';

export const hidBoard = {
  vendor: 0x0483,
  product: 0x5750,
  maker: 'MyUSB_HID',
  name: 'LOBOT',
  serial: '497223563535',
};

/** @param {number} id @param {number} digits */
const hex = (id, digits) => id.toString(16).toUpperCase().padStart(digits, '0');

const socket = 'devices/pci0000:00/usb1/1-1';
const port = `${socket}/1-1:1.0`;
const hid = `${port}/0003:${hex(hidBoard.vendor, 4)}:${hex(hidBoard.product, 4)}.0001`;
const node = `${hid}/hidraw/hidraw0`;
/** Usage page 0x8C, usage 1; an input and an output report of 64 bytes each, without numbers (boards.md chapter 6). */
const descriptor = '058c0901a101090315002600ff750895408102090415002600ff750895409102c0';

/**
 * A device tree in `folder`, for UMOCKDEV_DIR, with the pty behind `link` as the node of its one board. Its folder must not be called
 * `devices`.
 * @param {string} folder @param {string} link
 */
export function createHidTree(folder, link) {
  const sys = path.join(folder, 'sys');
  const tell = (/** @type {'add' | 'remove'} */ action) =>
    mustRun('tell of a device', python, [at('scripts/uevent.py'), folder, node, action, 'hidraw']);
  for (const made of ['sys/class/hidraw', 'sys/bus/hid/devices', 'sys/bus/usb/devices', 'dev', 'run'])
    mkdirSync(path.join(folder, made), { recursive: true });
  writeBoard(sys, link);
  return {
    tree: folder,
    /** Tells those who watch that the board is there, under whatever name its node has now. */
    async announce() {
      writeBoard(sys, link);
      await tell('add');
    },
    async withdraw() {
      await tell('remove');
      for (const gone of [socket, 'class/hidraw/hidraw0', 'bus/usb/devices/1-1', 'bus/usb/devices/1-1:1.0'])
        rmSync(path.join(sys, gone), { recursive: true, force: true });
      rmSync(path.join(sys, 'bus/hid/devices', path.basename(hid)), { force: true });
    },
  };
}

/** @param {string} sys @param {string} link */
function writeBoard(sys, link) {
  const ids = `PRODUCT=${hidBoard.vendor.toString(16)}/${hidBoard.product.toString(16)}/201`;
  const facts = [
    `HID_ID=0003:${hex(hidBoard.vendor, 8)}:${hex(hidBoard.product, 8)}`,
    `HID_NAME=${hidBoard.maker} ${hidBoard.name}`,
  ];
  const address = ['BUSNUM=001', 'DEVNUM=005', 'MAJOR=189', 'MINOR=4', 'DEVNAME=bus/usb/001/005'];
  write(sys, `${socket}/uevent`, ['DEVTYPE=usb_device', 'DRIVER=usb', ids, 'TYPE=0/0/0', ...address]);
  const texts = {
    idVendor: hex(hidBoard.vendor, 4),
    idProduct: hex(hidBoard.product, 4),
    manufacturer: hidBoard.maker,
  };
  const more = {
    busnum: '1',
    devnum: '5',
    bcdDevice: '0201',
    product: hidBoard.name,
    serial: hidBoard.serial,
    speed: '12',
  };
  for (const [name, text] of Object.entries({ ...texts, ...more })) write(sys, `${socket}/${name}`, [text]);
  write(sys, `${port}/uevent`, [
    'DEVTYPE=usb_interface',
    'DRIVER=usbhid',
    ids,
    'TYPE=0/0/0',
    'INTERFACE=3/0/0',
  ]);
  write(sys, `${port}/bInterfaceNumber`, ['00']);
  write(sys, `${hid}/uevent`, [
    'DRIVER=hid-generic',
    ...facts,
    'HID_PHYS=usb-0000:00:14.0-1/input0',
    `HID_UNIQ=${hidBoard.serial}`,
  ]);
  writeFileSync(path.join(sys, hid, 'report_descriptor'), Buffer.from(descriptor, 'hex'));
  const devname = path.relative('/dev', readlinkSync(link));
  write(sys, `${node}/uevent`, ['MAJOR=240', 'MINOR=0', `DEVNAME=${devname}`]);
  write(sys, `${node}/dev`, ['240:0']);
  symlink(sys, `${socket}/subsystem`, 'bus/usb');
  symlink(sys, 'bus/usb/devices/1-1', socket);
  symlink(sys, `${port}/subsystem`, 'bus/usb');
  symlink(sys, 'bus/usb/devices/1-1:1.0', port);
  symlink(sys, `${hid}/subsystem`, 'bus/hid');
  symlink(sys, `bus/hid/devices/${path.basename(hid)}`, hid);
  symlink(sys, `${node}/device`, hid);
  symlink(sys, `${node}/subsystem`, 'class/hidraw');
  symlink(sys, 'class/hidraw/hidraw0', node);
}

/** @param {string} sys @param {string} file @param {readonly string[]} lines */
function write(sys, file, lines) {
  const whole = path.join(sys, file);
  mkdirSync(path.dirname(whole), { recursive: true });
  writeFileSync(whole, `${lines.join('\n')}\n`);
}

/** @param {string} sys @param {string} from @param {string} to */
function symlink(sys, from, to) {
  const link = path.join(sys, from);
  symlinkSync(path.relative(path.dirname(link), path.join(sys, to)), link);
}

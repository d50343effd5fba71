// What to do when the port is not in the list, by operating system, most likely cause first. Facts about cables, drivers and
// permissions; no panel.

import type { OperatingSystem } from '../../systems.ts';

const EVERYWHERE = [
  'Switch the robot on: many boards are not on the cable’s power alone.',
  'Try another USB cable. Some carry power only.',
] as const;

/** LSC boards, bus servo controllers and older LeArms are no serial port on their own cable (boards.md chapter 6). */
const HID_BOARDS =
  'An LSC board, a Bus Servo Controller or an xArm is no serial port on its own USB cable. Use its 4-pin header (GND, TX, RX) with a USB-to-TTL adapter at 5 V or 3.3 V.';

export const guideWords = {
  title: 'Nothing in the list?',
  system: 'This computer runs',
  systems: {
    windows: 'Windows',
    macos: 'macOS',
    linux: 'Linux',
    chromeos: 'ChromeOS',
  } satisfies Record<OperatingSystem, string>,
  steps: {
    windows: [
      ...EVERYWHERE,
      'Look in the Device Manager under “Ports (COM & LPT)”. A CH340 with a warning sign, or an unknown device, wants the CH341SER driver of its maker, WCH.',
      'Close the maker’s servo program and any serial monitor: only one program can hold a COM port.',
      HID_BOARDS,
    ],
    macos: [
      ...EVERYWHERE,
      'The port is named like “cu.usbserial-110” or “cu.wchusbserial110”. macOS brings its driver along since 10.15; an older one of the maker may get in its way and can be removed.',
      'If macOS asks whether the accessory may connect, allow it.',
      HID_BOARDS,
    ],
    linux: [
      ...EVERYWHERE,
      'Run “sudo dmesg | tail” after plugging in. “ch341-uart converter now attached to ttyUSB0” is right.',
      'If it is detached again at once, the braille service takes CH340 adapters for its own: remove the package “brltty”, then plug in again.',
      'If the port is there and access is denied: “sudo usermod -aG dialout $USER” (on Arch “uucp”), then log out and in again.',
      'A browser from Snap or Flatpak may not see ports: for Snap “sudo snap connect chromium:raw-usb”, or use the browser’s own package.',
      HID_BOARDS,
    ],
    chromeos: [
      ...EVERYWHERE,
      'If ChromeOS offers to connect the device to Linux, do not: the browser would lose it.',
      'On a school’s computer its administrator may have to allow serial ports.',
      HID_BOARDS,
    ],
  } satisfies Record<OperatingSystem, readonly string[]>,
};

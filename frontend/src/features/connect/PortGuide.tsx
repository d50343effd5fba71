// What to do when the robot is not in a chooser's list or may not be opened, for this operating system.

import { useState } from 'react';
import USB from '../../../../shared/protocol/usb.json' with { type: 'json' };
import { Choice } from '../../ui/Toggle.tsx';
import { words, type Words } from '../../i18n/whole.ts';
import { CopyButton } from './CopyButton.tsx';
import { SYSTEMS, operatingSystem, type OperatingSystem } from './operatingSystem.ts';
import styles from './PortGuide.module.css';

/** A serial port, or the board's own USB cable. */
export type GuideKind = 'serial' | 'hid';
type Step = keyof Words['guide']['steps'];

/** The likeliest cause first. LSC boards, bus servo controllers and older LeArms are no serial port on their own cable. */
const STEPS: Readonly<Record<GuideKind, Readonly<Record<OperatingSystem, readonly Step[]>>>> = {
  serial: {
    windows: ['switchOn', 'cable', 'driver', 'comPort', 'hid'],
    macos: ['switchOn', 'cable', 'macName', 'macAllow', 'hid'],
    linux: ['switchOn', 'cable', 'dmesg', 'brltty', 'dialout', 'snap', 'hid'],
    chromeos: ['switchOn', 'cable', 'notLinux', 'school', 'hid'],
  },
  hid: {
    windows: ['switchOn', 'cable', 'hidWindows', 'hidHeld', 'notHid'],
    macos: ['switchOn', 'cable', 'macAllow', 'hidHeld', 'notHid'],
    linux: ['hidRule', 'switchOn', 'cable', 'hidHeld', 'snap', 'notHid'],
    chromeos: ['switchOn', 'cable', 'notLinux', 'school', 'notHid'],
  },
};

/** Right wherever Servodeck is installed, and where it is not: the browser alone may be on this computer. */
const ALLOW_HID = [
  `echo '${USB.hid.rule}' | sudo tee ${USB.hid.ruleFile}`,
  'sudo udevadm control --reload',
  'sudo udevadm trigger --subsystem-match=hidraw',
].join(' && ');

export function PortGuide({ kind }: { readonly kind: GuideKind }) {
  const [system, setSystem] = useState<OperatingSystem>(operatingSystem);
  return (
    <details className={styles.guide}>
      <summary>{words.guide.title[kind]}</summary>
      <Choice<OperatingSystem>
        label={words.guide.system}
        value={system}
        options={SYSTEMS.map((value) => ({ value, label: words.guide.systems[value] }))}
        onChange={setSystem}
      />
      <ol className={styles.steps}>
        {STEPS[kind][system].map((step) => (
          <li key={step}>
            {words.guide.steps[step]}
            {step === 'hidRule' && (
              <div className={styles.command}>
                <code>{ALLOW_HID}</code>
                <CopyButton text={ALLOW_HID} label={words.guide.copy} done={words.guide.copied} />
              </div>
            )}
          </li>
        ))}
      </ol>
    </details>
  );
}

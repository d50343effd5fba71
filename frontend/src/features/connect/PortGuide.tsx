// What to do when the robot's port is not in the list, for this operating system.

import { useState } from 'react';
import { Choice } from '../../ui/Toggle.tsx';
import { words, type Words } from '../../i18n/whole.ts';
import { SYSTEMS, operatingSystem, type OperatingSystem } from './operatingSystem.ts';
import styles from './PortGuide.module.css';

/** The likeliest cause first. LSC boards, bus servo controllers and older LeArms are no serial port on their own cable. */
const STEPS = {
  windows: ['switchOn', 'cable', 'driver', 'comPort', 'hid'],
  macos: ['switchOn', 'cable', 'macName', 'macAllow', 'hid'],
  linux: ['switchOn', 'cable', 'dmesg', 'brltty', 'dialout', 'snap', 'hid'],
  chromeos: ['switchOn', 'cable', 'notLinux', 'school', 'hid'],
} as const satisfies Record<OperatingSystem, readonly (keyof Words['guide']['steps'])[]>;

export function PortGuide({ isOpen = false }: { readonly isOpen?: boolean }) {
  const [system, setSystem] = useState<OperatingSystem>(operatingSystem);
  return (
    <details className={styles.guide} open={isOpen}>
      <summary>{words.guide.title}</summary>
      <Choice<OperatingSystem>
        label={words.guide.system}
        value={system}
        options={SYSTEMS.map((value) => ({ value, label: words.guide.systems[value] }))}
        onChange={setSystem}
      />
      <ol className={styles.steps}>
        {STEPS[system].map((step) => (
          <li key={step}>{words.guide.steps[step]}</li>
        ))}
      </ol>
    </details>
  );
}

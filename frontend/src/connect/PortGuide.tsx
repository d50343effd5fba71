// What to do when the robot's port is not in the list, for this operating system.

import { useState } from 'react';
import { Choice } from '../ui/Toggle.tsx';
import { words } from '../words/whole.ts';
import { SYSTEMS, type OperatingSystem } from '../words/systems.ts';
import { operatingSystem } from './operatingSystem.ts';
import styles from './PortGuide.module.css';

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
        {words.guide.steps[system].map((step) => (
          <li key={step}>{step}</li>
        ))}
      </ol>
    </details>
  );
}

// What to do when the robot is not in a chooser's list or cannot be opened, for this operating system, with commands to copy. The system is a
// guess, and the person can choose another one.

import { useState } from 'react';
import USB from '../../../../shared/protocol/usb.json' with { type: 'json' };
import { Choice } from '../../ui/Toggle.tsx';
import { words, type Words } from '../../i18n/whole.ts';
import styles from './PortGuide.module.css';
import { Button } from '../../ui/Button.tsx';
import { useStores } from '../stores.ts';

const SYSTEMS = ['windows', 'macos', 'linux', 'chromeos'] as const;
type OperatingSystem = (typeof SYSTEMS)[number];

const SIGNS: readonly (readonly [RegExp, OperatingSystem])[] = [
  [/cros|chrome ?os/i, 'chromeos'],
  [/win/i, 'windows'],
  [/mac|iphone|ipad/i, 'macos'],
];

export function operatingSystemIn(platform: string): OperatingSystem {
  return SIGNS.find(([sign]) => sign.test(platform))?.[1] ?? 'linux';
}

function operatingSystem(): OperatingSystem {
  const { userAgentData } = navigator as { userAgentData?: { readonly platform?: string } };
  return operatingSystemIn(userAgentData?.platform ?? navigator.userAgent);
}

/** A serial port, the board's own USB cable, or both at a gateway, without the browser's part. */
export type GuideKind = 'serial' | 'hid' | 'gateway';
type Step = keyof Words['guide']['steps'];

/** The likeliest cause first. LSC boards, bus servo controllers and older LeArms are no serial port on their own cable. */
const STEPS: Readonly<Record<GuideKind, Readonly<Partial<Record<OperatingSystem, readonly Step[]>>>>> = {
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
  gateway: {
    windows: ['switchOn', 'cable', 'driver', 'comPort', 'hidapi', 'lookAgain'],
    macos: ['switchOn', 'cable', 'macName', 'macAllow', 'hidapi', 'lookAgain'],
    linux: ['switchOn', 'cable', 'dmesg', 'brltty', 'dialout', 'hidRule', 'lookAgain'],
  },
};

/** Right wherever Servodeck is installed, and where it is not: the browser alone may be on this computer. */
const ALLOW_HID = [
  `echo '${USB.hid.rule}' | sudo tee ${USB.hid.ruleFile}`,
  'sudo udevadm control --reload',
  'sudo udevadm trigger --subsystem-match=hidraw',
].join(' && ');

export function PortGuide({ kind }: { readonly kind: GuideKind }) {
  const steps = STEPS[kind];
  const systems = SYSTEMS.filter((one) => one in steps);
  const [system, setSystem] = useState<OperatingSystem>(() => likeliestOf(systems));
  return (
    <details className={styles.guide}>
      <summary>{words.guide.title[kind]}</summary>
      {kind === 'gateway' && <p className={styles.there}>{words.guide.there}</p>}
      <Choice<OperatingSystem>
        label={kind === 'gateway' ? words.guide.systemOfGateway : words.guide.system}
        value={system}
        options={systems.map((value) => ({ value, label: words.guide.systems[value] }))}
        onChange={setSystem}
      />
      <ol className={styles.steps}>
        {steps[system]?.map((step) => (
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

/** The one that the browser runs on. At a gateway it may be none of them: Linux, as on the computers in robots. */
function likeliestOf(systems: readonly OperatingSystem[]): OperatingSystem {
  const here = operatingSystem();
  return systems.includes(here) ? here : 'linux';
}

interface CopyButtonProps {
  readonly text: string;
  readonly label: string;
  /** What is said once it is there. */
  readonly done: string;
}

export function CopyButton({ text, label, done }: CopyButtonProps) {
  const { notices } = useStores();
  if (!window.isSecureContext) return null;
  const copy = (): void =>
    void navigator.clipboard.writeText(text).then(() => notices.show('info', done), notices.showError);
  return (
    <Button tone="quiet" icon="copy" onPress={copy}>
      {label}
    </Button>
  );
}

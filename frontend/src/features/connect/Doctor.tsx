// "Something does not work?": what was looked at, what was found, what to do, and all of it as text to send to a helper.

import { useEffect, useState } from 'react';
import { useDevice, useSnapshot, useStores } from '../stores.ts';
import { Mark, type Truth } from '../../ui/Chip.tsx';
import { linkSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { isBoardsOwnCable } from '../../robot/readiness.ts';
import type { ConnectState } from '../../robot/connector.ts';
import type { Way } from '../../robot/device.ts';
import type { FoundRate, GatewayPort } from '../../robot/gatewayPorts.ts';
import { Button } from '../../ui/Button.tsx';
import type { Actions } from './cables.ts';
import { CopyButton } from './PortGuide.tsx';
import { findingsOf, heardIn, interfacesHere, isReadable, type Facts, type Finding } from './doctor.ts';
import styles from './Doctor.module.css';

interface DoctorProps {
  readonly state: ConnectState;
  readonly actions: Pick<Actions, 'findRate'>;
}

export function Doctor({ state, actions }: DoctorProps) {
  const [isOpen, setOpen] = useState(false);
  return (
    <details className={styles.doctor} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>{words.doctor.title}</summary>
      {isOpen && <Findings state={state} actions={actions} />}
    </details>
  );
}

function Findings({ state, actions }: DoctorProps) {
  const { device, notices } = useStores();
  // The way in use is none while it listens there.
  const [found, setFound] = useState<Listening>(null);
  const interfaces = useInterfaces();
  const link = useSnapshot((snapshot) => snapshot.link);
  const isOwnCable = useSnapshot(({ withheld }) => isBoardsOwnCable(withheld));
  const hasAnswered = useSnapshot(({ identity }) =>
    identity.evidence.some(({ kind }) => kind === 'answered'),
  );
  const battery = useSnapshot((snapshot) => snapshot.battery);
  const way = useDevice((known) => known.way);
  if (interfaces === null) return null;
  const facts: Facts = {
    browser: navigator.userAgent,
    isSecure: window.isSecureContext,
    interfaces,
    allowedPorts: state.granted.length,
    gateway: typeof state.gateway === 'object' ? 'answers' : state.gateway,
    ...{ link, way: way?.label ?? null },
    heard: heardIn(device.traffic),
    hasAnswered: hasAnswered || battery.kind === 'read',
    isOwnCable,
    batteryMv: battery.kind === 'read' ? battery.batteryMv : null,
  };
  const listen = (): void => {
    setFound('listening');
    actions.findRate(isReadable).then(
      (rate) => setFound(rate ?? 'none'),
      (error: unknown) => {
        setFound(null);
        notices.showError(error);
      },
    );
  };
  const isUnheard = facts.heard.packets === 0 && !facts.hasAnswered;
  const findings = findingsOf(facts);
  const report = [
    facts.browser,
    ...findings.map((finding) => `${signOf(finding)} ${sentenceOf(finding)}`),
    ...(facts.heard.noise.length > 0 ? [hexOf(facts.heard.noise)] : []),
  ].join('\n');
  return (
    <>
      <ul className={styles.findings}>
        {findings.map((finding, index) => (
          <li key={index}>
            <Mark truth={truthOf(finding)} />
            <span>{sentenceOf(finding)}</span>
          </li>
        ))}
      </ul>
      <div className={styles.acts}>
        {(found !== null || (isUnheard && hasOtherRates(way, state))) && (
          <Button icon="refresh" isPending={found === 'listening'} onPress={listen}>
            {found === 'listening' ? words.doctor.listening : words.doctor.rates}
          </Button>
        )}
        <CopyButton text={report} label={words.doctor.copy} done={words.doctor.copied} />
      </div>
      <p role="status">{foundText(found)}</p>
      {isUnheard && way?.kind === 'gateway' && state.gatewayPorts.length === 0 && (
        <p className={styles.hint}>{words.doctor.ratesByOwner}</p>
      )}
    </>
  );
}

/** It is a serial port, of this computer or one that this page may have the gateway give up. */
function hasOtherRates(way: Way | null, { gatewayPorts }: ConnectState): boolean {
  const isUsed = ({ device, inUse }: GatewayPort): boolean => inUse && !/^(?:hid|ble)\b|:\/\//u.test(device);
  return way?.kind === 'webSerial' || (way?.kind === 'gateway' && gatewayPorts.some(isUsed));
}

type Listening = FoundRate | 'none' | 'listening' | null;

function foundText(found: Listening): string {
  if (found === null || found === 'listening') return '';
  return found === 'none' ? words.doctor.rateNone : words.doctor.rateFound(found);
}

function useInterfaces(): Facts['interfaces'] | null {
  const [interfaces, setInterfaces] = useState<Facts['interfaces'] | null>(null);
  useEffect(() => {
    let isShown = true;
    void interfacesHere().then((found) => {
      if (isShown) setInterfaces(found);
    });
    return () => {
      isShown = false;
    };
  }, []);
  return interfaces;
}

function sentenceOf(finding: Finding): string {
  switch (finding.id) {
    case 'interface':
      return words.doctor.interface({ cable: finding.cable, sight: finding.sight });
    case 'allowedPorts':
      return words.doctor.allowedPorts({ count: finding.count });
    case 'gateway':
      return words.doctor.gateway({ answers: finding.answers });
    case 'link': {
      const { status } = finding.link;
      const why = 'error' in finding.link ? linkSentence(finding.link.error) : '';
      return words.doctor.link({ way: finding.way, status: words.link.status[status], why });
    }
    case 'heardPackets':
      return words.doctor.heardPackets({ count: finding.count });
    case 'heardNoise':
      return words.doctor.heardNoise({ count: finding.count, kind: finding.kind });
    case 'battery':
      return words.doctor.battery({ mv: finding.batteryMv, ms: Math.round(finding.answeredMs ?? 0) });
    case 'heardNothing':
      return finding.isOwnCable ? words.doctor.heardNothingOnOwnCable : words.doctor.heardNothing;
    default:
      return words.doctor[finding.id];
  }
}

function truthOf(finding: Finding): Truth {
  switch (finding.id) {
    case 'interface':
      if (finding.sight === 'seen') return 'confirmed';
      return finding.sight === 'missing' && !finding.isWanted ? 'neutral' : 'warning';
    case 'allowedPorts':
      return finding.count > 0 ? 'confirmed' : 'neutral';
    case 'gateway':
      return finding.answers ? 'confirmed' : 'neutral';
    case 'link':
      return finding.link.status === 'ready' ? 'confirmed' : 'warning';
    case 'secure':
    case 'heardPackets':
    case 'battery':
      return 'confirmed';
    case 'noWay':
      return 'neutral';
    case 'insecure':
    case 'heardNoise':
    case 'heardNothing':
      return 'warning';
  }
}

const SIGNS: Partial<Record<Truth, string>> = { confirmed: 'ok  ', warning: 'look' };

const signOf = (finding: Finding): string => SIGNS[truthOf(finding)] ?? '    ';

const hexOf = (bytes: readonly number[]): string =>
  bytes.map((byte) => byte.toString(16).padStart(2, '0')).join(' ');

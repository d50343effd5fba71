// What the connect dialog shows: the board, and three ways, each with its buttons or with the sentence why it is not
// possible here. Plain values in, choices out; so every case can be shown without a link.

import { useState, type ReactNode } from 'react';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import type { Way } from '../../robot/device.ts';
import { Button } from '../../ui/Button.tsx';
import { ThisBoard } from './identity/ThisBoard.tsx';
import { Chip } from '../../ui/Chip.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { errorSentence } from '../../i18n/sentences/errors.ts';
import { boardName } from '../../i18n/sentences/boards.ts';
import { words } from '../../i18n/whole.ts';
import type { ConnectState } from '../../robot/connector.ts';
import { isProfileName } from '#shared/simulator/profileNames.ts';
import { PortGuide } from './PortGuide.tsx';
import styles from './ConnectWays.module.css';

export interface ConnectWaysProps {
  readonly state: ConnectState;
  readonly current: Way | null;
  /** What is open by the current way answers. */
  readonly isReady: boolean;
  onLook(): void;
  onSimulate(board: FamilyId): void;
  onReconnects(reconnects: boolean): void;
  onGateway(): void;
  onGatewayPort(device: string): void;
  onSerialPort(port: SerialPort): void;
  onChooseSerial(): void;
  onDisconnect(): void;
}

export function ConnectWays(props: ConnectWaysProps) {
  const { state, current } = props;
  return (
    <div className={styles.ways}>
      <ThisBoard />
      <WayCard
        title={words.connect.webSerial.title}
        about={words.connect.webSerial.about}
        isCurrent={current?.kind === 'webSerial'}
        more={state.serialObstacle === null && <PortGuide />}
      >
        <SerialWay {...props} />
      </WayCard>
      <WayCard
        title={words.connect.gateway.title}
        about={words.connect.gateway.about}
        isCurrent={current?.kind === 'gateway'}
        more={typeof state.gateway === 'object' && <PortGuide />}
      >
        <GatewayWay {...props} />
      </WayCard>
      <WayCard
        title={words.connect.simulated.title}
        about={words.connect.simulated.about}
        isCurrent={current?.kind === 'simulated'}
      >
        <SimulatedWay
          board={state.board}
          isOpen={props.isReady && current?.kind === 'simulated'}
          onSimulate={props.onSimulate}
        />
      </WayCard>
      <footer className={styles.foot}>
        <p className={styles.dim}>{words.connect.intro}</p>
        <Toggle label={words.connect.reconnects} isOn={state.reconnects} onChange={props.onReconnects} />
        <Button tone="quiet" isDisabled={current === null} onPress={props.onDisconnect}>
          {words.link.disconnect}
        </Button>
      </footer>
    </div>
  );
}

interface WayCardProps {
  readonly title: string;
  readonly about: string;
  readonly isCurrent: boolean;
  /** Below both columns. */
  readonly more?: ReactNode;
  readonly children: ReactNode;
}

function WayCard({ title, about, isCurrent, more, children }: WayCardProps) {
  return (
    <div className={styles.card} role="group" aria-label={title}>
      <div className={styles.cardText}>
        <h3>
          {title}{' '}
          {isCurrent && (
            <span className={styles.here}>
              <Chip truth="confirmed">{words.connect.here}</Chip>
            </span>
          )}
        </h3>
        <p className={styles.dim}>{about}</p>
      </div>
      <div className={styles.choices}>{children}</div>
      {more}
    </div>
  );
}

interface SimulatedWayProps extends Pick<ConnectWaysProps, 'onSimulate'> {
  readonly board: FamilyId;
  readonly isOpen: boolean;
}

function SimulatedWay({ board, isOpen, onSimulate }: SimulatedWayProps) {
  const [chosen, setChosen] = useState(board);
  const isThisOpen = isOpen && chosen === board;
  return (
    <>
      <select
        className={styles.select}
        aria-label={words.connect.simulated.board}
        value={chosen}
        onChange={(event) => setChosen(event.target.value as FamilyId)}
      >
        {Object.values(FAMILIES)
          .filter(({ id }) => isProfileName(id))
          .map((family) => (
            <option key={family.id} value={family.id}>
              {boardName(family)}
            </option>
          ))}
      </select>
      <Button isDisabled={isThisOpen} onPress={() => onSimulate(chosen)}>
        {isThisOpen ? words.connect.simulated.isOpen : words.connect.simulated.open}
      </Button>
    </>
  );
}

function SerialWay({ state, current, isReady, onSerialPort, onChooseSerial }: ConnectWaysProps) {
  if (state.serialObstacle !== null) {
    return (
      <>
        <p className={styles.why}>{errorSentence(state.serialObstacle)}</p>
        {state.serialObstacle === 'insecureAddress' && (
          <a className={styles.link} href={localAddress()}>
            {words.connect.webSerial.secureLink}
          </a>
        )}
      </>
    );
  }
  const isOpen = isReady && current?.kind === 'webSerial';
  return (
    <>
      {state.granted.map(({ port, label }, index) => (
        <OpenButton
          key={index}
          label={label}
          isOpen={isOpen && port === state.openPort}
          onPress={() => onSerialPort(port)}
        />
      ))}
      {isOpen && <p className={styles.why}>{words.connect.webSerial.inUse}</p>}
      <Button tone={state.granted.length === 0 ? 'plain' : 'quiet'} onPress={onChooseSerial}>
        {words.connect.webSerial.choose}
      </Button>
    </>
  );
}

interface OpenButtonProps {
  readonly label: string;
  readonly isOpen: boolean;
  onPress(): void;
}

/** Says of what is open that it is, and leaves it alone. */
function OpenButton({ label, isOpen, onPress }: OpenButtonProps) {
  return (
    <Button isDisabled={isOpen} onPress={onPress}>
      {isOpen ? words.connect.inUse({ label }) : words.connect.open({ label })}
    </Button>
  );
}

function GatewayWay({ state, current, isReady, onGateway, onGatewayPort, onLook }: ConnectWaysProps) {
  const { gateway, gatewayPorts } = state;
  const look = (
    <Button tone="quiet" icon="refresh" onPress={onLook}>
      {words.connect.gateway.refresh}
    </Button>
  );
  if (gateway === 'looking') return <p className={styles.why}>{words.connect.gateway.looking}</p>;
  if (gateway === 'absent') {
    return (
      <>
        <p className={styles.why}>{errorSentence('gatewayUnreachable')}</p>
        {look}
      </>
    );
  }
  const others = gatewayPorts.filter((port) => !port.inUse || gateway.device === null);
  const isOpen = isReady && current?.kind === 'gateway';
  return (
    <>
      {gateway.device !== null && <OpenButton label={gateway.device} isOpen={isOpen} onPress={onGateway} />}
      {isOpen && (
        <p className={styles.why}>{words.connect.gateway.inUse({ hasOthers: others.length > 0 })}</p>
      )}
      {others.map((port) => (
        <Button key={port.device} tone="quiet" onPress={() => onGatewayPort(port.device)}>
          {words.connect.open({ label: port.device })}
        </Button>
      ))}
      {gatewayPorts.length === 0 && gateway.device === null && (
        <p className={styles.why}>{words.connect.gateway.none}</p>
      )}
      {look}
    </>
  );
}

/** The same page by the loopback address: right whenever the server runs on this very computer. */
function localAddress(): string {
  const url = new URL(location.href);
  url.hostname = '127.0.0.1';
  return url.href;
}

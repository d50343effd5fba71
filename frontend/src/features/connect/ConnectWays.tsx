// What the connect dialog shows: which robot it is, the ways that can lead to it from here, and of the others why they cannot.
// Plain values in, choices out; so every case can be shown without a link.

import { useId, useState, type ReactNode } from 'react';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import type { BodyKind } from '#shared/profile/robot.ts';
import { isProfileName } from '#shared/simulator/profileNames.ts';
import { boardName, errorSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import type { ConnectState } from '../../robot/connector.ts';
import type { Way } from '../../robot/device.ts';
import type { GatewayPort } from '../../robot/gatewayApi.ts';
import { isWithoutGateway } from '../../robot/request.ts';
import { Button } from '../../ui/Button.tsx';
import { Chip } from '../../ui/Chip.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { ThisBoard } from './identity/ThisBoard.tsx';
import { Doctor } from './Doctor.tsx';
import { PortGuide } from './PortGuide.tsx';
import { RobotQuestion } from './RobotQuestion.tsx';
import styles from './ConnectWays.module.css';

export interface ConnectWaysProps {
  readonly state: ConnectState;
  readonly current: Way | null;
  /** What the robot in use is. */
  readonly body: BodyKind;
  /** What is open by the current way answers. */
  readonly isReady: boolean;
  onBody(body: BodyKind): void;
  onLook(): void;
  onSimulate(board: FamilyId): void;
  onReconnects(reconnects: boolean): void;
  onGateway(): void;
  onGatewayPort(device: string): void;
  onSerialPort(port: SerialPort): void;
  onChooseSerial(): void;
  onBoard(board: HIDDevice): void;
  onChooseBoard(all: boolean): void;
  onModule(module: BluetoothDevice): void;
  onChooseModule(): void;
  onDisconnect(): void;
}

interface WayOffer {
  readonly kind: Way['kind'];
  readonly title: string;
  /** Whose way it is, and what the person will meet. */
  readonly about: string;
  /** Why it cannot be used here, and what may be done about it; null where it can. */
  readonly obstacle: ReactNode | null;
  readonly choices: ReactNode;
  readonly guide?: ReactNode;
}

/** The cable in the box of most such robots; it stands first. */
const LIKELIEST: Partial<Record<BodyKind, Way['kind']>> = { humanoid: 'webHid', hexapod: 'webHid' };

export function ConnectWays(props: ConnectWaysProps) {
  const { state, current, body } = props;
  const headingId = useId();
  const offers = offersOf(props);
  const usable = offers
    .filter(({ obstacle }) => obstacle === null)
    .sort((one, other) => Number(other.kind === LIKELIEST[body]) - Number(one.kind === LIKELIEST[body]));
  const others = offers.filter(({ obstacle }) => obstacle !== null);
  return (
    <div className={styles.ways}>
      <ThisBoard />
      <RobotQuestion body={body} onBody={props.onBody} />
      <section className={styles.list} aria-labelledby={headingId}>
        <h3 id={headingId}>{words.connect.how}</h3>
        {usable.map((offer) => (
          <WayCard key={offer.kind} {...offer} isCurrent={current?.kind === offer.kind} />
        ))}
      </section>
      {others.length > 0 && (
        <section className={styles.list} aria-label={words.connect.notHere}>
          <h3>{words.connect.notHere}</h3>
          {others.map(({ kind, title, obstacle }) => (
            <div key={kind} className={styles.obstacle} role="group" aria-label={title}>
              <h4>{title}</h4>
              {obstacle}
            </div>
          ))}
        </section>
      )}
      <Doctor state={state} />
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

function offersOf(props: ConnectWaysProps): readonly WayOffer[] {
  const { state, current, body, isReady } = props;
  return [
    {
      kind: 'webSerial',
      title: words.connect.webSerial.title,
      about: words.connect.webSerial.about({ body }),
      obstacle: state.serialObstacle === null ? null : <SerialObstacle {...props} />,
      choices: <SerialChoices {...props} />,
      guide: <PortGuide />,
    },
    {
      kind: 'webHid',
      title: words.connect.webHid.title,
      about: words.connect.webHid.about,
      obstacle: state.hid.obstacle === null ? null : <HidObstacle code={state.hid.obstacle} />,
      choices: <HidChoices {...props} />,
    },
    {
      kind: 'webBluetooth',
      title: words.connect.webBluetooth.title,
      about: words.connect.webBluetooth.about,
      obstacle:
        state.bluetooth.obstacle === null ? null : <BluetoothObstacle code={state.bluetooth.obstacle} />,
      choices: <BluetoothChoices {...props} />,
    },
    {
      kind: 'gateway',
      title: words.connect.gateway.title,
      about: words.connect.gateway.about,
      obstacle: typeof state.gateway === 'object' ? null : <GatewayObstacle {...props} />,
      choices: typeof state.gateway === 'object' && <GatewayChoices {...props} gateway={state.gateway} />,
      guide: <PortGuide />,
    },
    {
      kind: 'simulated',
      title: words.connect.simulated.title,
      about: words.connect.simulated.about,
      obstacle: null,
      choices: (
        <SimulatedChoices
          board={state.board}
          isOpen={isReady && current?.kind === 'simulated'}
          onSimulate={props.onSimulate}
        />
      ),
    },
  ];
}

interface WayCardProps extends Omit<WayOffer, 'kind' | 'obstacle'> {
  readonly isCurrent: boolean;
}

function WayCard({ title, about, isCurrent, guide, choices }: WayCardProps) {
  return (
    <div className={styles.card} role="group" aria-label={title}>
      <div className={styles.cardText}>
        <h4>
          {title}{' '}
          {isCurrent && (
            <span className={styles.here}>
              <Chip truth="confirmed">{words.connect.here}</Chip>
            </span>
          )}
        </h4>
        <p className={styles.dim}>{about}</p>
      </div>
      <div className={styles.choices}>{choices}</div>
      {guide}
    </div>
  );
}

interface SimulatedChoicesProps extends Pick<ConnectWaysProps, 'onSimulate'> {
  readonly board: FamilyId;
  readonly isOpen: boolean;
}

function SimulatedChoices({ board, isOpen, onSimulate }: SimulatedChoicesProps) {
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

function SerialObstacle({ state: { serialObstacle } }: ConnectWaysProps) {
  if (serialObstacle === null) return null;
  return (
    <>
      <p className={styles.dim}>{errorSentence(serialObstacle)}</p>
      {serialObstacle === 'insecureAddress' && <LocalLink />}
    </>
  );
}

function SerialChoices({ state, current, isReady, onSerialPort, onChooseSerial }: ConnectWaysProps) {
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
      {isOpen && <p className={styles.dim}>{words.connect.webSerial.inUse}</p>}
      <Button tone={state.granted.length === 0 ? 'plain' : 'quiet'} onPress={onChooseSerial}>
        {words.connect.webSerial.choose}
      </Button>
    </>
  );
}

function HidObstacle({ code }: { readonly code: NonNullable<ConnectState['hid']['obstacle']> }) {
  return (
    <>
      <p className={styles.dim}>{words.connect.webHid[code]}</p>
      {code === 'insecureAddress' && <LocalLink />}
    </>
  );
}

function HidChoices({ state, current, isReady, onBoard, onChooseBoard }: ConnectWaysProps) {
  const isOpen = isReady && current?.kind === 'webHid';
  const { granted } = state.hid;
  return (
    <>
      {granted.map(({ board, label }, index) => (
        <OpenButton
          key={index}
          label={label}
          isOpen={isOpen && board === state.openBoard}
          onPress={() => onBoard(board)}
        />
      ))}
      {isOpen && <p className={styles.dim}>{words.connect.webHid.inUse}</p>}
      <Button tone={granted.length === 0 ? 'plain' : 'quiet'} onPress={() => onChooseBoard(false)}>
        {words.connect.webHid.choose}
      </Button>
      <Button tone="quiet" onPress={() => onChooseBoard(true)}>
        {words.connect.webHid.showAll}
      </Button>
    </>
  );
}

type BluetoothObstacleCode = NonNullable<ConnectState['bluetooth']['obstacle']>;

function BluetoothObstacle({ code }: { readonly code: BluetoothObstacleCode }) {
  return (
    <>
      <p className={styles.dim}>
        {code === 'bluetoothOff' ? errorSentence(code) : words.connect.webBluetooth[code]}
      </p>
      {code === 'insecureAddress' && <LocalLink />}
    </>
  );
}

function BluetoothChoices({ state, current, isReady, onModule, onChooseModule }: ConnectWaysProps) {
  const isOpen = isReady && current?.kind === 'webBluetooth';
  const { granted } = state.bluetooth;
  return (
    <>
      {granted.map(({ module, label }) => (
        <OpenButton
          key={module.id}
          label={label}
          isOpen={isOpen && module.id === state.openModule?.id}
          onPress={() => onModule(module)}
        />
      ))}
      {isOpen && <p className={styles.dim}>{words.connect.webBluetooth.inUse}</p>}
      <Button tone={granted.length === 0 ? 'plain' : 'quiet'} onPress={onChooseModule}>
        {words.connect.webBluetooth.choose}
      </Button>
    </>
  );
}

/** The same page where the browser shows its device interfaces. */
function LocalLink() {
  return (
    <a className={styles.link} href={localAddress()}>
      {words.connect.webSerial.secureLink}
    </a>
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

function LookButton({ onLook }: Pick<ConnectWaysProps, 'onLook'>) {
  return (
    <Button tone="quiet" icon="refresh" onPress={onLook}>
      {words.connect.gateway.refresh}
    </Button>
  );
}

function GatewayObstacle({ state, onLook }: ConnectWaysProps) {
  if (state.gateway === 'looking') return <p className={styles.dim}>{words.connect.gateway.looking}</p>;
  if (isWithoutGateway()) return <p className={styles.dim}>{words.connect.gateway.noneHere}</p>;
  return (
    <>
      <p className={styles.dim}>{errorSentence('gatewayUnreachable')}</p>
      <LookButton onLook={onLook} />
    </>
  );
}

interface GatewayChoicesProps extends ConnectWaysProps {
  readonly gateway: Exclude<ConnectState['gateway'], string>;
}

function GatewayChoices({ state: { gatewayPorts }, gateway, current, isReady, ...on }: GatewayChoicesProps) {
  const others = gatewayPorts.filter((port) => !port.inUse || gateway.device === null);
  const isOpen = isReady && current?.kind === 'gateway';
  return (
    <>
      {gateway.device !== null && (
        <OpenButton
          label={gateway.isSimulated ? words.connect.gateway.simulated : nameIn(gatewayPorts, gateway.device)}
          isOpen={isOpen}
          onPress={on.onGateway}
        />
      )}
      {isOpen && (
        <p className={styles.dim}>{words.connect.gateway.inUse({ hasOthers: others.length > 0 })}</p>
      )}
      {others.map((port) => (
        <Button key={port.device} tone="quiet" onPress={() => on.onGatewayPort(port.device)}>
          {words.connect.open({ label: nameOf(port) })}
        </Button>
      ))}
      {gatewayPorts.length === 0 && gateway.device === null && (
        <p className={styles.dim}>{words.connect.gateway.none}</p>
      )}
      <LookButton onLook={on.onLook} />
    </>
  );
}

/** What the system calls the device, and the short end of its path, which tells two of one kind apart. */
function nameOf({ device, description }: GatewayPort): string {
  const end = device.split('/').at(-1) ?? device;
  return description === '' || description === 'n/a' ? end : `${description} (${end})`;
}

function nameIn(ports: readonly GatewayPort[], device: string): string {
  const port = ports.find(({ inUse }) => inUse);
  return nameOf(port ?? { device, description: '', inUse: true });
}

/** The same page by the loopback address: right whenever the server runs on this very computer. */
function localAddress(): string {
  const url = new URL(location.href);
  url.hostname = '127.0.0.1';
  return url.href;
}

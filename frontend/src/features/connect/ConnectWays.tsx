// The content of the connect dialog: which robot it is, the ways that lead to it from here, each with a drawing of its cable, and the reason
// for each way that is not possible. `Ways` takes plain values, so every case can be shown without a link.

import { useId, useState, type ReactNode } from 'react';
import { useStore } from 'zustand';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { isProfileName } from '#shared/simulator/profileNames.ts';
import { boardName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import type { Connector } from '../../robot/connector.ts';
import type { Way } from '../../robot/device.ts';
import { isLineOpen } from '../../robot/readiness.ts';
import { Button } from '../../ui/Button.tsx';
import { Chip } from '../../ui/Chip.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { useDevice, useSnapshot, useStores } from '../stores.ts';
import { CABLES, isOpenBy, LIKELIEST, type Actions, type Cable, type Here, type Obstacle } from './cables.ts';
import { Doctor } from './Doctor.tsx';
import { ThisBoard } from './identity/ThisBoard.tsx';
import { PortGuide } from './PortGuide.tsx';
import { RobotQuestion } from './RobotQuestion.tsx';
import styles from './ConnectWays.module.css';

interface ConnectWaysProps {
  readonly connector: Connector;
  /** Something was chosen. */
  onDone(): void;
}

export function ConnectWays({ connector, onDone }: ConnectWaysProps) {
  const { notices, robots } = useStores();
  const state = useStore(connector.store);
  const robotBody = useStore(robots.store, () => robots.current().robot.body);
  return (
    <Ways
      state={state}
      current={useDevice(({ way }) => way?.kind ?? null)}
      body={state.body ?? robotBody}
      isOpen={useSnapshot(({ link }) => isLineOpen(link))}
      isReady={useSnapshot(({ link }) => link.status === 'ready')}
      actions={connector}
      // Closes at once for what cannot fail here, after the work for what can.
      onChoose={(work) => void Promise.resolve(work()).then(onDone, notices.showError)}
      onLook={() => void connector.look().catch(notices.showError)}
    />
  );
}

export interface WaysProps extends Here {
  readonly actions: Actions;
  onChoose(work: () => void | Promise<void>): void;
  onLook(): void;
}

export function Ways(props: WaysProps) {
  const { state, current, isOpen, body, actions, onChoose } = props;
  const openWay = isOpen ? current : null;
  const headingId = useId();
  const found = CABLES.map((cable) => ({ cable, obstacle: cable.obstacle(state) }));
  const usable = found
    .flatMap(({ cable, obstacle }) => (obstacle === null ? [cable] : []))
    .sort((one, other) => Number(other.kind === LIKELIEST[body]) - Number(one.kind === LIKELIEST[body]));
  const others = found.filter(({ obstacle }) => obstacle !== null);
  return (
    <div className={styles.ways}>
      <ThisBoard />
      <RobotQuestion body={body} onBody={(chosen) => actions.setBody(chosen)} />
      <section className={styles.list} aria-labelledby={headingId}>
        <h3 id={headingId}>{words.connect.how}</h3>
        {usable.map((cable, index) => (
          <WayCard
            key={cable.kind}
            kind={cable.kind}
            about={cable.about(body)}
            listed={cable.listed()}
            isCurrent={openWay === cable.kind}
            guide={cable.guide !== null && <PortGuide kind={cable.guide} />}
          >
            <CableChoices
              cable={cable}
              isFirst={index === 0 && (openWay === null || openWay === 'simulated')}
              {...props}
            />
          </WayCard>
        ))}
        <WayCard
          kind="simulated"
          about={words.connect.simulated.about}
          listed={null}
          isCurrent={openWay === 'simulated'}
        >
          <SimulatedChoices {...props} />
        </WayCard>
      </section>
      {others.length > 0 && (
        <section className={styles.obstacles} aria-label={words.connect.notHere}>
          <h3>{words.connect.notHere}</h3>
          {others.map(({ cable: { kind }, obstacle }) => (
            <div key={kind} className={styles.obstacle} role="group" aria-label={words.connect[kind].title}>
              <h4>{words.connect[kind].title}</h4>
              {obstacle !== null && <ObstacleText {...obstacle} onLook={props.onLook} />}
            </div>
          ))}
        </section>
      )}
      <Doctor state={state} actions={actions} />
      <footer className={styles.foot}>
        <p className={styles.dim}>{words.connect.intro}</p>
        <Toggle
          label={words.connect.reconnects}
          isOn={state.reconnects}
          onChange={(reconnects) => actions.setReconnects(reconnects)}
        />
        <Button
          tone="quiet"
          isDisabled={current === null}
          onPress={() => onChoose(() => actions.disconnect())}
        >
          {words.link.disconnect}
        </Button>
      </footer>
    </div>
  );
}

interface WayCardProps {
  readonly kind: Way['kind'];
  readonly about: string;
  readonly listed: string | null;
  readonly isCurrent: boolean;
  readonly guide?: ReactNode;
  readonly children: ReactNode;
}

function WayCard({ kind, about, listed, isCurrent, guide, children }: WayCardProps) {
  const { title } = words.connect[kind];
  return (
    <div className={styles.card} role="group" aria-label={title}>
      <CablePicture kind={kind} />
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
        {listed !== null && <p>{words.connect.listed({ names: listed })}</p>}
      </div>
      <div className={styles.choices}>{children}</div>
      {guide}
    </div>
  );
}

interface CableChoicesProps extends WaysProps {
  readonly cable: Cable;
  /** Of all ways the likeliest: its first button is the one to press. */
  readonly isFirst: boolean;
}

function CableChoices({ cable, isFirst, actions, onChoose, onLook, ...here }: CableChoicesProps) {
  const note = cable.note(here);
  const devices = cable.devices(here);
  return (
    <>
      {devices.map(({ label, isOpen, open }, index) => (
        // What is open already is left alone.
        <Button
          key={index}
          tone={isFirst && index === 0 ? 'primary' : 'plain'}
          isDisabled={isOpen}
          onPress={() => onChoose(() => open(actions))}
        >
          {isOpen ? words.connect.inUse({ label }) : words.connect.open({ label })}
        </Button>
      ))}
      {note !== null && <p className={styles.dim}>{note}</p>}
      {cable.choosers(here).map(({ label, isQuiet, choose }, index) => (
        <Button
          key={label}
          tone={isQuiet ? 'quiet' : isFirst && devices.length === 0 && index === 0 ? 'primary' : 'plain'}
          onPress={() => onChoose(() => choose(actions))}
        >
          {label}
        </Button>
      ))}
      {cable.canLookAgain && <LookButton onLook={onLook} />}
    </>
  );
}

function SimulatedChoices({ actions, onChoose, ...here }: WaysProps) {
  const { board } = here.state;
  const [chosen, setChosen] = useState(board);
  const isThisOpen = isOpenBy(here, 'simulated') && chosen === board;
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
      <Button isDisabled={isThisOpen} onPress={() => onChoose(() => actions.simulate(chosen))}>
        {isThisOpen ? words.connect.simulated.isOpen : words.connect.simulated.open}
      </Button>
    </>
  );
}

function ObstacleText({ text, remedy, onLook }: Obstacle & Pick<WaysProps, 'onLook'>) {
  return (
    <>
      <p className={styles.dim}>{text}</p>
      {remedy === 'look' && <LookButton onLook={onLook} />}
      {remedy === 'localAddress' && (
        <a className={styles.link} href={localAddress()}>
          {words.connect.webSerial.secureLink}
        </a>
      )}
    </>
  );
}

function LookButton({ onLook }: Pick<WaysProps, 'onLook'>) {
  return (
    <Button tone="quiet" icon="refresh" onPress={onLook}>
      {words.connect.gateway.refresh}
    </Button>
  );
}

/** The same page by the loopback address: right whenever the server runs on this very computer. */
function localAddress(): string {
  const url = new URL(location.href);
  url.hostname = '127.0.0.1';
  return url.href;
}

const USB_PLUG = 'M4 18h14v12H4zM18 14h12v20H18zM8 22h3M8 26h3';

const SHAPES: Readonly<Record<Way['kind'], string>> = {
  // An adapter with a USB plug at one end and the four pins of the header at the other.
  webSerial: `${USB_PLUG}M30 18h10M30 22h10M30 26h10M30 30h10`,
  // The plug of the cable in the box, and the board that it goes into.
  webHid: `${USB_PLUG}M30 24h4M34 12h10v24H34zM38 17h2M38 22h2M38 27h2M38 32h2`,
  // A module on its header, and its antenna.
  webBluetooth:
    'M8 16h18v20H8zM12 36v6M17 36v6M22 36v6M13 21l8 8-4 4V19l4 4-8 8M31 20a8 8 0 0 1 0 12M36 15a15 15 0 0 1 0 22',
  // A computer, its cable and a board.
  gateway: 'M4 10h24v18H4zM10 34h12M16 28v6M28 20h6v6M30 26h14v14H30zM35 31h4v4h-4z',
  // A robot on a screen.
  simulated: 'M4 9h40v26H4zM16 41h16M24 35v6M14 30h10M19 30l-2-9 9-6 6 5M30 22l2-2 2 2',
};

function CablePicture({ kind }: { readonly kind: Way['kind'] }) {
  return (
    <svg className={styles.picture} viewBox="0 0 48 48" width="48" height="48" aria-hidden="true">
      <path d={SHAPES[kind]} fill="none" stroke="currentColor" strokeWidth="1.5" strokeLinejoin="round" />
    </svg>
  );
}

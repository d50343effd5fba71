// The picture of a camera beside the controls: one of the gateway's, read as motion JPEG, or this computer's. Shows how many pictures come
// and how old the newest one is. Knows no robot; moves nothing.

import { useEffect, useRef, useState, type RefObject } from 'react';
import { createStore, useStore } from 'zustand';
import { words } from '../../i18n/whole.ts';
import { isWithoutGateway } from '../../robot/request.ts';
import { Button } from '../../ui/Button.tsx';
import { LiveText } from '../../ui/LiveText.tsx';
import { useEachFrame } from '../../ui/useEachFrame.ts';
import { EmptyState } from '../../ui/Panel.tsx';
import { Select } from '../../ui/Select.tsx';
import { CopyButton } from '../connect/PortGuide.tsx';
import { useStores, useView } from '../stores.ts';
import { type Arrivals, type Cameras, createArrivals, listCameras, reasonIn, watch } from './cameras.ts';
import { type Film, filmOf } from './film.ts';
import { FilmPicture, FilmRow, useShownFilm } from './Film.tsx';
import styles from './CameraView.module.css';

/** This computer's camera, in the choice. */
const HERE = 'here';

/** Where pictures come from. */
export interface CameraAccess {
  /** At the gateway. */
  list(): Promise<Cameras>;
  /** Until it ends; rejects with what ended it. */
  watch: typeof watch;
  /** The browser requests permission. */
  openHere(): Promise<MediaStream>;
}

const ACCESS: CameraAccess = {
  ...{ list: listCameras, watch },
  openHere: () => navigator.mediaDevices.getUserMedia({ video: true }),
};

export function CameraView({ access = ACCESS }: { readonly access?: CameraAccess }) {
  const stores = useStores();
  const { view } = stores;
  const film = filmOf(stores);
  const shownFilm = useShownFilm();
  const chosen = useView(({ camera }) => camera);
  const [cameras, setCameras] = useState<Cameras | null>(null);
  const [problem, setProblem] = useState<string | null>(null);
  const isHere = useView(({ cameraHere }) => cameraHere);
  const list = (): void =>
    void access.list().then(setCameras, (error: unknown) => setProblem(reasonIn(error)));
  useEffect(list, [access]);
  if (cameras === null) {
    const again = (): void => {
      setProblem(null);
      list();
    };
    return (
      <div className={styles.view}>{problem !== null && <Problem text={problem} onAgain={again} />}</div>
    );
  }

  const camera = cameras.find(({ name }) => name === chosen) ?? cameras[0];
  const takeHere = (): void => view.setState({ cameraHere: true });
  if (!isHere && camera === undefined) return <NoCamera onHere={takeHere} />;
  return (
    <div className={styles.view} data-film={shownFilm !== null}>
      {isHere ? (
        <Here open={access.openHere} onPicture={film.take} />
      ) : (
        camera !== undefined && (
          <AtGateway key={camera.id} camera={camera} watch={access.watch} onPicture={film.take} />
        )
      )}
      {shownFilm !== null && <FilmPicture film={shownFilm} className={styles.film ?? ''} />}
      <FilmRow className={styles.filmRow ?? ''} />
      <div className={styles.choice}>
        <Select
          label={words.camera.choice}
          value={isHere ? HERE : String(camera?.id)}
          options={[
            ...cameras.map(({ id, name }) => ({ value: String(id), label: name })),
            { value: HERE, label: words.camera.here },
          ]}
          onChange={(value) => {
            view.setState({ cameraHere: value === HERE });
            const next = cameras.find(({ id }) => String(id) === value);
            if (next !== undefined) view.setState({ camera: next.name });
          }}
        />
      </div>
    </div>
  );
}

const COMMAND = 'servodeck serve --camera Bench=http://ADDRESS/stream';

function NoCamera({ onHere }: { onHere(): void }) {
  return (
    <EmptyState
      title={words.camera.none}
      hint={isWithoutGateway() ? words.camera.noGateway : words.camera.noneHint}
      className={styles.none}
      action={
        <>
          {!isWithoutGateway() && (
            <>
              <code className={styles.command}>{COMMAND}</code>
              <CopyButton text={COMMAND} label={words.guide.copy} done={words.guide.copied} />
            </>
          )}
          <Button onPress={onHere}>{words.camera.useHere}</Button>
        </>
      }
    />
  );
}

interface ProblemProps {
  readonly text: string;
  /** Left out where trying again cannot help. */
  onAgain?(): void;
}

function Problem({ text, onAgain }: ProblemProps) {
  return (
    <div className={styles.problem} role="status">
      <p>{text}</p>
      {onAgain !== undefined && (
        <Button icon="refresh" onPress={onAgain}>
          {words.camera.again}
        </Button>
      )}
    </div>
  );
}

interface Watched {
  /** Why no picture comes; null while it does, or is awaited. */
  readonly problem: string | null;
  readonly isShown: boolean;
}

interface SourceProps {
  /** With each new one. */
  readonly onPicture: Film['take'];
}

interface AtGatewayProps extends Pick<CameraAccess, 'watch'>, SourceProps {
  readonly camera: Cameras[number];
}

function AtGateway({ camera: { id, name }, watch: follow, onPicture }: AtGatewayProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const arrivals = useRef<Arrivals | null>(null);
  const [watched] = useState(() => createStore<Watched>(() => ({ problem: null, isShown: false })));
  const [attempt, setAttempt] = useState(0);
  const { problem, isShown } = useStore(watched);
  useEffect(() => {
    const leaving = new AbortController();
    const counted = createArrivals();
    arrivals.current = counted;
    watched.setState({ problem: null, isShown: false });
    follow(id, leaving.signal, async (picture) => {
      counted.note(performance.now());
      if (!(await draw(picture, canvas)) || canvas.current === null) return;
      watched.setState({ isShown: true });
      void onPicture(canvas.current, canvas.current);
    }).catch((error: unknown) => {
      if (leaving.signal.aborted) return;
      watched.setState({ problem: reasonIn(error) });
      // What is no stream of pictures is read no further.
      leaving.abort();
    });
    return () => leaving.abort();
  }, [id, attempt, watched, follow, onPicture]);
  return (
    <>
      <canvas
        ref={canvas}
        className={styles.picture}
        role="img"
        aria-label={words.camera.picture({ name })}
      />
      {problem !== null && <Problem text={problem} onAgain={() => setAttempt(attempt + 1)} />}
      <p className={styles.facts}>
        {isShown && problem === null && (
          <LiveText
            isSilent
            eachMs={500}
            text={() => figuresOf(arrivals.current)}
            title={words.camera.ageHint}
          />
        )}
        {!isShown && problem === null && words.camera.waiting}
      </p>
    </>
  );
}

function figuresOf(arrivals: Arrivals | null): string {
  if (arrivals === null) return '';
  const { rate, ageMs } = arrivals.figures(performance.now());
  return rate === null ? words.camera.newest({ ms: ageMs }) : words.camera.figures({ rate, ms: ageMs });
}

/** False where it is no picture. */
async function draw(picture: Blob, canvas: RefObject<HTMLCanvasElement | null>): Promise<boolean> {
  const bitmap = await createImageBitmap(picture).catch(() => null);
  const place = canvas.current;
  if (bitmap === null || place === null) return false;
  if (place.width !== bitmap.width) place.width = bitmap.width;
  if (place.height !== bitmap.height) place.height = bitmap.height;
  place.getContext('2d')?.drawImage(bitmap, 0, 0);
  bitmap.close();
  return true;
}

/** Switched off when it is left. */
function Here({ open: openHere, onPicture }: SourceProps & { open: CameraAccess['openHere'] }) {
  const video = useRef<HTMLVideoElement>(null);
  const [problem, setProblem] = useState<string | null>(null);
  const [attempt, setAttempt] = useState(0);
  const lastS = useRef(0);
  useEachFrame(() => {
    const shown = video.current;
    if (shown === null || shown.videoWidth === 0 || shown.currentTime === lastS.current) return;
    lastS.current = shown.currentTime;
    void onPicture(shown, { width: shown.videoWidth, height: shown.videoHeight });
  });
  useEffect(() => {
    let isLeft = false;
    let stream: MediaStream | null = null;
    const stop = (): void => stream?.getTracks().forEach((track) => track.stop());
    async function open(): Promise<void> {
      try {
        stream = await openHere();
        if (isLeft) stop();
        if (isLeft || video.current === null) return;
        video.current.srcObject = stream;
        // Not by `autoplay`: browsers pause that out of sight, and a film would have no pictures.
        await video.current.play();
      } catch (error) {
        const isRefused = error instanceof DOMException && error.name === 'NotAllowedError';
        if (!isLeft) setProblem(isRefused ? words.camera.refused : words.camera.noneHere);
      }
    }
    if (isSecureContext) void open();
    return () => {
      isLeft = true;
      stop();
    };
  }, [attempt, openHere]);
  const again = (): void => {
    setProblem(null);
    setAttempt(attempt + 1);
  };
  return (
    <>
      {!isSecureContext ? (
        <Problem text={words.camera.insecure} />
      ) : problem === null ? (
        <video ref={video} className={styles.picture} aria-label={words.camera.here} muted playsInline />
      ) : (
        <Problem text={problem} onAgain={again} />
      )}
      <p className={styles.facts} />
    </>
  );
}

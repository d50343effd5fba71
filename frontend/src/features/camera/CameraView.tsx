// The picture of a camera beside the controls: one of the gateway's, read as motion JPEG, or this computer's. Shows how many pictures come
// and how old the newest one is. Knows no robot; moves nothing.

import { useEffect, useRef, useState, type RefObject } from 'react';
import * as v from 'valibot';
import { createStore, useStore } from 'zustand';
import { words } from '../../i18n/whole.ts';
import { GatewayProblem, isWithoutGateway, request } from '../../robot/request.ts';
import { Button } from '../../ui/Button.tsx';
import { LiveText } from '../../ui/LiveText.tsx';
import { EmptyState } from '../../ui/Panel.tsx';
import { Select } from '../../ui/Select.tsx';
import { CopyButton } from '../connect/PortGuide.tsx';
import { useStores, useView } from '../stores.ts';
import { boundaryIn, createPartReader } from './mjpeg.ts';
import styles from './CameraView.module.css';

const LIST_WITHIN_MS = 5000;
const listSchema = v.array(v.object({ id: v.number(), name: v.string() }));
type Cameras = v.InferOutput<typeof listSchema>;

/** This computer's camera, in the choice. */
const HERE = 'here';

/** None where no gateway answers; rejects with the reason where one refuses. */
async function listCameras(): Promise<Cameras> {
  if (isWithoutGateway()) return [];
  try {
    return v.parse(listSchema, await request('get', '/api/cameras', { withinMs: LIST_WITHIN_MS }));
  } catch (error) {
    if (error instanceof GatewayProblem && error.code === null) return [];
    throw error;
  }
}

export function CameraView() {
  const { view } = useStores();
  const chosen = useView(({ camera }) => camera);
  const [cameras, setCameras] = useState<Cameras | null>(null);
  const [problem, setProblem] = useState<string | null>(null);
  // This computer's camera is switched on by a press only, not by a reload.
  const [isHere, setIsHere] = useState(false);
  const list = (): void =>
    void listCameras().then(setCameras, (error: unknown) => setProblem(reasonIn(error)));
  useEffect(list, []);
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
  const takeHere = (): void => setIsHere(true);
  if (!isHere && camera === undefined) return <NoCamera onHere={takeHere} />;
  return (
    <div className={styles.view}>
      {isHere ? <Here /> : camera !== undefined && <AtGateway key={camera.id} camera={camera} />}
      <div className={styles.choice}>
        <Select
          label={words.camera.choice}
          value={isHere ? HERE : String(camera?.id)}
          options={[
            ...cameras.map(({ id, name }) => ({ value: String(id), label: name })),
            { value: HERE, label: words.camera.here },
          ]}
          onChange={(value) => {
            setIsHere(value === HERE);
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

/** Of what has arrived; times as `performance.now()`. */
interface Arrivals {
  readonly times: number[];
}

const RATE_OVER_MS = 2000;

function noteArrival({ times }: Arrivals): void {
  const now = performance.now();
  times.push(now);
  while ((times[0] ?? now) < now - RATE_OVER_MS) times.shift();
}

function AtGateway({ camera: { id, name } }: { readonly camera: Cameras[number] }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [arrivals] = useState<Arrivals>({ times: [] });
  const [watched] = useState(() => createStore<Watched>(() => ({ problem: null, isShown: false })));
  const [attempt, setAttempt] = useState(0);
  const { problem, isShown } = useStore(watched);
  useEffect(() => {
    const leaving = new AbortController();
    watched.setState({ problem: null, isShown: false });
    watch(id, leaving.signal, async (picture) => {
      noteArrival(arrivals);
      if (await draw(picture, canvas)) watched.setState({ isShown: true });
    }).catch((error: unknown) => {
      if (leaving.signal.aborted) return;
      watched.setState({ problem: reasonIn(error) });
      // What is no stream of pictures is read no further.
      leaving.abort();
    });
    return () => leaving.abort();
  }, [id, attempt, watched, arrivals]);
  return (
    <>
      <canvas
        ref={canvas}
        className={styles.picture}
        role="img"
        aria-label={words.camera.picture({ name })}
      />
      {problem === null ? (
        <p className={styles.facts}>
          {isShown ? (
            <LiveText isSilent eachMs={500} text={() => figuresOf(arrivals)} title={words.camera.ageHint} />
          ) : (
            words.camera.waiting
          )}
        </p>
      ) : (
        <Problem text={problem} onAgain={() => setAttempt(attempt + 1)} />
      )}
    </>
  );
}

function figuresOf({ times }: Arrivals): string {
  const now = performance.now();
  const recent = times.filter((time) => time > now - RATE_OVER_MS).length;
  return words.camera.figures({
    rate: Math.round((recent * 1000) / RATE_OVER_MS),
    ms: Math.round(Math.max(0, now - (times.at(-1) ?? now))),
  });
}

/** Until it ends; rejects with what ended it. A picture that comes while another one is drawn replaces the one that waits. */
async function watch(id: number, signal: AbortSignal, show: (picture: Blob) => Promise<void>): Promise<void> {
  const answer = await fetch(`api/cameras/${id}/stream`, { signal });
  const boundary = boundaryIn(answer.headers.get('content-type') ?? '');
  if (!answer.ok || answer.body === null || boundary === null) throw await refusalIn(answer);
  const parts = createPartReader(boundary);
  let newest: Blob | null = null;
  let isShowing = false;
  const showNewest = async (): Promise<void> => {
    if (isShowing) return;
    isShowing = true;
    for (let picture = newest; picture !== null; picture = newest) {
      newest = null;
      await show(picture);
    }
    isShowing = false;
  };
  const reader = answer.body.getReader();
  for (let chunk = await reader.read(); !chunk.done; chunk = await reader.read()) {
    const last = parts.push(chunk.value).at(-1);
    if (last === undefined) continue;
    newest = new Blob([last], { type: 'image/jpeg' });
    void showNewest();
  }
  throw new GatewayProblem(null, words.camera.ended);
}

async function refusalIn(answer: Response): Promise<GatewayProblem> {
  const said: unknown = await answer.json().catch(() => null);
  const detail = v.safeParse(v.object({ code: v.string(), detail: v.string() }), said);
  return new GatewayProblem(
    detail.success ? detail.output.code : null,
    detail.success ? detail.output.detail : words.camera.unreachable,
  );
}

function reasonIn(error: unknown): string {
  if (error instanceof GatewayProblem) return error.message;
  // As `fetch` and its readers report a network that fails.
  return error instanceof TypeError ? words.camera.unreachable : words.camera.unreadable;
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

/** The browser requests permission. Switched off when it is left. */
function Here() {
  const video = useRef<HTMLVideoElement>(null);
  const [problem, setProblem] = useState<string | null>(null);
  const [attempt, setAttempt] = useState(0);
  useEffect(() => {
    let isLeft = false;
    let stream: MediaStream | null = null;
    const stop = (): void => stream?.getTracks().forEach((track) => track.stop());
    async function open(): Promise<void> {
      try {
        stream = await navigator.mediaDevices.getUserMedia({ video: true });
        if (isLeft) stop();
        else if (video.current !== null) video.current.srcObject = stream;
      } catch (error) {
        const isRefused = error instanceof DOMException && error.name === 'NotAllowedError';
        setProblem(isRefused ? words.camera.refused : words.camera.noneHere);
      }
    }
    if (isSecureContext) void open();
    return () => {
      isLeft = true;
      stop();
    };
  }, [attempt]);
  if (!isSecureContext) return <Problem text={words.camera.insecure} />;
  return problem === null ? (
    <video ref={video} className={styles.picture} aria-label={words.camera.here} autoPlay muted playsInline />
  ) : (
    <Problem
      text={problem}
      onAgain={() => {
        setProblem(null);
        setAttempt(attempt + 1);
      }}
    />
  );
}

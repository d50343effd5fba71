// The timeline: a grid for keyboard and ears, tracks for eye and hand, both of the same keys. Changes the document alone; the
// playhead moves nothing but the picture of a pose.

import {
  type ClipboardEvent,
  type KeyboardEvent,
  memo,
  type ReactNode,
  type RefObject,
  useCallback,
  useEffect,
  useId,
  useLayoutEffect,
  useRef,
  useState,
} from 'react';
import { useDocument, useStores, useTimeline } from '../../stores.ts';
import { cellId, Rows } from './Rows.tsx';
import { MovingLabel } from '../../picture/MovingText.tsx';
import { instantText } from './valueText.ts';
import { words } from '../../../i18n/whole.ts';
import { AskBox } from './QuestionBox.tsx';
import { copy, cut, paste } from './changes.ts';
import { clipFromText, clipToText } from './clipText.ts';
import { contextOf, useRowRanges, useRows } from './context.ts';
import { keepInStep } from './inStep.ts';
import { BlockRow } from '../blocks/BlockRow.tsx';
import { bringToLife, sizesNow } from './trackCanvas.ts';
import { Minimap } from './Minimap.tsx';
import { heightOf, placedRows, topOfRows } from './rows.ts';
import { StatusText, type Said } from './StatusText.tsx';
import { MENU_KEYS, pressInTimeline } from './timelineActions.ts';
import { TimelineMenu, type OpenMenu } from './TimelineMenu.tsx';
import { TimelineTools } from './TimelineTools.tsx';
import { actionOf, chordOf, runByKey } from '../../../ui/action.ts';
import { PLAY, PREVIEW, STEPS } from '../play/playActions.ts';
import { soundAmong, soundOf } from '../sound/sound.ts';
import { SoundRow } from '../sound/SoundRow.tsx';
import { SpeedRows } from '../speed/SpeedRows.tsx';
import { PART } from '../../../ui/focus.ts';
import styles from './Timeline.module.css';
import { Canvas, type Pen } from '../../picture/Canvas.tsx';
import { xOf } from './timeScale.ts';

// Which cell of the grid the keys are at, for ears. Only one that is there may be named: where the key itself is out
// of sight it is its row, and where that is, too, none. Cells come and go with every scroll, so this looks whenever
// they do.

const NAMES = 'aria-activedescendant';

function useActiveCell(grid: RefObject<HTMLElement | null>, id: string): void {
  const cell = useTimeline(({ cursor }) => cellId(id, cursor.row, cursor.frameId));
  const row = useTimeline(({ cursor }) => cellId(id, cursor.row, null));
  useLayoutEffect(() => {
    const { current } = grid;
    if (current === null) return undefined;
    const name = (): void => {
      const there = [cell, row].find((one) => window.document.getElementById(one) !== null);
      if (there === undefined) current.removeAttribute(NAMES);
      else if (current.getAttribute(NAMES) !== there) current.setAttribute(NAMES, there);
    };
    name();
    const observer = new MutationObserver(name);
    observer.observe(current, { childList: true, subtree: true });
    return () => observer.disconnect();
  }, [grid, cell, row]);
}

export const Timeline = memo(function Timeline() {
  const stores = useStores();
  const id = useId();
  const [menu, setMenu] = useState<OpenMenu | null>(null);
  const [said, setSaid] = useState<Said>(SAYS_NOTHING);
  const scroller = useRef<HTMLDivElement>(null);
  const grid = useRef<HTMLDivElement>(null);
  const tracks = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const box = useRef<HTMLDivElement>(null);
  const menuSpot = useRef<HTMLSpanElement>(null);
  const rows = useRows();
  const columns = useDocument(({ present }) => present.frames.length);
  const isTall = useTimeline((state) => state.isTall);
  const large = useTimeline((state) => state.large);
  // The height of the tracks counts for a row that is open large alone.
  const heightPx = useTimeline((state) => (state.large === null ? 0 : state.heightPx));
  const ranges = useRowRanges();
  const sizes = sizesNow({ isTall, large, heightPx, ranges });
  const totalPx = topOfRows(sizes) + heightOf(placedRows(rows.slice(1), sizes));
  const openMenu = useCallback((kind: OpenMenu['kind'], anchor: Element | null) => {
    setMenu({ kind, anchor: { current: anchor } });
  }, []);
  const openRowMenu = useCallback(
    (row: string, button: Element) => {
      stores.timeline.setState({ cursor: { row, frameId: null } });
      openMenu('row', button);
    },
    [stores, openMenu],
  );

  useLayoutEffect(() => {
    const [area, canvas] = [scroller.current, tracks.current];
    if (area === null || canvas === null) return undefined;
    const measure = (): void =>
      stores.timeline.setState({
        widthPx: canvas.clientWidth,
        heightPx: area.clientHeight,
        scrollTop: area.scrollTop,
      });
    const observer = new ResizeObserver(measure);
    observer.observe(area);
    observer.observe(canvas);
    return () => observer.disconnect();
  }, [stores]);

  useActiveCell(grid, id);

  useEffect(() => keepInStep(stores), [stores]);

  useEffect(() => {
    const parts = {
      ...{ scroller: scroller.current, tracks: tracks.current },
      ...{ canvas: canvas.current, box: box.current },
    };
    if (!areThere(parts)) return undefined;
    return bringToLife(parts, stores, {
      openMenu({ x, y }) {
        if (menuSpot.current === null) return;
        Object.assign(menuSpot.current.style, { left: `${x}px`, top: `${y}px` });
        openMenu('keys', menuSpot.current);
      },
      say: (status, describe) =>
        setSaid((before) =>
          before.status === status && before.describe === describe ? before : { status, describe },
        ),
    });
  }, [stores, openMenu]);

  function key(event: KeyboardEvent): void {
    if (event.target !== grid.current) return;
    const plays = actionOf([PLAY, PREVIEW], event);
    if (MENU_KEYS.keys.includes(chordOf(event))) openMenu('keys', cellAtCursor());
    // The player says what keeps it from playing.
    else if (plays !== undefined) plays.run(stores);
    else if (!runByKey(STEPS, event, stores) && !pressInTimeline(contextOf(stores), event.nativeEvent))
      return;
    event.preventDefault();
  }

  const cellAtCursor = (): Element | null => {
    const { row, frameId } = stores.timeline.getState().cursor;
    const there = (one: string): Element | null => window.document.getElementById(one);
    return there(cellId(id, row, frameId)) ?? there(cellId(id, row, null));
  };

  function put(event: ClipboardEvent, clip: ReturnType<typeof copy>): void {
    if (clip === null) return;
    event.clipboardData.setData('text/plain', clipToText(clip));
    event.preventDefault();
  }

  function take(event: ClipboardEvent): void {
    const text = event.clipboardData.getData('text/plain');
    paste(contextOf(stores), (text === '' ? null : clipFromText(text)) ?? stores.timeline.getState().clip);
    event.preventDefault();
  }

  const takeFocus = useCallback(() => grid.current?.focus({ preventScroll: true }), []);
  const closeMenu = useCallback(() => setMenu(null), []);

  /** As if it had been pressed here; what the browser does of itself, as copying, it does where the focus is by now. */
  function pressHere(event: KeyboardEvent): void {
    event.stopPropagation();
    const again = new window.KeyboardEvent(event.type, event.nativeEvent);
    if (grid.current?.dispatchEvent(again) === false) event.preventDefault();
  }

  return (
    <section
      {...PART}
      className={styles.timeline}
      aria-label={words.timeline.title}
      onDrop={(event) => {
        const file = soundAmong(event.dataTransfer.files);
        if (file === null) return;
        event.preventDefault();
        void soundOf(stores).take(file);
      }}
    >
      <TimelineTools openMenu={openMenu} />
      <SoundRow>
        <PlayheadLine />
      </SoundRow>
      <BlockRow>
        <PlayheadLine />
      </BlockRow>
      <div
        ref={scroller}
        className={styles.scroller}
        style={{ height: totalPx }}
        onScroll={(event) => stores.timeline.setState({ scrollTop: event.currentTarget.scrollTop })}
      >
        <div style={{ height: totalPx }}>
          <Stage>
            <div
              ref={grid}
              id={`${id}tracks`}
              role="grid"
              tabIndex={0}
              className={styles.grid}
              aria-label={words.timeline.grid}
              aria-rowcount={rows.length}
              aria-colcount={columns}
              aria-multiselectable="true"
              onKeyDown={key}
              onCopy={(event) => put(event, copy(contextOf(stores)))}
              onCut={(event) => put(event, cut(contextOf(stores)))}
              onPaste={take}
              onPointerDown={takeFocus}
              // It is one stop: what is pressed in it takes no focus, and keys go on meaning the timeline.
              onMouseDown={(event) => event.preventDefault()}
            >
              <div ref={tracks} className={styles.tracks} role="presentation">
                <canvas ref={canvas} className={styles.canvas} aria-hidden="true" />
                <PlayheadLine />
                <div ref={box} className={styles.box} aria-hidden="true" hidden />
                <span ref={menuSpot} className={styles.menuSpot} aria-hidden="true" />
              </div>
              <Rows {...{ rows, sizes, id, openRowMenu }} />
            </div>
            <Corner />
            {/* A menu that is open keeps the focus to itself, and the field would not get it. */}
            {menu === null && <AskBox onClose={takeFocus} onPass={pressHere} />}
          </Stage>
        </div>
      </div>
      <Minimap tracks={`${id}tracks`} />
      <SpeedRows>
        <PlayheadLine />
      </SpeedRows>
      <StatusText {...said} />
      <TimelineMenu menu={menu} onClose={closeMenu} />
    </section>
  );
});

/** As high as the window onto the rows. */
function Stage({ children }: { readonly children: ReactNode }) {
  const heightPx = useTimeline((state) => state.heightPx);
  return (
    <div className={styles.stage} style={{ height: heightPx }}>
      {children}
    </div>
  );
}

const SAYS_NOTHING: Said = { status: null, describe: undefined };

function areThere<Parts extends object>(
  parts: Parts,
): parts is { [Name in keyof Parts]: NonNullable<Parts[Name]> } {
  return Object.values(parts).every((part) => part !== null);
}

/** Above the names: where the playhead is. */
function Corner() {
  const { playhead } = useStores();
  return (
    <p className={styles.corner}>
      <span className={styles.cornerName}>{words.timeline.playhead}</span>
      <MovingLabel className={styles.instant} colour="ink" text={() => instantText(playhead.at())} />
    </p>
  );
}

// The line over the tracks where the playhead is. On a canvas of its own: moved as an element it would have the browser sort the
// layers of the whole page anew in each frame of a scrub.

const LINE_PX = 1.5;
const HEAD_PX = { width: 10, height: 8 };

export const PlayheadLine = memo(function PlayheadLine() {
  const { timeline } = useStores();
  const shown = (): readonly [number | null] => {
    const { time, playheadMs, widthPx } = timeline.getState();
    const x = xOf(time, playheadMs);
    return [x < 0 || x > widthPx ? null : Math.round(x * 10) / 10];
  };
  return <Canvas className={styles.playhead} shown={shown} paint={paintLine} />;
});

function paintLine({ ctx, look, size }: Pen, [x]: readonly [number | null]): void {
  if (x === null) return;
  ctx.fillStyle = look.ink;
  ctx.fillRect(x - LINE_PX / 2, 0, LINE_PX, size.height);
  ctx.beginPath();
  ctx.moveTo(x - HEAD_PX.width / 2, 0);
  ctx.lineTo(x + HEAD_PX.width / 2, 0);
  ctx.lineTo(x, HEAD_PX.height);
  ctx.fill();
}

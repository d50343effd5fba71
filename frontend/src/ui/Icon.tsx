// The icons: strokes on 16 px, always beside a word or within a named element. Decorative.

import styles from './Icon.module.css';

const PATHS = {
  plus: 'M8 3v10M3 8h10',
  minus: 'M3 8h10',
  close: 'M4 4l8 8M12 4l-8 8',
  play: 'M5 3.5v9l7.5-4.5z',
  record: 'M8 4a4 4 0 1 0 0 8 4 4 0 0 0 0-8z',
  pause: 'M5.5 3.5v9M10.5 3.5v9',
  insertBefore: 'M13 2.5v11M2 8h8M6 4v8',
  insertAfter: 'M3 2.5v11M6 8h8M10 4v8',
  undo: 'M6 3L3 6l3 3M3 6h6.5a3.5 3.5 0 0 1 0 7H6',
  redo: 'M10 3l3 3-3 3M13 6H6.5a3.5 3.5 0 0 0 0 7H10',
  trash: 'M3 4.5h10M6 4.5V3h4v1.5M4.5 4.5l.6 8.5h5.8l.6-8.5',
  copy: 'M6 6h7v7H6zM10 6V3H3v7h3',
  earlier: 'M10 3L5 8l5 5',
  later: 'M6 3l5 5-5 5',
  up: 'M3 10l5-5 5 5',
  width: 'M2 8h12M5 5L2 8l3 3M11 5l3 3-3 3',
  down: 'M3 6l5 5 5-5',
  download: 'M8 2.5v7.5M4.5 7L8 10.5 11.5 7M3 13.5h10',
  file: 'M4 2h5l3 3v9H4zM9 2v3h3',
  save: 'M3 3h8l2 2v8H3zM5.5 3v3.5h4V3M5.5 13V9.5h5V13',
  rest: 'M3 12.5h10M4.5 9.5h7M6 6.5h4',
  mirror: 'M8 2v12M6 4.5L2.5 11.5H6zM10 4.5l3.5 7H10z',
  flip: 'M2 8h12M4.5 6L11.5 2.5V6zM4.5 10l7 3.5V10z',
  buttons: 'M2.5 2.5h4.5v4.5H2.5zM9 2.5h4.5v4.5H9zM2.5 9h4.5v4.5H2.5zM9 9h4.5v4.5H9z',
  fleet: 'M6 3h4v4H6zM3 10h4v4H3zM9 10h4v4H9z',
  kiosk: 'M2.5 3h11v7.5h-11zM6 13.5h4M8 10.5v3',
  refresh: 'M13 3v3.5H9.5M12.7 6.2A5 5 0 1 0 13 9',
  pose: 'M3 13h10M8 13V9L4.5 6.5 8 3.5l4 1.5',
  update: 'M3 3h10v10H3zM5.5 8l2 2 3.5-4',
  centre: 'M8 2v12M2 8h3.5M10.5 8H14',
  live: 'M2 8h3l2-4 2.5 8L11.5 8H14',
  frames: 'M2.5 4h4v8h-4zM9.5 4h4v8h-4z',
  board: 'M3.5 3.5h9v9h-9zM6 1.5v2M10 1.5v2M6 12.5v2M10 12.5v2M1.5 6h2M1.5 10h2M12.5 6h2M12.5 10h2',
  log: 'M3 4h10M3 8h7M3 12h9',
  plug: 'M6 2v4M10 2v4M4 6h8v2a4 4 0 0 1-8 0zM8 12v2.5',
  grip: 'M6 3.5v.01M10 3.5v.01M6 8v.01M10 8v.01M6 12.5v.01M10 12.5v.01',
  half: 'M8 2.5a5.5 5.5 0 1 0 0 11zM8 2.5a5.5 5.5 0 0 1 0 11',
  sun: 'M8 5.2a2.8 2.8 0 1 0 0 5.6 2.8 2.8 0 0 0 0-5.6zM8 1.5v1.7M8 12.8v1.7M1.5 8h1.7M12.8 8h1.7M3.4 3.4l1.2 1.2M11.4 11.4l1.2 1.2M12.6 3.4l-1.2 1.2M4.6 11.4l-1.2 1.2',
  globe:
    'M8 2.5a5.5 5.5 0 1 0 0 11 5.5 5.5 0 0 0 0-11zM2.5 8h11M8 2.5c-3.2 3.3-3.2 7.7 0 11M8 2.5c3.2 3.3 3.2 7.7 0 11',
  moon: 'M12.8 9.6A5.4 5.4 0 0 1 6.4 3.2a5.4 5.4 0 1 0 6.4 6.4z',
  end: 'M4.5 4.5h7v7h-7z',
  tune: 'M2.5 5h11M2.5 11h11M6 3v4M10.5 9v4',
  edit: 'M3 13l.6-2.8L10.8 3l2.2 2.2-7.2 7.2zM9 4.8l2.2 2.2',
  upload: 'M8 11V3M4.5 6.5L8 3l3.5 3.5M3 13.5h10',
  dial: 'M3.5 12a6 6 0 1 1 9 0M8 9.5L11 5.5',
  home: 'M2.5 8L8 3l5.5 5M4.5 7v6h7V7',
  lock: 'M4 7.5h8V13H4zM5.5 7.5V5a2.5 2.5 0 0 1 5 0v2.5',
  solo: 'M8 2.5v2M8 11.5v2M2.5 8h2M11.5 8h2M8 5.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z',
  hide: 'M2 8s2.2-4 6-4 6 4 6 4-2.2 4-6 4-6-4-6-4zM3 13L13 3',
  eye: 'M2 8s2.2-4 6-4 6 4 6 4-2.2 4-6 4-6-4-6-4zM8 6.4a1.6 1.6 0 1 0 0 3.2 1.6 1.6 0 0 0 0-3.2z',
  reverse: 'M13 8a5 5 0 1 1-1.5-3.5M12 2v3H9',
  library: 'M2.5 3h3v10h-3zM5.5 3h3v10h-3zM9 4l2.7-.8 2.8 9.2-2.7.8z',
  people:
    'M6 3a2.2 2.2 0 1 0 0 4.4A2.2 2.2 0 0 0 6 3zM2 13c0-2.6 1.6-4 4-4s4 1.4 4 4M10.5 3.3a2 2 0 0 1 0 3.9M11.5 9.2c1.6.4 2.5 1.7 2.5 3.8',
  keyboard: 'M1.5 4h13v8.5h-13zM4 6.7v.01M6.7 6.7v.01M9.3 6.7v.01M12 6.7v.01M5 10h6',
  more: 'M3.5 8v.01M8 8v.01M12.5 8v.01',
  cut: 'M4.5 9.5a2 2 0 1 0 0 4 2 2 0 0 0 0-4zM11.5 9.5a2 2 0 1 0 0 4 2 2 0 0 0 0-4zM5.6 9.9L11 2.5M10.4 9.9L5 2.5',
  paste: 'M5 3.5H3v10h10v-10h-2M5.5 2.5h5v2.5h-5z',
  duplicate: 'M2.5 8L5 5.5 7.5 8 5 10.5zM8.5 8L11 5.5 13.5 8 11 10.5z',
  marker: 'M4 13.5v-11h8.5l-2 3 2 3H4',
  fit: 'M2.5 3v10M13.5 3v10M5 8h6M6.5 6L4.5 8l2 2M9.5 6l2 2-2 2',
  camera: 'M2 5h3l1-1.5h4L11 5h3v8H2zM8 6.5a2.2 2.2 0 1 0 0 4.4 2.2 2.2 0 0 0 0-4.4z',
  mute: 'M3 6h2l3-2.5v9L5 10H3zM10.5 6l3 4M13.5 6l-3 4',
  erase: 'M2.5 13.5h11M5 11l-2-2 6-6 4 4-4 4z',
} as const;

export type IconName = keyof typeof PATHS;

export function Icon({ name }: { readonly name: IconName }) {
  return (
    <svg className={styles.icon} viewBox="0 0 16 16" aria-hidden="true" focusable="false">
      <path d={PATHS[name]} />
    </svg>
  );
}

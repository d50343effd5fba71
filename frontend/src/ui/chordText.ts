// A chord as it is written on the keys: for hints, menus and the list of all actions, none of which is in the first load.

const SIGNS: Readonly<Record<string, string>> = {
  ...{ ' ': 'Space', Escape: 'Esc', PageUp: 'Page Up', PageDown: 'Page Down' },
  ...{ ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓' },
};

/** As it is written on the keys. */
export function chordText(chord: string): string {
  const { held, key } = partsOf(chord);
  const name = SIGNS[key] ?? (/^\p{Ll}$/u.test(key) ? key.toUpperCase() : key);
  return [...held, name].join('+');
}

function partsOf(chord: string): { readonly held: readonly string[]; readonly key: string } {
  const held = /^(?:(?:Ctrl|Alt|Shift)\+)*/u.exec(chord)?.[0] ?? '';
  return { held: held.split('+').slice(0, -1), key: chord.slice(held.length) };
}

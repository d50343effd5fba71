// Whether the pointer is a finger. Asked for whenever something is drawn: the question itself is put to the browser once.

let coarse: MediaQueryList | undefined;

export function isTouch(): boolean {
  coarse ??= matchMedia('(pointer: coarse)');
  return coarse.matches;
}

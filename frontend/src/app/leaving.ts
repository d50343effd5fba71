// The page goes out of sight, or goes: what is to happen then. The browser promises neither time nor a second chance, so it
// happens before the event's handler returns. Knows the browser's events and no robot.

export interface Leaving {
  /** Timers get slow now, and nobody looks. */
  hidden(): void;
  /** Closed, reloaded, frozen, or kept for the way back. */
  left(): void;
}

export function watchLeaving(page: Pick<Window, 'addEventListener' | 'document'>, leaving: Leaving): void {
  const { document } = page;
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden') leaving.hidden();
  });
  document.addEventListener('freeze', leaving.left);
  page.addEventListener('pagehide', leaving.left);
}

// People and programs by their names.

import { words } from '../words.ts';

/** As the gateway calls them when nobody has paired. */
const SCRIPT = 'A script on this computer';
const COMPUTER = 'This computer';

/** At the start of a sentence. Whoever is called as `you` is another window of the same browser, or of the robot's computer. */
export function personName(name: string, you: string): string {
  return named(name, you, words.lease.names);
}

/** Within a sentence. */
export function personWithin(name: string, you: string): string {
  return named(name, you, words.lease.namesWithin);
}

function named(
  name: string,
  you: string,
  ours: { readonly window: string; readonly script: string },
): string {
  if (name === you) return ours.window;
  return name === SCRIPT ? ours.script : name;
}

/** `by` null: nobody knows. */
export function stoppedBy(by: string | null): string {
  if (by === null) return words.stop.elsewhere;
  if (by === COMPUTER) return words.stop.atComputer;
  return by === SCRIPT ? words.stop.byScript : words.stop.stoppedBy({ name: by });
}

export function mayResumeText({
  driver,
  you,
}: {
  readonly driver: string | null;
  readonly you: string;
}): string {
  return driver === null ? words.stop.onlyDriver : words.stop.mayResume({ name: personName(driver, you) });
}

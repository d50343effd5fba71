// Every change of a page of buttons, as pure functions: (page, arguments) → page. One that changes nothing returns the very
// same object, so that a history can leave it out.

import { COLOURS } from '../document/schema.ts';
import { macroOf, type Macro, type MacroPage, type MacroStep } from './macro.ts';

/** In the colour that comes next, so that neighbours differ. */
export function addMacro(page: MacroPage, name: string, steps: readonly MacroStep[]): MacroPage {
  const colour = COLOURS[page.macros.length % COLOURS.length] ?? 'slate';
  const added: Macro = { id: page.nextId, name, colour, key: null, steps };
  return { macros: [...page.macros, added], nextId: page.nextId + 1 };
}

export function removeMacro(page: MacroPage, id: number): MacroPage {
  const macros = page.macros.filter((macro) => macro.id !== id);
  return macros.length === page.macros.length ? page : { ...page, macros };
}

/** Takes the button out and puts it back as number `index` of the resulting list. */
export function moveMacro(page: MacroPage, id: number, index: number): MacroPage {
  const macro = macroOf(page, id);
  const to = Math.max(0, Math.min(index, page.macros.length - 1));
  if (macro === undefined || page.macros[to] === macro) return page;
  const others = page.macros.filter((one) => one !== macro);
  return { ...page, macros: others.toSpliced(to, 0, macro) };
}

/** A key belongs to one button: the one that had it goes without. */
export function changeMacro(
  page: MacroPage,
  id: number,
  change: Partial<Omit<Macro, 'id' | 'steps'>>,
): MacroPage {
  const before = macroOf(page, id);
  if (before === undefined) return page;
  const after = { ...before, ...change };
  if (after.name === before.name && after.colour === before.colour && after.key === before.key) return page;
  const macros = page.macros.map((macro) => {
    if (macro === before) return after;
    return macro.key !== null && macro.key === after.key ? { ...macro, key: null } : macro;
  });
  return { ...page, macros };
}

export function addStep(page: MacroPage, id: number, step: MacroStep): MacroPage {
  return changeSteps(page, id, (steps) => [...steps, step]);
}

export function setStep(page: MacroPage, id: number, index: number, step: MacroStep): MacroPage {
  return changeSteps(page, id, (steps) => (index in steps ? steps.with(index, step) : steps));
}

export function removeStep(page: MacroPage, id: number, index: number): MacroPage {
  return changeSteps(page, id, (steps) => (index in steps ? steps.toSpliced(index, 1) : steps));
}

export function moveStep(page: MacroPage, id: number, from: number, to: number): MacroPage {
  return changeSteps(page, id, (steps) => {
    const step = steps[from];
    if (step === undefined || !(to in steps) || from === to) return steps;
    return steps.toSpliced(from, 1).toSpliced(to, 0, step);
  });
}

function changeSteps(
  page: MacroPage,
  id: number,
  change: (steps: readonly MacroStep[]) => readonly MacroStep[],
): MacroPage {
  const before = macroOf(page, id);
  if (before === undefined) return page;
  const steps = change(before.steps);
  if (steps === before.steps) return page;
  return { ...page, macros: page.macros.map((macro) => (macro === before ? { ...macro, steps } : macro)) };
}

// The actions of the page of buttons while it is changed, by keys on a button and by tools.

import { moveMacro, removeMacro } from '#shared/profile/macroEdits.ts';
import type { Macro } from '#shared/profile/macro.ts';
import type { Stores } from '../stores.ts';
import { cardActions, placeAt } from '../../ui/cards.ts';
import { words } from '../../i18n/whole.ts';

export interface MacroContext {
  readonly stores: Pick<Stores, 'macros' | 'view' | 'notices'>;
  readonly id: number | null;
}

/** Of the selected button. */
export const macroContextOf = (stores: MacroContext['stores']): MacroContext => ({
  ...{ stores, id: stores.view.getState().selectedButton },
});

const macrosOf = ({ stores }: MacroContext): readonly Macro[] =>
  stores.macros.store.getState().present.macros;
const indexIn = (context: MacroContext): number => macrosOf(context).findIndex(({ id }) => id === context.id);

export const MACRO_ACTIONS = cardActions<MacroContext>({
  label: (name) => words.macros[name === 'remove' ? 'delete' : name],
  select: () => words.macros.select,
  isNone: (context) => indexIn(context) < 0,
  isFirst: (context) => indexIn(context) === 0,
  isLast: (context) => indexIn(context) === macrosOf(context).length - 1,
  move(context, place) {
    const { macros, view, notices } = context.stores;
    const index = indexIn(context);
    const macro = macrosOf(context)[index];
    if (macro === undefined) return;
    const to = placeAt(place, index, macrosOf(context).length);
    macros.edit(
      () => words.macros.edits.move({ name: macro.name }),
      (page) => moveMacro(page, macro.id, to),
    );
    view.setState({ selectedButton: macro.id });
    notices.say(words.macros.moved({ from: index + 1, to: to + 1 }));
  },
  remove(context) {
    const { macros, view } = context.stores;
    const list = macrosOf(context);
    const index = indexIn(context);
    const macro = list[index];
    if (macro === undefined) return;
    macros.edit(
      () => words.macros.edits.delete({ name: macro.name }),
      (page) => removeMacro(page, macro.id),
    );
    view.setState({ selectedButton: list[index + 1]?.id ?? list[index - 1]?.id ?? null });
  },
});

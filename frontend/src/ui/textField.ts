// Where a person writes: keys mean letters there, and Undo is the field's own.

const NO_LETTERS: readonly string[] = ['range', 'checkbox', 'radio', 'button'];

export function isTextField(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !NO_LETTERS.includes(target.type);
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}

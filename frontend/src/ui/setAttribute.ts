// An attribute, written past React only where it becomes another one: writing what is there already would have it painted anew.

export function setAttribute(part: Element | undefined, name: string, value: string): void {
  if (part !== undefined && part.getAttribute(name) !== value) part.setAttribute(name, value);
}

// Writes a text past React.

/** The same piece of text, where there is one: another one would be laid out anew from the ground. */
export function setText(place: HTMLElement, text: string): void {
  const piece = place.firstChild;
  if (!(piece instanceof Text)) place.textContent = text;
  else if (piece.data !== text) piece.data = text;
}

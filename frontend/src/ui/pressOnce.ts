// For a bare button: a key that is held presses once.

import type { KeyboardEvent } from 'react';

export function pressOnce(event: KeyboardEvent): void {
  if (event.repeat && event.key === 'Enter') event.preventDefault();
}

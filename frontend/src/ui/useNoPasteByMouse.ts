// On Linux the middle button pastes into whatever has the focus. Where nobody writes it pans, and a hand that let go of it has
// asked for no keys.

import { useEffect } from 'react';
import { isTextField } from './textField.ts';

const MIDDLE = 1;

export function useNoPasteByMouse(): void {
  useEffect(() => {
    const release = (event: MouseEvent): void => {
      if (event.button === MIDDLE && !isTextField(event.target)) event.preventDefault();
    };
    window.addEventListener('mouseup', release);
    return () => window.removeEventListener('mouseup', release);
  }, []);
}

// A button with a menu of a few choices. The menu's code is fetched when one first opens.

import { useRef, useState, type ReactNode } from 'react';
import { Button, type ButtonProps } from './Button.tsx';
import { later, usePart } from './later.tsx';

interface MenuButtonProps extends Pick<ButtonProps, 'tone'> {
  readonly label: string;
  /** Shown in place of the label. */
  readonly children?: ReactNode;
  readonly choices: readonly { readonly id: string; readonly name: string }[];
  onChoose(id: string): void;
}

const menu = later(async () => (await import('./ChoiceMenu.tsx')).ChoiceMenu);

export function MenuButton({ label, children = label, choices, onChoose, ...button }: MenuButtonProps) {
  const ref = useRef<HTMLButtonElement>(null);
  const [isOpen, setOpen] = useState(false);
  const { part: ChoiceMenu } = usePart(menu, isOpen);
  return (
    <>
      <Button {...button} ref={ref} aria-haspopup="menu" aria-expanded={isOpen} onPress={() => setOpen(true)}>
        {children}
      </Button>
      {ChoiceMenu !== null && (
        <ChoiceMenu {...{ label, choices, onChoose, isOpen }} under={ref} onClose={() => setOpen(false)} />
      )}
    </>
  );
}

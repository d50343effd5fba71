// A picture that changes in each frame, on the sheet of the list it is in, else on a canvas of its own. Knows no needle.

import { use, useEffectEvent, useLayoutEffect, useRef } from 'react';
import { Sight } from '../../ui/sight.ts';
import { Canvas, type Picture } from './Canvas.tsx';
import { SheetAround, type Sheet } from './sheet.ts';

export interface DrawingProps<Shown extends readonly unknown[]> extends Picture<Shown> {
  readonly className?: string | undefined;
}

export function Drawing<Shown extends readonly unknown[]>(props: DrawingProps<Shown>) {
  const sheet = use(SheetAround);
  return sheet === null ? <Canvas {...props} /> : <Part sheet={sheet} {...props} />;
}

interface PartProps<Shown extends readonly unknown[]> extends DrawingProps<Shown> {
  readonly sheet: Sheet;
}

function Part<Shown extends readonly unknown[]>({ sheet, className, shown, paint }: PartProps<Shown>) {
  const place = useRef<HTMLSpanElement>(null);
  const sight = use(Sight);
  const shownNow = useEffectEvent(shown);
  const paintNow = useEffectEvent(paint);
  useLayoutEffect(() => {
    if (place.current === null) return undefined;
    return sheet.add<Shown>({
      place: place.current,
      sight,
      shown: () => shownNow(),
      paint: (pen, now) => paintNow(pen, now),
    });
  }, [sheet, sight]);
  return <span ref={place} className={className} aria-hidden="true" />;
}

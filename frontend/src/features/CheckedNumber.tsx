// A number with a range, anywhere in the page: one beyond it is refused by a notice that names the field and the range.

import { words } from '../i18n/words.ts';
import { NumberField, type NumberFieldProps } from '../ui/NumberField.tsx';
import { useStores } from './stores.ts';

export function CheckedNumber(props: Omit<NumberFieldProps, 'onRefused'>) {
  const { notices } = useStores();
  const { label: name, min, max } = props;
  return (
    <NumberField {...props} onRefused={(value) => notices.refuse(words.refused({ name, value, min, max }))} />
  );
}

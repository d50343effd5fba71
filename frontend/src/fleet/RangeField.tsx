// A number field that says below it which numbers it takes, until one of them is typed.

import { useState } from 'react';
import { words } from '../i18n/whole.ts';
import { NumberField, type NumberFieldProps } from '../ui/NumberField.tsx';
import styles from './Fleet.module.css';

export function RangeField(props: Omit<NumberFieldProps, 'onRefused'>) {
  const { label: name, min, max } = props;
  const [problem, setProblem] = useState('');
  return (
    <span className={styles.range}>
      <NumberField
        {...props}
        onRefused={(value) => {
          setProblem(words.refused({ name, value, min, max }));
          return () => setProblem('');
        }}
      />
      <span role="alert" className={styles.warning}>
        {problem}
      </span>
    </span>
  );
}

// What the address that this page was opened at means: who can listen in, and what a browser keeps back there.

import { words } from '../../i18n/whole.ts';
import styles from './People.module.css';

export function AddressNotes({ overheard }: { readonly overheard: boolean }) {
  return (
    <>
      {overheard && <p className={styles.dim}>{words.people.overheard}</p>}
      {!window.isSecureContext && <p className={styles.dim}>{words.people.insecure}</p>}
    </>
  );
}

// What a file's name says of its group, and the name that a group's file gets. Vendor programs name the slot there:
// `12号`, `No.10 wave`, `10 wave` (boards.md section 7). Knows no content.

import { GROUP_NAME_LENGTH } from '../group/group.ts';

export interface Named {
  readonly name: string;
  readonly slot: number | null;
}

const SLOT_MARKS = [/(\d{1,3})\s*号/, /^\s*No\.?\s*(\d{1,3})(?!\d)/i, /^\s*(\d{1,3})(?=\s|$)/];

export function namedByFile(fileName: string): Named {
  const stem = fileName.replace(/\.[^.]{0,8}$/, '');
  for (const mark of SLOT_MARKS) {
    const found = mark.exec(stem);
    const slot = Number(found?.[1]);
    if (found === null || slot > 0xff) continue;
    const rest = stem.replace(found[0], '').replace(/^[\s._-]+/, '');
    return { name: nameOf(rest, stem), slot };
  }
  return { name: nameOf(stem, fileName), slot: null };
}

/** Whatever file systems do not bear is left out. */
export function fileNameOf(group: Named, extension: string): string {
  const plain = group.name.replaceAll(/[^\p{L}\p{N} ._-]/gu, '').trim();
  const named = plain === '' ? 'group' : plain;
  const stem = `${group.slot === null ? '' : `${group.slot} `}${named}`;
  return `${extension === '.ino' ? sketchName(stem) : stem}${extension}`;
}

const LONGEST_SKETCH = 59;

/** Arduino's programs open a sketch by no other name (Arduino sketch specification): basic letters, digits, `_`, `.`, `-`. */
function sketchName(stem: string): string {
  const basic = stem
    .normalize('NFKD')
    .replaceAll(/\p{M}/gu, '')
    .replaceAll(/[^A-Za-z0-9_.-]+/g, '_');
  const name = basic.slice(0, LONGEST_SKETCH).replaceAll(/^[_.-]+|[_.-]+$/g, '');
  return name === '' ? 'group' : name;
}

const nameOf = (text: string, otherwise: string): string =>
  (text.trim() === '' ? otherwise : text).trim().slice(0, GROUP_NAME_LENGTH);

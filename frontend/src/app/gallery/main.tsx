// The gallery's entry; `?language=zh` in the address shows it in Chinese.

import { createRoot } from 'react-dom/client';
import { Gallery } from './Gallery.tsx';
import { preferredLanguage, speak } from '../../i18n/words.ts';
import '../../ui/fonts.css';
import '../../ui/tokens.css';
import '../../ui/base.css';

const root = document.getElementById('page');
if (root === null) throw new Error('gallery.html has no #page');
const wanted = new URLSearchParams(location.search).get('language');
// No top-level await: Chinese imports from this chunk, and each would wait for the other.
void speak(preferredLanguage(wanted === null ? [] : [wanted])).then(() =>
  createRoot(root).render(<Gallery />),
);

// The gallery's entry.

import { createRoot } from 'react-dom/client';
import { Gallery } from './Gallery.tsx';
import '../ui/fonts.css';
import '../ui/tokens.css';
import '../ui/base.css';

const root = document.getElementById('page');
if (root === null) throw new Error('gallery.html has no #page');
createRoot(root).render(<Gallery />);

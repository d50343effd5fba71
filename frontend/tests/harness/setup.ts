// Before anything of the page is read: its time is the tests'.

import './time.ts';

// How a request says that our own page makes it: a browser adds no Origin to a GET, and no other page may add this header.

export const OWN_PAGE: Readonly<Record<string, string>> = { 'x-servodeck-page': '1' };

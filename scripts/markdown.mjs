// Links in the Markdown files, for the check of the sources and for the documentation site. Knows no page by name.

/** The address is the first group. */
export const LINK = /!?\[[^\]]*\]\(<?([^)\s>]+)>?(?:\s+"[^"]*")?\)/g;
export const CODE_SPAN = /`([^`\n]+)`/g;

/** Each character but line ends becomes a space, so that places stay what they were. @param {string} text */
const blank = (text) => text.replace(/[^\n]/g, ' ');

/** @param {string} text @returns {string} without fenced blocks, lines kept */
export const withoutFences = (text) => text.replace(/^( *)(```|~~~)[^\n]*\n[\s\S]*?^\1\2[^\n]*$/gm, blank);

/** What is not code, each link at its place. @param {string} text */
export function linksIn(text) {
  return [...withoutFences(text).replace(CODE_SPAN, blank).matchAll(LINK)].map((found) => {
    const address = found[1] ?? '';
    return { address, index: found.index, start: found.index + found[0].lastIndexOf(`](`) + 2 };
  });
}

/** @param {string} address */
export const leadsOutside = (address) => /^[a-z]+:/i.test(address);

/** Of each heading in order, as GitHub names it. @param {string} text @returns {string[]} */
export function anchorsOf(text) {
  /** @type {Map<string, number>} */
  const seen = new Map();
  return [...withoutFences(text).matchAll(/^#{1,6} +(.+)$/gm)].map(([, heading = '']) => {
    const slug = heading
      .replace(/\[([^\]]*)\]\([^)]*\)/g, '$1')
      .toLowerCase()
      .replace(/[^\p{L}\p{N}\p{M} _-]/gu, '')
      .trim()
      .replaceAll(' ', '-');
    const count = seen.get(slug) ?? 0;
    seen.set(slug, count + 1);
    return count === 0 ? slug : `${slug}-${count}`;
  });
}

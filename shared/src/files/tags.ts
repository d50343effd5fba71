// Tags as a person writes them, and back. Knows no document.

const MAX_TAGS = 20;
const MAX_TAG_LENGTH = 64;

export const tagsToText = (tags: readonly string[]): string => tags.join(', ');

/** Each once, in the order written; the commas of Chinese text count too. */
export function tagsFromText(text: string): readonly string[] {
  const written = text
    .split(/[,，、]/u)
    .map((tag) => tag.trim().slice(0, MAX_TAG_LENGTH))
    .filter((tag) => tag !== '');
  return [...new Set(written)].slice(0, MAX_TAGS);
}

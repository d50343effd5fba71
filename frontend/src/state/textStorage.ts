// Where this browser keeps a text from one visit to the next. Knows no text.

/** The part of the browser's Storage that is needed; it may throw, as it does where storage is forbidden or full. */
export interface TextStorage {
  getItem(key: string): string | null;
  setItem(key: string, text: string): void;
}

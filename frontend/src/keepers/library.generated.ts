// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change backend/servodeck/library_messages.py instead.

export type Library = LibraryRequest | LibraryAnswer;
export type LibraryRequest = DocumentWrite | DocumentIds | VersionWrite;
export type LibraryAnswer = LibraryListing | StoredDocument | DocumentWritten | ListedVersion[] | VersionText;

/**
 * `expected` is the revision it was read at, 0 for a new one. With `isRemoved` it goes to the trash at
 * once: several that shall appear together are written so and then restored together.
 */
export interface DocumentWrite {
  /**
   * The document as JSON; only the page knows what it means.
   */
  text: string;
  facts: Facts;
  expected: number;
  isRemoved: boolean;
}
/**
 * What a list says of a document without reading it; `pose` is its picture.
 */
export interface Facts {
  name: string;
  robot: string;
  /**
   * @maxItems 20
   */
  tags: string[];
  updatedAtMs: number;
  frames: number;
  durationMs: number;
  unit: 'us' | 'steps';
  /**
   * @maxItems 256
   */
  pose: PoseTarget[];
}
export interface PoseTarget {
  servo: number;
  position: number;
}
export interface DocumentIds {
  /**
   * @maxItems 5000
   */
  ids: string[];
}
export interface VersionWrite {
  name: string;
  atMs: number;
  /**
   * The document as JSON; only the page knows what it means.
   */
  text: string;
}
/**
 * `setAside` names a damaged file that was found and kept.
 */
export interface LibraryListing {
  documents: ListedDocument[];
  setAside: string | null;
}
export interface ListedDocument {
  id: string;
  revision: number;
  isRemoved: boolean;
  facts: Facts;
}
export interface StoredDocument {
  /**
   * The document as JSON; only the page knows what it means.
   */
  text: string;
  revision: number;
}
export interface DocumentWritten {
  revision: number;
}
export interface ListedVersion {
  id: string;
  name: string;
  atMs: number;
}
export interface VersionText {
  /**
   * The document as JSON; only the page knows what it means.
   */
  text: string;
}

// The modules that the build makes of the files of messages; see scripts/words.mjs.

declare module 'virtual:words/*' {
  // oxlint-disable-next-line typescript/consistent-type-imports -- nothing is imported by its place into such a declaration
  export const words: import('./words.ts').Words;
}

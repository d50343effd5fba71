// For builds of the page and of the client: where the figures of shared/protocol come from is for those who read the files.

/** @returns {import('vite').Plugin} */
export function withoutSources() {
  return {
    name: 'without-sources',
    enforce: 'pre',
    transform: {
      filter: { id: /[/\\]shared[/\\]protocol[/\\][^/\\]+[.]json$/ },
      handler: (text) => ({
        code: JSON.stringify(
          JSON.parse(text, (key, /** @type {unknown} */ value) => (key === 'why' ? undefined : value)),
        ),
        map: null,
      }),
    },
  };
}

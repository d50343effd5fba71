// The few colours that a person may give to things; how each looks is the page's business.

export const COLOURS = ['slate', 'indigo', 'violet', 'plum', 'clay', 'olive'] as const;
export type Colour = (typeof COLOURS)[number];

// What is known of the battery. Knows no board, and not what the figure means for a pack.

export type Battery =
  | { readonly kind: 'unread' }
  | { readonly kind: 'read'; readonly batteryMv: number; readonly atMs: number }
  /** Three questions in a row stayed unanswered. */
  | { readonly kind: 'silent'; readonly lastMv: number | null };

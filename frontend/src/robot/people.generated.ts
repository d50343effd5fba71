// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change backend/servodeck/api/people.py instead.

export type PeopleMessage = PeopleRequest | PeopleAnswer;
export type PeopleRequest = PairWish | OwnName | PersonChange | InviteWish | TokenWish | StopLinkWish;
export type PeopleAnswer = Me | You | People | Person | Invitation | Token | StopLink;

/**
 * One of the three: the secret of a link, the digits of a code, or a stop-only link.
 */
export interface PairWish {
  secret?: string | null;
  code?: string | null;
  stop?: string | null;
  name?: string;
}
export interface OwnName {
  name: string;
}
export interface PersonChange {
  name?: string | null;
  role?: ('viewer' | 'driver' | 'owner') | null;
}
export interface InviteWish {
  role: 'viewer' | 'driver' | 'owner';
  name?: string;
}
export interface TokenWish {
  name: string;
  role: 'viewer' | 'driver' | 'owner';
}
export interface StopLinkWish {
  name: string;
}
/**
 * `you` is null for an unauthenticated caller. `overheard`: what is said here can be read by others on
 * the network.
 */
export interface Me {
  mode: 'local' | 'lan' | 'proxy';
  overheard: boolean;
  you: You | null;
}
export interface You {
  id: string;
  name: string;
  role: 'stopper' | 'viewer' | 'driver' | 'owner';
}
/**
 * `openCodes`: the invitations whose digits still count; five wrong ones end that, not their links.
 */
export interface People {
  people: Person[];
  openInvites: string[];
  openCodes: string[];
}
/**
 * A paired device, a script's token or a stop-only link. `here`: it has the page open now,
 * and `drives` where it moves the robot. `unattendedSlot`: of the group that runs on without it.
 */
export interface Person {
  id: string;
  kind: 'device' | 'token' | 'stopLink';
  name: string;
  role: 'stopper' | 'viewer' | 'driver' | 'owner';
  pairedAtMs: number;
  lastSeenMs: number | null;
  here: boolean;
  drives: boolean;
  unattendedSlot: number | null;
}
/**
 * `picture` is the link as a QR code: the address of an SVG image that holds itself.
 */
export interface Invitation {
  id: string;
  link: string;
  code: string | null;
  picture: string;
  expiresInMs: number;
}
/**
 * Shown once: only its SHA-256 is stored.
 */
export interface Token {
  id: string;
  token: string;
}
export interface StopLink {
  id: string;
  link: string;
  picture: string;
}

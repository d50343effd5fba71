// Whom and what the words about people tell of. Knows no sentence.

export type PersonRoleName = 'viewer' | 'driver' | 'owner';
export type PeopleErrorCode = 'unreachable' | 'notPaired' | 'failed' | 'locked' | 'refused';

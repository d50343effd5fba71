// Words about recording a group by hand.

export const recordWords = {
  title: 'Recorded motion',
  nothing: 'Nothing moved.',
};

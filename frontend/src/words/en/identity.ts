// Words about which board this is: the questions it was asked, what its answers mean, and each family in one line.

export const identityWords = {
  asking: 'Asking the board who it is. Nothing moves.',
};

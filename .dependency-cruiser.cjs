// The layer rule: codec < motion < robot < features < app, with documents and the simulator beside the robot.
// Types count as imports. Say a change of this file in docs/adr/.

// A rig or a board under test exists for tests, measurements and replays of saved logs.
const testSupport = '^shared/src/testing/|(/rig|UnderTest)[.]ts$';
const documents = '^shared/src/(document|group|profile|files)/';
const test = `[.]test[.]tsx?$|${testSupport}`;
const page = '^frontend/src/';

/** Which feature may import which, besides the files directly in features/: what is not listed goes through these or through app/. */
const FEATURES = require('./frontend/src/features/imports.json');

/** Code in `from` knows nothing of `to`; tests may, so far as `except` allows. */
function forbid(name, comment, from, to) {
  return { name, comment, severity: 'error', from, to };
}

module.exports = {
  forbidden: [
    forbid(
      'no-cycle',
      'Two modules that need each other are one module, or lack a third.',
      {},
      { circular: true },
    ),
    forbid(
      'resolvable',
      'An import that leads nowhere; the build makes those of words.',
      {},
      { couldNotResolve: true, pathNot: '^virtual:words/' },
    ),

    forbid(
      'shared-is-pure',
      'shared/ runs anywhere: no Node, no page, nothing outside itself but valibot, which is as pure. Its tests and the process entry may.',
      { path: '^shared/src/', pathNot: [test, '^shared/src/simulator/process[.]ts$'] },
      { pathNot: '^(shared/|node_modules/valibot/)' },
    ),
    forbid(
      'shared-process-is-only-an-entry',
      'The process entry is the one Node file of shared/; nothing builds on it.',
      {},
      { path: '^shared/src/simulator/process[.]ts$' },
    ),
    forbid(
      'codec-knows-bytes',
      'The codec knows no time, no motion, no robot, no board.',
      { path: '^shared/src/codec/' },
      { path: '^shared/src/', pathNot: '^shared/src/codec/' },
    ),
    forbid(
      'kinematics-knows-nothing',
      'Kinematics is geometry: joints and angles, no servos and no units of a board.',
      { path: '^shared/src/kinematics/', pathNot: test },
      { path: '^shared/src/', pathNot: '^shared/src/kinematics/' },
    ),
    forbid(
      'motion-knows-the-codec',
      'Motion is a model of what was sent.',
      { path: '^shared/src/motion/', pathNot: test },
      { path: '^shared/src/', pathNot: '^shared/src/(motion|codec)/' },
    ),
    forbid(
      'shared-robot-knows-no-documents',
      'A robot sends; what a group or pose is belongs to documents, and no real board is a simulator.',
      { path: '^shared/src/robot/', pathNot: test },
      { path: [documents, '^shared/src/simulator/'] },
    ),
    forbid(
      'files-on-top-of-documents',
      'A file holds a group or a robot profile; neither has heard of files.',
      { path: '^shared/src/(document|profile|group)/', pathNot: test },
      { path: '^shared/src/files/' },
    ),
    forbid(
      'profile-knows-no-group',
      'A robot stays what it is without any group; a group is made for a robot.',
      { path: '^shared/src/(document|profile)/', pathNot: test },
      { path: '^shared/src/group/' },
    ),
    forbid(
      'document-knows-no-document',
      'Undo, versioned text and schemas serve every kind of document.',
      { path: '^shared/src/document/', pathNot: test },
      { path: '^shared/src/', pathNot: '^shared/src/document/' },
    ),
    forbid(
      'documents-know-no-robot',
      'A document never moves the robot by itself. A saved log has the types of what it saves.',
      { path: documents, pathNot: [test, '^shared/src/files/recording[.]ts$'] },
      { path: '^shared/src/(robot|simulator)/' },
    ),
    forbid(
      'client-knows-the-codec',
      'The client is for programs without the page: of boards it knows what differs between the families.',
      { path: '^shared/src/client/', pathNot: test },
      { path: '^shared/src/', pathNot: '^shared/src/(client|codec)/' },
    ),
    forbid(
      'simulator-knows-the-codec',
      'The simulator is the other side of the wire: it may share the codec, never the code it puts to the test.',
      { path: '^shared/src/simulator/', pathNot: test },
      {
        path: ['^shared/src/(robot|motion)/', documents],
        pathNot: '^shared/src/robot/(byteChannel|linkError)[.]ts$',
      },
    ),
    forbid(
      'simulated-channel-knows-the-interface',
      'One file of the simulator is the byte channel of a simulated board; the board itself has never heard of it.',
      { path: '^shared/src/simulator/', pathNot: [test, '^shared/src/simulator/channel[.]ts$'] },
      { path: '^shared/src/robot/' },
    ),

    forbid(
      'only-robot-picks-a-link',
      'Features, state and widgets do not know which way leads to the board.',
      { path: page, pathNot: `${page}(robot|app)/` },
      { path: `${page}robot/links/` },
    ),
    forbid(
      'links-know-no-page',
      'A link is a cable, a radio or a socket.',
      { path: `${page}robot/links/` },
      { path: page, pathNot: `${page}robot/(links/|request[.]ts$)` },
    ),
    forbid(
      'robot-knows-no-feature',
      'The robot is below everything that drives it.',
      { path: `${page}robot/`, pathNot: test },
      {
        path: page,
        pathNot: `${page}(robot|state|ui|i18n)/`,
      },
    ),
    forbid(
      'gateway-requests-know-nothing',
      'A request of the gateway is made by those who know what it is for.',
      { path: `${page}robot/request[.]ts$` },
      { pathNot: `${page}robot/request[.]ts$|^shared/src/client/|^node_modules/valibot/` },
    ),
    forbid(
      'state-knows-no-feature',
      'State is what every part builds its own from: notices, undo, stored texts.',
      { path: `${page}state/` },
      { path: page, pathNot: `${page}(state|i18n)/` },
    ),
    forbid(
      'document-stores-know-no-page',
      'Where documents are stored, nobody knows what they are for.',
      { path: `${page}features/library/(browser|gateway|memory)Store[.]ts$` },
      {
        path: page,
        pathNot: `${page}(features/library/(browser|gateway|memory)Store[.]ts$|robot/request[.]ts$)`,
      },
    ),
    forbid(
      'ui-knows-no-robot',
      'Shared widgets know neither state nor features.',
      { path: `${page}ui/` },
      { path: page, pathNot: `${page}(ui|i18n)/` },
    ),
    forbid(
      'words-know-nothing',
      'The catalogue is read by everyone and reads nobody of the page.',
      { path: `${page}i18n/` },
      { path: page, pathNot: `${page}i18n/` },
    ),
    ...Object.entries(FEATURES).map(([feature, others]) =>
      forbid(
        `feature-${feature}`,
        `A feature imports those that FEATURES lists for it.`,
        { path: `${page}features/${feature}/`, pathNot: test },
        {
          path: `${page}features/[^/]+/`,
          pathNot: `${page}features/(${[feature, ...others].join('|')})/`,
        },
      ),
    ),
    forbid(
      'features-are-listed',
      'A new feature begins with its line in FEATURES.',
      { path: `${page}features/[^/]+/`, pathNot: `${page}features/(${Object.keys(FEATURES).join('|')})/` },
      { path: `${page}features/` },
    ),
    forbid(
      'features-know-no-app',
      'App puts features together; a feature never looks back.',
      { path: page, pathNot: `${page}app/` },
      { path: `${page}app/` },
    ),
    forbid(
      'page-uses-page-and-shared',
      'The page is built from itself and shared/.',
      { path: page },
      {
        path: '^(e2e|bench|scripts|backend)/',
      },
    ),
    forbid(
      'no-development-packages-in-the-page',
      'What the page imports at run time stands under dependencies.',
      { path: page, pathNot: [test, '[.]d[.]ts$'] },
      { dependencyTypes: ['npm-dev', 'npm-no-pkg', 'npm-unknown'], dependencyTypesNot: ['type-only'] },
    ),

    forbid(
      'end-to-end-stands-outside',
      'End-to-end tests see the product as a person does; they may read packets with shared/.',
      { path: '^e2e/' },
      { path: '^(frontend|bench|backend)/' },
    ),
    forbid(
      'nothing-imports-end-to-end',
      'Tests are leaves. Component tests share the words, the board and its log.',
      { pathNot: '^(e2e|frontend/tests)/' },
      { path: '^e2e/' },
    ),
    forbid(
      'nothing-imports-component-tests',
      'Tests are leaves.',
      { pathNot: '^frontend/tests/' },
      { path: '^frontend/tests/' },
    ),
    forbid('nothing-imports-tests', 'Tests are leaves.', {}, { path: '[.]test[.]tsx?$' }),
    forbid(
      'rigs-are-for-tests',
      'No product code stands on a test rig.',
      { pathNot: [test, '^(e2e|bench|frontend/tests)/'] },
      { path: testSupport },
    ),
  ],
  options: {
    doNotFollow: { path: 'node_modules' },
    exclude: { path: '[.]css$|[.]svg$' },
    tsPreCompilationDeps: true,
    enhancedResolveOptions: {
      extensions: ['.ts', '.tsx', '.mjs', '.js', '.json', '.d.ts'],
      exportsFields: ['exports'],
      conditionNames: ['import', 'types', 'default'],
    },
  },
};

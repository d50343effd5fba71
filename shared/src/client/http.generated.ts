// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change the routes of backend/servodeck/api instead.

export interface paths {
  '/api/audit': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** Who did what, and when: the newest 10,000 entries */
    get: operations['auditRead'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/audit/file': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The whole list as CSV or as JSON lines, the newest first */
    get: operations['auditExport'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/battery': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** Queries the board now */
    get: operations['gatewayBattery'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/board': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    /** Says of which family the board is */
    put: operations['gatewayNameBoard'];
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/cameras': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The cameras at the gateway */
    get: operations['camerasListCameras'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/cameras/{camera_id}/stream': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The stream of a camera as motion JPEG, for as long as the client reads it */
    get: operations['camerasStream'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/download': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Stores groups in slots of the board, one after the other, as one job, also from several requests */
    post: operations['jobsDownload'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/driver': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    /** Hands the lease to a connected client that may drive, without a request */
    put: operations['motionGive'];
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/erase': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Erases every slot of the board, for good */
    post: operations['motionErase'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/events': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** Messages from now on, as server-sent events with an id: the same as on `/ws` */
    get: operations['eventsEvents'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/fleet': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** What has changed since that revision */
    get: operations['fleetChanges'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/fleet/cues': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    /** The steps of a show, in place of the ones before */
    put: operations['fleetSetCues'];
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/fleet/download': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Stores the groups on each robot, one after the other */
    post: operations['fleetDownload'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/fleet/groups': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Puts robots into a group of robots, and takes them out of the others */
    post: operations['fleetGroup'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/fleet/resume': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Allows motion again */
    post: operations['fleetResume'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/fleet/run': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Has each robot run its slot */
    post: operations['fleetRun'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/fleet/stop': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** STOP of those robots, or of all */
    post: operations['fleetStop'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/fleet/tasks/{task}/retry': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Asks those robots again at which it failed */
    post: operations['fleetRetry'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/health': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** Always 200 while the gateway runs */
    get: operations['healthHealth'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/invites': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** A link and a code for one device, for two minutes */
    post: operations['peopleInvite'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/invites/{invitation}': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    post?: never;
    /** Ends an invitation that was not used */
    delete: operations['peopleWithdraw'];
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/jobs/{job}': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** Its progress or result */
    get: operations['jobsJobState'];
    put?: never;
    post?: never;
    /** Cancels it after its frame in progress, with the groups behind it */
    delete: operations['jobsCancel'];
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/lease': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Requests, takes, holds or releases the lease */
    post: operations['motionLease'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/library': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** Every document, also those in the trash */
    get: operations['libraryListDocuments'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/library/{document}': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The text of a document, also of one in the trash */
    get: operations['libraryRead'];
    /** Stores a text */
    put: operations['libraryWrite'];
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/library/{document}/versions': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** Its named versions, oldest first */
    get: operations['libraryListVersions'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/library/{document}/versions/{version}': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The text that was saved under that version's name */
    get: operations['libraryReadVersion'];
    /** Saves a text as a named version of the document */
    put: operations['libraryKeepVersion'];
    post?: never;
    /** Deletes that version for good */
    delete: operations['libraryRemoveVersion'];
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/library/drafts': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Adds a group as a draft */
    post: operations['libraryPropose'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/library/remove': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Puts them into the trash for 30 days: all or none */
    post: operations['libraryRemove'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/library/restore': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Takes them out of the trash: all or none */
    post: operations['libraryRestore'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/me': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The caller as this gateway knows it */
    get: operations['peopleMe'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    /** Changes the name of the caller */
    patch: operations['peopleRenameMe'];
    trace?: never;
  };
  '/api/move': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Moves servos together */
    post: operations['motionMove'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/pair': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Pairs by a link, a code or a stop-only link, and sets a cookie */
    post: operations['peoplePair'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/people': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** All devices, tokens and links, and the open invitations */
    get: operations['peoplePeople'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/people/{person}': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    post?: never;
    /** Revokes it: its connections are closed at once, its motion is stopped, and none of its commands leaves the gateway after the answer */
    delete: operations['peopleRevoke'];
    options?: never;
    head?: never;
    /** Changes name or role */
    patch: operations['peopleChange'];
    trace?: never;
  };
  '/api/play': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Plays frames by the gateway's clock, gently to the first one */
    post: operations['playPlay'];
    /** Ends the play with its frame in progress, whichever client began it */
    delete: operations['playStopPlaying'];
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/port': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    /** Opens that port instead of the present one */
    put: operations['gatewayUsePort'];
    post?: never;
    /** Closes the port and leaves it closed, also after the next start */
    delete: operations['gatewayClosePort'];
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/port/listen': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Gives up the serial port for some seconds, listens on it at other speeds than the boards', and opens it again */
    post: operations['gatewayListen'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/ports': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The ports of this computer, serial and HID, and the one in use, the likely ones first */
    get: operations['gatewayPorts'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/poses': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The poses of the robot on the board, with its name */
    get: operations['posesListPoses'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/poses/{pose}/apply': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Moves the robot to the pose of that number or name, in the same way as `move` */
    post: operations['posesApply'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/resume': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Allows motion again */
    post: operations['gatewayResume'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/robot': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    /** Puts that robot of the library on this board, for all clients */
    put: operations['robotsPutOnBoard'];
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/slots/{slot}/run': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** Runs the group in that slot */
    post: operations['motionRun'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/status': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    /** The state of gateway, port, board and robot */
    get: operations['gatewayStatus'];
    put?: never;
    post?: never;
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/stop': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** STOP: drops all that waits, sends stop three times, holds each servo whose place is known, and refuses motion until resume */
    post: operations['gatewayStop'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/stop-links': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** A link that can stop the robot and do nothing else, for a sticker */
    post: operations['peopleMakeStopLink'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
  '/api/tokens': {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    get?: never;
    put?: never;
    /** A token for a script: `Authorization: Bearer TOKEN` */
    post: operations['peopleMakeToken'];
    delete?: never;
    options?: never;
    head?: never;
    patch?: never;
    trace?: never;
  };
}
export type webhooks = Record<string, never>;
export interface components {
  schemas: {
    /**
     * AnsweredEvidence
     * @description The board answered that question of its identification.
     */
    AnsweredEvidence: {
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'answered';
      /**
       * Question
       * @enum {string}
       */
      question: 'readBattery' | 'readVersion' | 'readPositions';
      /** Report */
      report:
        | components['schemas']['BatteryReport']
        | components['schemas']['VersionReport']
        | components['schemas']['PositionsReport'];
    };
    /** ApplyWish */
    ApplyWish: {
      /**
       * Beats
       * @description The move ends with the `heartbeat` of this program: it is stopped 2 s after the last one. Without it, the request permits the move to its end.
       * @default false
       */
      beats?: boolean;
      /**
       * Take
       * @description An owner's: without asking the driver.
       * @default false
       */
      take?: boolean;
      /**
       * Timems
       * @default 1500
       */
      timeMs?: number;
      /** Waitms */
      waitMs?: number | null;
    };
    /**
     * AuditEntry
     * @description `count` such acts from `atMs` until `untilMs`. `who` did it, null where no person did, to `whom`; both
     *     are names at that time. `about`: a slot, a servo, a role, a cause, a port or a document.
     */
    AuditEntry: {
      /** About */
      about: string;
      /**
       * Act
       * @enum {string}
       */
      act:
        | 'tookLease'
        | 'leftLease'
        | 'moved'
        | 'ran'
        | 'endedGroup'
        | 'played'
        | 'downloaded'
        | 'downloadFailed'
        | 'erased'
        | 'setSpeed'
        | 'unpowered'
        | 'stopped'
        | 'resumed'
        | 'calibrated'
        | 'allowedUnattended'
        | 'boardChosen'
        | 'gatewayStarted'
        | 'gatewayEnded'
        | 'restored'
        | 'paired'
        | 'pairRefused'
        | 'invited'
        | 'withdrew'
        | 'renamed'
        | 'roleChanged'
        | 'revoked'
        | 'tokenMade'
        | 'tokenExpired'
        | 'stopLinkMade'
        | 'portOpened'
        | 'portClosed'
        | 'robotChosen'
        | 'librarySaved'
        | 'libraryRemoved'
        | 'libraryRestored'
        | 'fleetStopped'
        | 'fleetAsked'
        | 'fleetGrouped';
      /** Atms */
      atMs: number;
      /** Count */
      count: number;
      /** Id */
      id: number;
      /** Untilms */
      untilMs: number;
      /** Who */
      who: string | null;
      /** Whom */
      whom: string;
    };
    /**
     * AuditPage
     * @description The newest first. `more`: there are older ones. `names`: of all who did something. `problem`: why the
     *     list is not stored at present; it is held in memory then.
     */
    AuditPage: {
      /** Entries */
      entries: components['schemas']['AuditEntry'][];
      /** More */
      more: boolean;
      /** Names */
      names: string[];
      /** Problem */
      problem: string | null;
    };
    /** Battery */
    Battery: {
      /** Batterymv */
      batteryMv: number;
    };
    /** BatteryAge */
    BatteryAge: {
      /** Agems */
      ageMs: number;
      /** Batterymv */
      batteryMv: number;
    };
    /** BatteryReport */
    BatteryReport: {
      /** Batterymv */
      batteryMv: number;
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'battery';
    };
    /**
     * BoardChoice
     * @description A family of boards; `unknown`: identify it again.
     */
    BoardChoice: {
      /** Board */
      board: string;
    };
    /**
     * CameraName
     * @description `id`: its place in the list that the gateway was started with.
     */
    CameraName: {
      /** Id */
      id: number;
      /** Name */
      name: string;
    };
    /**
     * Candidate
     * @description A connected client that may drive.
     */
    Candidate: {
      /** Id */
      id: string;
      /** Name */
      name: string;
    };
    /**
     * Device
     * @description A serial port of this computer. `likely`: its USB chip is one that these boards and cables bear.
     *     `lasting`: a name that leads to it after every start and replug, where the system keeps one. `inUse`: it
     *     is the gateway's present one, open or waited for.
     */
    Device: {
      /** Description */
      description: string;
      /** Device */
      device: string;
      /** Inuse */
      inUse: boolean;
      /** Lasting */
      lasting: string | null;
      /** Likely */
      likely: boolean;
    };
    /** DocumentIds */
    DocumentIds: {
      /** Ids */
      ids: string[];
    };
    /**
     * DocumentWrite
     * @description `expected` is the revision at which it was read, 0 for a new one. `isRemoved` writes it to the trash:
     *     several documents that are to appear together are written so, and then restored together. `facts` are
     *     those of a group; a robot's are computed from its text, whatever is said here.
     */
    DocumentWrite: {
      /** Expected */
      expected: number;
      /** Facts */
      facts?: (components['schemas']['GroupFacts'] | components['schemas']['RobotFacts-Input']) | null;
      /** Isremoved */
      isRemoved: boolean;
      /**
       * Text
       * @description The document as JSON; only the page knows what it means.
       */
      text: string;
    };
    /** DocumentWritten */
    DocumentWritten: {
      /** Revision */
      revision: number;
    };
    /**
     * DownloadWish
     * @description `groups` are stored in this order, each in a slot of its own. `behind`: the download in progress to
     *     which they are added, because a request holds a limited number. `nonce`: of the page that drives; a
     *     program needs none. `take` as with every motion.
     */
    DownloadWish: {
      /** Behind */
      behind?: string | null;
      /** Groups */
      groups: components['schemas']['GroupBody'][];
      /** Nonce */
      nonce?: string | null;
      /**
       * Take
       * @description An owner's: without asking the driver.
       * @default false
       */
      take?: boolean;
      /** Waitms */
      waitMs?: number | null;
    };
    /**
     * Draft
     * @description A group that is to be looked at before it is played. Its tags are the gateway's: `draft`, and who
     *     proposes it.
     */
    Draft: {
      facts: components['schemas']['GroupFacts'];
      /**
       * Text
       * @description The document as JSON; only the page knows what it means.
       */
      text: string;
    };
    /** DraftStored */
    DraftStored: {
      /** Id */
      id: string;
    };
    /**
     * DriverWish
     * @description As `GET /api/people` and the lease's `candidates` name them.
     */
    DriverWish: {
      /** Id */
      id: string;
    };
    /**
     * EchoedEvidence
     * @description The request itself came back.
     */
    EchoedEvidence: {
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'echoed';
    };
    /** Erased */
    Erased: {
      /** Erased */
      erased: boolean;
    };
    /** EraseWish */
    EraseWish: {
      /**
       * Take
       * @description An owner's: without asking the driver.
       * @default false
       */
      take?: boolean;
    };
    /**
     * FleetBroker
     * @description The link to the broker; `detail` says why it is not connected.
     */
    FleetBroker: {
      /** Detail */
      detail: string;
      /**
       * Status
       * @enum {string}
       */
      status: 'connected' | 'connecting';
    };
    /**
     * FleetChanges
     * @description All of it where `isWhole`, else what changed since the revision that was asked for; `cues` are always
     *     all of them.
     */
    FleetChanges: {
      broker: components['schemas']['FleetBroker'];
      /** Cues */
      cues: components['schemas']['FleetCue'][];
      /** Events */
      events: components['schemas']['FleetEvent'][];
      /** Iswhole */
      isWhole: boolean;
      /** Removed */
      removed: string[];
      /** Revision */
      revision: number;
      /** Robots */
      robots: components['schemas']['FleetRobot'][];
      /** Site */
      site: string;
      /** Tasks */
      tasks: components['schemas']['FleetTask'][];
    };
    /**
     * FleetCue
     * @description A step of a show: the group of that name on the robots of a group of robots, empty for all.
     */
    FleetCue: {
      /** Name */
      name: string;
      /** Robots */
      robots: string;
      /**
       * Stopsothers
       * @description Where one robot fails, all of the cue are stopped.
       */
      stopsOthers: boolean;
      /** Times */
      times: number;
    };
    /** FleetCues */
    FleetCues: {
      /** Cues */
      cues: components['schemas']['FleetCue'][];
    };
    /**
     * FleetDownloadWish
     * @description Each of the groups for the slot that it names, and all of them for each of the robots.
     */
    FleetDownloadWish: {
      /** Groups */
      groups: components['schemas']['GroupBody'][];
      /** Robots */
      robots: string[];
    };
    /**
     * FleetEvent
     * @description `robot`: its name then. `atMs`: since 1970, by the clock of the gateway that serves the page.
     */
    FleetEvent: {
      /** Atms */
      atMs: number;
      /** By */
      by: string | null;
      /**
       * Kind
       * @enum {string}
       */
      kind: 'stopped' | 'resumed' | 'lost' | 'ready' | 'silent' | 'cloned' | 'back';
      /** Robot */
      robot: string;
    };
    /**
     * FleetGroupWish
     * @description `group` empty: into none.
     */
    FleetGroupWish: {
      /** Group */
      group: string;
      /** Robots */
      robots: string[];
    };
    /** FleetResumeWish */
    FleetResumeWish: {
      /** Robots */
      robots: string[];
    };
    /**
     * FleetRobot
     * @description A gateway of the site and its robot. `limits`: of the servos of its robot, in the board's unit.
     *     `lowBatteryMv`: at or below, its battery is low; null where the robot does not say. `page`:
     *     the address of its own page, empty where it has none. `seenMsAgo`: in steps of 10 s, null while it is
     *     present, and where it never was. `state`: the latest one, null until one was heard.
     */
    FleetRobot: {
      /** Board */
      board: string;
      /** Groups */
      groups: string[];
      /** Id */
      id: string;
      /** Limits */
      limits: components['schemas']['ServoLimits-Output'][];
      /** Lowbatterymv */
      lowBatteryMv: number | null;
      /** Name */
      name: string;
      /** Page */
      page: string;
      /**
       * Presence
       * @enum {string}
       */
      presence: 'present' | 'silent' | 'cloned';
      /** Robot */
      robot: string;
      /** Seenmsago */
      seenMsAgo: number | null;
      /** Slots */
      slots: components['schemas']['FleetSlot'][];
      state: components['schemas']['FleetState'] | null;
      /** Version */
      version: string;
    };
    /** FleetRun */
    FleetRun: {
      /** Robot */
      robot: string;
      /** Slot */
      slot: number;
    };
    /**
     * FleetRunning
     * @description `name` is empty where the gateway does not know what the slot holds.
     */
    FleetRunning: {
      /** Name */
      name: string;
      /** Slot */
      slot: number;
    };
    /**
     * FleetRunWish
     * @description `name` of the group, for people; boards have it in slots of their own.
     */
    FleetRunWish: {
      /**
       * Name
       * @default
       */
      name?: string;
      /** Runs */
      runs: components['schemas']['FleetRun'][];
      /**
       * Stopsothers
       * @description Where one fails, all of them are stopped.
       * @default false
       */
      stopsOthers?: boolean;
      /**
       * Times
       * @default 1
       */
      times?: number;
      /**
       * Together
       * @description All at the same time, or none.
       * @default false
       */
      together?: boolean;
    };
    /** FleetSlot */
    FleetSlot: {
      /** Name */
      name: string;
      /** Slot */
      slot: number;
    };
    /** FleetState */
    FleetState: {
      /** Batterymv */
      batteryMv: number | null;
      /** Driver */
      driver: string | null;
      /** Latch */
      latch: boolean;
      /**
       * Link
       * @enum {string}
       */
      link: 'closed' | 'opening' | 'identifying' | 'ready' | 'stale' | 'refused' | 'lost';
      running: components['schemas']['FleetRunning'] | null;
      /** Stoppedby */
      stoppedBy: string | null;
    };
    /**
     * FleetStatus
     * @description The gateway on a broker. `problem` says why it is not connected, or not heard there; `refused`:
     *     messages that were refused before they reached the robot, by code.
     */
    FleetStatus: {
      /** Broker */
      broker: string;
      /** Iscloned */
      isCloned: boolean;
      /** Isconnected */
      isConnected: boolean;
      /** Name */
      name: string;
      /** Problem */
      problem: string | null;
      /** Refused */
      refused: {
        [key: string]: number;
      };
      /** Site */
      site: string;
    };
    /**
     * FleetStopped
     * @description `reached`: they have confirmed that they are stopped. `notReached`: they have not, within a second, or
     *     had no board to stop.
     */
    FleetStopped: {
      /** Notreached */
      notReached: string[];
      /** Reached */
      reached: string[];
    };
    /**
     * FleetStopWish
     * @description `robots` null: every robot of the site, also those that this gateway does not know.
     */
    FleetStopWish: {
      /** Robots */
      robots?: string[] | null;
    };
    /**
     * FleetTask
     * @description What a person asked of several robots. `names`: of the action groups. `spreadMs`: between the first and
     *     the last first bit of those that started together, by their own clocks; null where unknown.
     */
    FleetTask: {
      /** By */
      by: string;
      /** Id */
      id: string;
      /** Names */
      names: string[];
      /** Parts */
      parts: components['schemas']['FleetTaskPart'][];
      /** Spreadms */
      spreadMs: number | null;
      /**
       * Verb
       * @enum {string}
       */
      verb: 'run' | 'download' | 'resume';
    };
    /**
     * FleetTaskPart
     * @description `share` of its work that is done, 0 to 1, null where unknown. `detail` says why it failed.
     */
    FleetTaskPart: {
      /** Detail */
      detail: string | null;
      /** Robot */
      robot: string;
      /** Share */
      share: number | null;
      /**
       * Status
       * @enum {string}
       */
      status: 'waiting' | 'busy' | 'done' | 'failed';
    };
    /**
     * FrameBody
     * @description Positions by servo number, in the board's unit, reached after `durationMs`.
     */
    FrameBody: {
      /** Durationms */
      durationMs: number;
      /** Positions */
      positions: {
        [key: string]: number;
      };
    };
    /**
     * GroupBody
     * @description `version` is any text that distinguishes it from other groups; by default the gateway makes one.
     *     `replaces`: the version that the caller expects in the slot, an empty text for none; another one there is
     *     a conflict. `document`: its document in the library.
     */
    GroupBody: {
      /** Document */
      document?: string | null;
      /** Frames */
      frames: components['schemas']['FrameBody'][];
      /**
       * Name
       * @default
       */
      name?: string;
      /** Replaces */
      replaces?: string | null;
      /** Slot */
      slot: number;
      /**
       * Version
       * @default
       */
      version?: string;
    };
    /**
     * GroupFacts
     * @description The entry of an action group in a list, known without reading its text; `pose` is its picture.
     */
    GroupFacts: {
      /** Durationms */
      durationMs: number;
      /** Frames */
      frames: number;
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'group';
      /** Name */
      name: string;
      /** Pose */
      pose: components['schemas']['PoseTarget'][];
      /** Robot */
      robot: string;
      /** Tags */
      tags: string[];
      /**
       * Unit
       * @enum {string}
       */
      unit: 'us' | 'steps';
      /** Updatedatms */
      updatedAtMs: number;
    };
    /**
     * Health
     * @description `degraded`: it answers and can stop the robot, but one part of it does not work.
     */
    Health: {
      /**
       * Status
       * @enum {string}
       */
      status: 'ready' | 'degraded';
      /** Troubles */
      troubles: components['schemas']['Trouble'][];
      /** Version */
      version: string;
    };
    /**
     * IdentityState
     * @description The answers of the board to its identification, and the families that answer like that.
     */
    IdentityState: {
      /** Candidates */
      candidates: string[];
      /** Evidence */
      evidence: (
        | components['schemas']['AnsweredEvidence']
        | components['schemas']['SilentEvidence']
        | components['schemas']['EchoedEvidence']
        | components['schemas']['NoiseEvidence']
      )[];
    };
    /**
     * Invitation
     * @description `picture` is the link as a QR code: an SVG image as a data address.
     */
    Invitation: {
      /** Code */
      code: string | null;
      /** Expiresinms */
      expiresInMs: number;
      /** Id */
      id: string;
      /** Link */
      link: string;
      /** Picture */
      picture: string;
    };
    /** InviteWish */
    InviteWish: {
      /**
       * Name
       * @default
       */
      name?: string;
      /**
       * Role
       * @enum {string}
       */
      role: 'viewer' | 'driver' | 'owner';
    };
    /**
     * JobState
     * @description A download and its progress. `slots`: of its groups, in this order; `slot` and `name`: of the one that
     *     is being stored, or was last; frames and bytes are of all of them. `by`: the client that began it. `code`
     *     and `detail` say why it failed or was cancelled.
     */
    JobState: {
      /** By */
      by: string;
      /** Bytessent */
      bytesSent: number;
      /** Bytestotal */
      bytesTotal: number;
      /** Code */
      code:
        | (
            | 'closed'
            | 'lost'
            | 'portMissing'
            | 'portBusy'
            | 'portDenied'
            | 'hidDenied'
            | 'otherDevice'
            | 'boardUnknown'
            | 'wrongBoard'
            | 'echo'
            | 'boardSilent'
            | 'noAnswer'
            | 'notSupported'
            | 'notOnThisCable'
            | 'latched'
            | 'notDriving'
            | 'expired'
            | 'busy'
            | 'slotBroken'
            | 'slotChanged'
            | 'batteryLow'
            | 'cancelled'
            | 'outOfRange'
            | 'malformed'
            | 'forbidden'
            | 'notPaired'
            | 'pairingFailed'
            | 'pairingLocked'
            | 'wrongType'
            | 'notFound'
            | 'methodNotAllowed'
            | 'conflict'
            | 'tooLarge'
            | 'tooMany'
            | 'cameraFailed'
            | 'storageFull'
            | 'storageBusy'
            | 'storageFailed'
            | 'damaged'
            | 'internal'
          )
        | null;
      /** Detail */
      detail: string | null;
      /** Framecount */
      frameCount: number;
      /** Framesstored */
      framesStored: number;
      /** Groupsstored */
      groupsStored: number;
      /** Id */
      id: string;
      /** Name */
      name: string;
      /** Remainingms */
      remainingMs: number;
      /** Slot */
      slot: number;
      /** Slots */
      slots: number[];
      /**
       * Status
       * @enum {string}
       */
      status: 'running' | 'done' | 'failed' | 'cancelled';
    };
    /**
     * LeaseState
     * @description The lease, by name: who drives, and who has requested it. `drives` and `hasRequested`: this client
     *     does or has. `grantedInMs`: until then the driver may refuse the request. `grantedBy`: the driver or owner
     *     who granted it to this client, which drives. `candidates`: the clients to which this one may grant it.
     *     `you`: this client's own name; several windows of one browser share it.
     */
    LeaseState: {
      /** Candidates */
      candidates: components['schemas']['Candidate'][];
      /** Driver */
      driver: string | null;
      /** Drives */
      drives: boolean;
      /** Grantedby */
      grantedBy: string | null;
      /** Grantedinms */
      grantedInMs: number | null;
      /** Hasrequested */
      hasRequested: boolean;
      /** Maydrive */
      mayDrive: boolean;
      /** Maytake */
      mayTake: boolean;
      /** Requestedby */
      requestedBy: string | null;
      /** You */
      you: string;
    };
    /**
     * LeaseWish
     * @description `heartbeat`: the motion of this script may continue. `request`, `take` and `release` as on a page.
     */
    LeaseWish: {
      /**
       * Action
       * @enum {string}
       */
      action: 'request' | 'take' | 'release' | 'heartbeat';
    };
    /**
     * LibraryListing
     * @description `damagedFile` names a damaged file that was found and set apart; `changesLost`: the last changes before
     *     the gateway's start may be missing.
     */
    LibraryListing: {
      /** Changeslost */
      changesLost: boolean;
      /** Damagedfile */
      damagedFile: string | null;
      /** Documents */
      documents: components['schemas']['ListedDocument'][];
    };
    /**
     * LinkState
     * @description The link to the board: `identifying` while it is queried, `stale` while it does not answer a
     *     question that such a board always answers, `refused` until a person says which board it is. `code` and
     *     `detail` say why it is not ready.
     */
    LinkState: {
      /** Code */
      code:
        | (
            | 'closed'
            | 'lost'
            | 'portMissing'
            | 'portBusy'
            | 'portDenied'
            | 'hidDenied'
            | 'otherDevice'
            | 'boardUnknown'
            | 'wrongBoard'
            | 'echo'
            | 'boardSilent'
            | 'noAnswer'
            | 'notSupported'
            | 'notOnThisCable'
            | 'latched'
            | 'notDriving'
            | 'expired'
            | 'busy'
            | 'slotBroken'
            | 'slotChanged'
            | 'batteryLow'
            | 'cancelled'
            | 'outOfRange'
            | 'malformed'
            | 'forbidden'
            | 'notPaired'
            | 'pairingFailed'
            | 'pairingLocked'
            | 'wrongType'
            | 'notFound'
            | 'methodNotAllowed'
            | 'conflict'
            | 'tooLarge'
            | 'tooMany'
            | 'cameraFailed'
            | 'storageFull'
            | 'storageBusy'
            | 'storageFailed'
            | 'damaged'
            | 'internal'
          )
        | null;
      /** Detail */
      detail: string | null;
      /**
       * Status
       * @enum {string}
       */
      status: 'closed' | 'opening' | 'identifying' | 'ready' | 'stale' | 'refused' | 'lost';
    };
    /** ListedDocument */
    ListedDocument: {
      /** Facts */
      facts: components['schemas']['GroupFacts'] | components['schemas']['RobotFacts-Output'];
      /** Id */
      id: string;
      /** Isremoved */
      isRemoved: boolean;
      /** Revision */
      revision: number;
    };
    /** ListedVersion */
    ListedVersion: {
      /** Atms */
      atMs: number;
      /** Id */
      id: string;
      /** Name */
      name: string;
    };
    /**
     * Me
     * @description `you` is null for an unauthenticated caller. `overheard`: others on the network can read the traffic.
     *     `pages`: what this gateway has for the caller: a robot of its own, a fleet.
     */
    Me: {
      /**
       * Mode
       * @enum {string}
       */
      mode: 'local' | 'lan' | 'proxy';
      /** Overheard */
      overheard: boolean;
      /** Pages */
      pages: ('robot' | 'fleet')[];
      you: components['schemas']['You'] | null;
    };
    /**
     * MoveBegun
     * @description `firstMoves`: these servos started from an unknown position, so they started one after another.
     */
    MoveBegun: {
      /** Ended */
      ended?: boolean | null;
      /** Firstmoves */
      firstMoves: number[];
      /** Overinms */
      overInMs: number;
      /** Packets */
      packets: number;
    };
    /**
     * MoveWish
     * @description `positions` by servo number, in the board's unit; all of them at once.
     */
    MoveWish: {
      /**
       * Beats
       * @description The move ends with the `heartbeat` of this program: it is stopped 2 s after the last one. Without it, the request permits the move to its end.
       * @default false
       */
      beats?: boolean;
      /** Positions */
      positions: {
        [key: string]: number;
      };
      /**
       * Take
       * @description An owner's: without asking the driver.
       * @default false
       */
      take?: boolean;
      /** Timems */
      timeMs: number;
      /** Waitms */
      waitMs?: number | null;
    };
    /**
     * NamedPose
     * @description `id` stays when it is named anew. `targets` are some of the robot's servos, in its board's unit.
     */
    NamedPose: {
      /** Id */
      id: number;
      /** Name */
      name: string;
      /** Targets */
      targets: components['schemas']['PoseTarget'][];
      /**
       * Unit
       * @enum {string}
       */
      unit: 'us' | 'steps';
    };
    /**
     * NoiseEvidence
     * @description Bytes came that are no packets.
     */
    NoiseEvidence: {
      /** Bytecount */
      byteCount: number;
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'noise';
    };
    /**
     * NotificationReceiver
     * @description A receiver of notifications, and what became of the latest one; `detail` says why it was dropped.
     */
    NotificationReceiver: {
      /** Detail */
      detail: string | null;
      /** Host */
      host: string;
      /**
       * Kind
       * @enum {string}
       */
      kind: 'webhook' | 'ntfy';
      /**
       * Latest
       * @enum {string}
       */
      latest: 'unused' | 'sent' | 'dropped';
    };
    /** OwnName */
    OwnName: {
      /** Name */
      name: string;
    };
    /**
     * PairWish
     * @description One of the three: the secret of a link, the digits of a code, or a stop-only link.
     */
    PairWish: {
      /** Code */
      code?: string | null;
      /**
       * Name
       * @default
       */
      name?: string;
      /** Secret */
      secret?: string | null;
      /** Stop */
      stop?: string | null;
    };
    /**
     * People
     * @description `openCodes`: the invitations whose digits are still valid; five wrong codes void the digits, not the
     *     links.
     */
    People: {
      /** Opencodes */
      openCodes: string[];
      /** Openinvites */
      openInvites: string[];
      /** People */
      people: components['schemas']['Person'][];
    };
    /**
     * Person
     * @description A paired device, a script's token or a stop-only link. `here`: it has the page open now; `drives`: it
     *     has the lease. `unattendedSlot`: of its group that runs unattended. `expiresInMs`: 0 where it has
     *     expired; null where it is valid until it is revoked.
     */
    Person: {
      /** Drives */
      drives: boolean;
      /** Expiresinms */
      expiresInMs: number | null;
      /** Here */
      here: boolean;
      /** Id */
      id: string;
      /**
       * Kind
       * @enum {string}
       */
      kind: 'device' | 'token' | 'stopLink';
      /** Lastseenms */
      lastSeenMs: number | null;
      /** Name */
      name: string;
      /** Pairedatms */
      pairedAtMs: number;
      /**
       * Role
       * @enum {string}
       */
      role: 'stopper' | 'viewer' | 'driver' | 'owner';
      /** Unattendedslot */
      unattendedSlot: number | null;
    };
    /** PersonChange */
    PersonChange: {
      /** Name */
      name?: string | null;
      /** Role */
      role?: ('viewer' | 'driver' | 'owner') | null;
    };
    /**
     * PlayState
     * @description A play of the gateway by its own clock, and its progress. `times` 0: until stopped. `by`: the client
     *     that began it. `lateFrames` began so late that later frames were delayed, by `latestMs` at most;
     *     `skippedFrames` did not leave. `batteryUnknown`: new runs are refused at an alarm, and its battery could
     *     not be judged. `ended`: before its last frame had ended; `code` and `detail` say why.
     */
    PlayState: {
      /**
       * Batteryunknown
       * @default false
       */
      batteryUnknown: boolean;
      /** By */
      by: string;
      /** Code */
      code:
        | (
            | 'closed'
            | 'lost'
            | 'portMissing'
            | 'portBusy'
            | 'portDenied'
            | 'hidDenied'
            | 'otherDevice'
            | 'boardUnknown'
            | 'wrongBoard'
            | 'echo'
            | 'boardSilent'
            | 'noAnswer'
            | 'notSupported'
            | 'notOnThisCable'
            | 'latched'
            | 'notDriving'
            | 'expired'
            | 'busy'
            | 'slotBroken'
            | 'slotChanged'
            | 'batteryLow'
            | 'cancelled'
            | 'outOfRange'
            | 'malformed'
            | 'forbidden'
            | 'notPaired'
            | 'pairingFailed'
            | 'pairingLocked'
            | 'wrongType'
            | 'notFound'
            | 'methodNotAllowed'
            | 'conflict'
            | 'tooLarge'
            | 'tooMany'
            | 'cameraFailed'
            | 'storageFull'
            | 'storageBusy'
            | 'storageFailed'
            | 'damaged'
            | 'internal'
          )
        | null;
      /** Detail */
      detail: string | null;
      /** Framecount */
      frameCount: number;
      /** Frameindex */
      frameIndex: number;
      /** Id */
      id: string;
      /**
       * Lateframes
       * @default 0
       */
      lateFrames: number;
      /**
       * Latestms
       * @default 0
       */
      latestMs: number;
      /**
       * Skippedframes
       * @default 0
       */
      skippedFrames: number;
      /**
       * Status
       * @enum {string}
       */
      status: 'playing' | 'done' | 'ended';
      /** Times */
      times: number;
    };
    /**
     * PlayWish
     * @description `id` and `nonce`: of the page that drives, which gets `played` with that id on its WebSocket. A program
     *     needs neither. `continueForMs`: how long it may continue without a `heartbeat`.
     */
    PlayWish: {
      /**
       * Anyway
       * @description A person wants it although the battery is at its alarm and new runs are refused.
       * @default false
       */
      anyway?: boolean;
      /** Continueforms */
      continueForMs?: number | null;
      /** Frames */
      frames: components['schemas']['FrameBody'][];
      /** Id */
      id?: number | null;
      /**
       * Loopfrom
       * @default 0
       */
      loopFrom?: number;
      /** Nonce */
      nonce?: string | null;
      /**
       * Take
       * @description An owner's: without asking the driver.
       * @default false
       */
      take?: boolean;
      /**
       * Times
       * @default 1
       */
      times?: number;
      /** Waitms */
      waitMs?: number | null;
    };
    /** PortChoice */
    PortChoice: {
      /** Board */
      board?: string | null;
      /** Device */
      device: string;
    };
    /**
     * PortState
     * @description The state of the serial port. `code` and `detail` say why it is lost, `heldBy` which programs have it
     *     open where the system lists them, `retryInMs` when the next attempt follows. `simulated`: it leads to a
     *     simulated board. `withheld`: commands that this cable does not carry, although the board may know them.
     */
    PortState: {
      /** Code */
      code:
        | (
            | 'closed'
            | 'lost'
            | 'portMissing'
            | 'portBusy'
            | 'portDenied'
            | 'hidDenied'
            | 'otherDevice'
            | 'boardUnknown'
            | 'wrongBoard'
            | 'echo'
            | 'boardSilent'
            | 'noAnswer'
            | 'notSupported'
            | 'notOnThisCable'
            | 'latched'
            | 'notDriving'
            | 'expired'
            | 'busy'
            | 'slotBroken'
            | 'slotChanged'
            | 'batteryLow'
            | 'cancelled'
            | 'outOfRange'
            | 'malformed'
            | 'forbidden'
            | 'notPaired'
            | 'pairingFailed'
            | 'pairingLocked'
            | 'wrongType'
            | 'notFound'
            | 'methodNotAllowed'
            | 'conflict'
            | 'tooLarge'
            | 'tooMany'
            | 'cameraFailed'
            | 'storageFull'
            | 'storageBusy'
            | 'storageFailed'
            | 'damaged'
            | 'internal'
          )
        | null;
      /** Detail */
      detail: string | null;
      /** Device */
      device: string | null;
      /** Heldby */
      heldBy: string[];
      /** Retryinms */
      retryInMs: number | null;
      /**
       * Simulated
       * @default false
       */
      simulated: boolean;
      /**
       * Status
       * @enum {string}
       */
      status: 'closed' | 'opening' | 'open' | 'lost';
      /** Withheld */
      withheld: ('download' | 'erase')[];
    };
    /**
     * Poses
     * @description Of the robot on the board.
     */
    Poses: {
      /** Poses */
      poses: components['schemas']['NamedPose'][];
      /** Robot */
      robot: string;
    };
    /** PoseTarget */
    PoseTarget: {
      /** Position */
      position: number;
      /** Servo */
      servo: number;
    };
    /** PositionsReport */
    PositionsReport: {
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'positions';
      /** Positions */
      positions: components['schemas']['ServoPosition'][];
    };
    /**
     * Problem
     * @description Why a request failed. `code` is for programs, `detail` for people. `heldBy`: with `portBusy` the
     *     programs that have the port, where the system tells.
     */
    Problem: {
      /**
       * Code
       * @enum {string}
       */
      code:
        | 'closed'
        | 'lost'
        | 'portMissing'
        | 'portBusy'
        | 'portDenied'
        | 'hidDenied'
        | 'otherDevice'
        | 'boardUnknown'
        | 'wrongBoard'
        | 'echo'
        | 'boardSilent'
        | 'noAnswer'
        | 'notSupported'
        | 'notOnThisCable'
        | 'latched'
        | 'notDriving'
        | 'expired'
        | 'busy'
        | 'slotBroken'
        | 'slotChanged'
        | 'batteryLow'
        | 'cancelled'
        | 'outOfRange'
        | 'malformed'
        | 'forbidden'
        | 'notPaired'
        | 'pairingFailed'
        | 'pairingLocked'
        | 'wrongType'
        | 'notFound'
        | 'methodNotAllowed'
        | 'conflict'
        | 'tooLarge'
        | 'tooMany'
        | 'cameraFailed'
        | 'storageFull'
        | 'storageBusy'
        | 'storageFailed'
        | 'damaged'
        | 'internal';
      /** Detail */
      detail: string;
      /**
       * Heldby
       * @default null
       */
      heldBy?: string[] | null;
    };
    /**
     * RateFound
     * @description The first other speed at which something that can be read arrives, and what; both null where there is
     *     none.
     */
    RateFound: {
      /** Baud */
      baud: number | null;
      /** Kind */
      kind: ('packets' | 'text') | null;
    };
    /**
     * RobotChoice
     * @description `insteadOf`: the robot that the caller expects there.
     */
    RobotChoice: {
      /** Id */
      id: string;
      /** Insteadof */
      insteadOf?: string | null;
    };
    /**
     * RobotFacts
     * @description The facts of a robot that the gateway needs: the limits of its servos and the poses for programs, in
     *     the board's unit. `lowBatteryMv`: at or below, its battery is low; at or below `alarmMv` its
     *     `batteryPolicy` holds. These are null where a version of before stored it.
     */
    'RobotFacts-Input': {
      /** Alarmmv */
      alarmMv?: number | null;
      /** Batterypolicy */
      batteryPolicy?: ('tell' | 'refuse' | 'rest') | null;
      /** Board */
      board: string;
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'robot';
      /** Limits */
      limits: components['schemas']['ServoLimits-Input'][];
      /** Lowbatterymv */
      lowBatteryMv?: number | null;
      /** Name */
      name: string;
      /** Poses */
      poses: components['schemas']['NamedPose'][];
      /** Updatedatms */
      updatedAtMs: number;
    };
    /**
     * RobotFacts
     * @description The facts of a robot that the gateway needs: the limits of its servos and the poses for programs, in
     *     the board's unit. `lowBatteryMv`: at or below, its battery is low; at or below `alarmMv` its
     *     `batteryPolicy` holds. These are null where a version of before stored it.
     */
    'RobotFacts-Output': {
      /** Alarmmv */
      alarmMv: number | null;
      /** Batterypolicy */
      batteryPolicy: ('tell' | 'refuse' | 'rest') | null;
      /** Board */
      board: string;
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'robot';
      /** Limits */
      limits: components['schemas']['ServoLimits-Output'][];
      /** Lowbatterymv */
      lowBatteryMv: number | null;
      /** Name */
      name: string;
      /** Poses */
      poses: components['schemas']['NamedPose'][];
      /** Updatedatms */
      updatedAtMs: number;
    };
    /**
     * RunBegun
     * @description `batteryUnknown`: a run is refused where the battery is at its alarm, and its voltage is not known.
     *     `acknowledged`: the board has accepted the command, which says nothing about the slot. `silent`: the
     *     acknowledgement is missing. `sent`: such a board sends none.
     */
    RunBegun: {
      /** Batteryunknown */
      batteryUnknown?: boolean | null;
      /** Ended */
      ended?: boolean | null;
      /**
       * Outcome
       * @enum {string}
       */
      outcome: 'acknowledged' | 'silent' | 'sent';
    };
    /**
     * Running
     * @description The group that may run: it was begun, and neither stopped nor reported as ended. `endsInMs`: at the
     *     latest; null where only the board knows, which not every family reports.
     */
    Running: {
      /** Endsinms */
      endsInMs: number | null;
      /** Slot */
      slot: number;
      /** Times */
      times: number;
    };
    /**
     * RunWish
     * @description `times` 0: until stopped. `continueForMs`: how long the run may continue without a `heartbeat`.
     */
    RunWish: {
      /**
       * Anyway
       * @description A person wants it although the battery is at its alarm and new runs are refused.
       * @default false
       */
      anyway?: boolean;
      /** Continueforms */
      continueForMs?: number | null;
      /**
       * Take
       * @description An owner's: without asking the driver.
       * @default false
       */
      take?: boolean;
      /**
       * Times
       * @default 1
       */
      times?: number;
      /** Waitms */
      waitMs?: number | null;
    };
    /**
     * ServoLimits
     * @description The limits of a servo, its trim, which is in them already, all in its board's unit, and its name. A
     *     page of before stored no trim.
     */
    'ServoLimits-Input': {
      /** Max */
      max: number;
      /** Min */
      min: number;
      /** Name */
      name: string;
      /** Servo */
      servo: number;
      /**
       * Trim
       * @default 0
       */
      trim?: number;
    };
    /**
     * ServoLimits
     * @description The limits of a servo, its trim, which is in them already, all in its board's unit, and its name. A
     *     page of before stored no trim.
     */
    'ServoLimits-Output': {
      /** Max */
      max: number;
      /** Min */
      min: number;
      /** Name */
      name: string;
      /** Servo */
      servo: number;
      /**
       * Trim
       * @default 0
       */
      trim: number;
    };
    /**
     * ServoPosition
     * @description In the board's unit.
     */
    ServoPosition: {
      /** Position */
      position: number;
      /** Servo */
      servo: number;
    };
    /**
     * SilentEvidence
     * @description It did not answer that question.
     */
    SilentEvidence: {
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'silent';
      /**
       * Question
       * @enum {string}
       */
      question: 'readBattery' | 'readVersion' | 'readPositions';
    };
    /**
     * Status
     * @description `play`: what the gateway plays now, or played last. `fleet`: null where it is on no broker.
     */
    Status: {
      battery: components['schemas']['BatteryAge'] | null;
      /** Board */
      board: string;
      /** Clients */
      clients: number;
      /** Driver */
      driver: string | null;
      fleet: components['schemas']['FleetStatus'] | null;
      identity: components['schemas']['IdentityState'];
      /** Latch */
      latch: boolean;
      link: components['schemas']['LinkState'];
      /** Notifications */
      notifications: components['schemas']['NotificationReceiver'][];
      play: components['schemas']['PlayState'] | null;
      port: components['schemas']['PortState'];
      running: components['schemas']['Running'] | null;
      unattended: components['schemas']['UnattendedRun'] | null;
      /** Version */
      version: string;
    };
    /** StopLink */
    StopLink: {
      /** Id */
      id: string;
      /** Link */
      link: string;
      /** Picture */
      picture: string;
    };
    /** StopLinkWish */
    StopLinkWish: {
      /** Name */
      name: string;
    };
    /**
     * Stopped
     * @description `halted`: the stop sequence has left the wire. `unheld`: servos that may continue to move, because
     *     their position is unknown; null where all are held.
     */
    Stopped: {
      /** Halted */
      halted: boolean;
      /** Latch */
      latch: boolean;
      unheld: components['schemas']['UnheldServos'] | null;
    };
    /** StoredDocument */
    StoredDocument: {
      /** Revision */
      revision: number;
      /**
       * Text
       * @description The document as JSON; only the page knows what it means.
       */
      text: string;
    };
    /**
     * Token
     * @description Shown once: only its SHA-256 is stored.
     */
    Token: {
      /** Id */
      id: string;
      /** Token */
      token: string;
    };
    /**
     * TokenWish
     * @description `expiresInDays`: from now, of 24 hours each; without it the token is valid until it is revoked.
     */
    TokenWish: {
      /** Expiresindays */
      expiresInDays?: number | null;
      /** Name */
      name: string;
      /**
       * Role
       * @enum {string}
       */
      role: 'viewer' | 'driver' | 'owner';
    };
    /** Trouble */
    Trouble: {
      /** Detail */
      detail: string;
      /**
       * Part
       * @enum {string}
       */
      part: 'port' | 'loop' | 'disk';
    };
    /**
     * UnattendedRun
     * @description A run that may continue without its driver `by`, for `endsInMs` at most. `slot` is null where the
     *     gateway plays. `isMove`: it is a move of the program `by`, which ends by itself.
     */
    UnattendedRun: {
      /** By */
      by: string;
      /** Endsinms */
      endsInMs: number;
      /**
       * Ismove
       * @default false
       */
      isMove: boolean;
      /** Slot */
      slot: number | null;
      /** Times */
      times: number;
    };
    /**
     * UnheldServos
     * @description Motion that a STOP could not hold: `servos`, `null` where unknown, that may move for `forMs` after the
     *     press at most; `null` where the board may not have received the stop.
     */
    UnheldServos: {
      /** Forms */
      forMs: number | null;
      /** Servos */
      servos: number[] | null;
    };
    /**
     * VersionReport
     * @description The kind of the board's servos, by the unit of their positions, and its firmware.
     */
    VersionReport: {
      /**
       * @description discriminator enum property added by openapi-typescript
       * @enum {string}
       */
      kind: 'version';
      /**
       * Unit
       * @enum {string}
       */
      unit: 'us' | 'steps';
      /** Version */
      version: number;
    };
    /** VersionText */
    VersionText: {
      /**
       * Text
       * @description The document as JSON; only the page knows what it means.
       */
      text: string;
    };
    /** VersionWrite */
    VersionWrite: {
      /** Atms */
      atMs: number;
      /** Name */
      name: string;
      /**
       * Text
       * @description The document as JSON; only the page knows what it means.
       */
      text: string;
    };
    /** You */
    You: {
      /** Id */
      id: string;
      /** Name */
      name: string;
      /**
       * Role
       * @enum {string}
       */
      role: 'stopper' | 'viewer' | 'driver' | 'owner';
    };
  };
  responses: never;
  parameters: never;
  requestBodies: never;
  headers: never;
  pathItems: never;
}
export type AnsweredEvidence = components['schemas']['AnsweredEvidence'];
export type ApplyWish = components['schemas']['ApplyWish'];
export type AuditEntry = components['schemas']['AuditEntry'];
export type AuditPage = components['schemas']['AuditPage'];
export type Battery = components['schemas']['Battery'];
export type BatteryAge = components['schemas']['BatteryAge'];
export type BatteryReport = components['schemas']['BatteryReport'];
export type BoardChoice = components['schemas']['BoardChoice'];
export type CameraName = components['schemas']['CameraName'];
export type Candidate = components['schemas']['Candidate'];
export type Device = components['schemas']['Device'];
export type DocumentIds = components['schemas']['DocumentIds'];
export type DocumentWrite = components['schemas']['DocumentWrite'];
export type DocumentWritten = components['schemas']['DocumentWritten'];
export type DownloadWish = components['schemas']['DownloadWish'];
export type Draft = components['schemas']['Draft'];
export type DraftStored = components['schemas']['DraftStored'];
export type DriverWish = components['schemas']['DriverWish'];
export type EchoedEvidence = components['schemas']['EchoedEvidence'];
export type Erased = components['schemas']['Erased'];
export type EraseWish = components['schemas']['EraseWish'];
export type FleetBroker = components['schemas']['FleetBroker'];
export type FleetChanges = components['schemas']['FleetChanges'];
export type FleetCue = components['schemas']['FleetCue'];
export type FleetCues = components['schemas']['FleetCues'];
export type FleetDownloadWish = components['schemas']['FleetDownloadWish'];
export type FleetEvent = components['schemas']['FleetEvent'];
export type FleetGroupWish = components['schemas']['FleetGroupWish'];
export type FleetResumeWish = components['schemas']['FleetResumeWish'];
export type FleetRobot = components['schemas']['FleetRobot'];
export type FleetRun = components['schemas']['FleetRun'];
export type FleetRunning = components['schemas']['FleetRunning'];
export type FleetRunWish = components['schemas']['FleetRunWish'];
export type FleetSlot = components['schemas']['FleetSlot'];
export type FleetState = components['schemas']['FleetState'];
export type FleetStatus = components['schemas']['FleetStatus'];
export type FleetStopped = components['schemas']['FleetStopped'];
export type FleetStopWish = components['schemas']['FleetStopWish'];
export type FleetTask = components['schemas']['FleetTask'];
export type FleetTaskPart = components['schemas']['FleetTaskPart'];
export type FrameBody = components['schemas']['FrameBody'];
export type GroupBody = components['schemas']['GroupBody'];
export type GroupFacts = components['schemas']['GroupFacts'];
export type Health = components['schemas']['Health'];
export type IdentityState = components['schemas']['IdentityState'];
export type Invitation = components['schemas']['Invitation'];
export type InviteWish = components['schemas']['InviteWish'];
export type JobState = components['schemas']['JobState'];
export type LeaseState = components['schemas']['LeaseState'];
export type LeaseWish = components['schemas']['LeaseWish'];
export type LibraryListing = components['schemas']['LibraryListing'];
export type LinkState = components['schemas']['LinkState'];
export type ListedDocument = components['schemas']['ListedDocument'];
export type ListedVersion = components['schemas']['ListedVersion'];
export type Me = components['schemas']['Me'];
export type MoveBegun = components['schemas']['MoveBegun'];
export type MoveWish = components['schemas']['MoveWish'];
export type NamedPose = components['schemas']['NamedPose'];
export type NoiseEvidence = components['schemas']['NoiseEvidence'];
export type NotificationReceiver = components['schemas']['NotificationReceiver'];
export type OwnName = components['schemas']['OwnName'];
export type PairWish = components['schemas']['PairWish'];
export type People = components['schemas']['People'];
export type Person = components['schemas']['Person'];
export type PersonChange = components['schemas']['PersonChange'];
export type PlayState = components['schemas']['PlayState'];
export type PlayWish = components['schemas']['PlayWish'];
export type PortChoice = components['schemas']['PortChoice'];
export type PortState = components['schemas']['PortState'];
export type Poses = components['schemas']['Poses'];
export type PoseTarget = components['schemas']['PoseTarget'];
export type PositionsReport = components['schemas']['PositionsReport'];
export type Problem = components['schemas']['Problem'];
export type RateFound = components['schemas']['RateFound'];
export type RobotChoice = components['schemas']['RobotChoice'];
export type RobotFactsInput = components['schemas']['RobotFacts-Input'];
export type RobotFactsOutput = components['schemas']['RobotFacts-Output'];
export type RunBegun = components['schemas']['RunBegun'];
export type Running = components['schemas']['Running'];
export type RunWish = components['schemas']['RunWish'];
export type ServoLimitsInput = components['schemas']['ServoLimits-Input'];
export type ServoLimitsOutput = components['schemas']['ServoLimits-Output'];
export type ServoPosition = components['schemas']['ServoPosition'];
export type SilentEvidence = components['schemas']['SilentEvidence'];
export type Status = components['schemas']['Status'];
export type StopLink = components['schemas']['StopLink'];
export type StopLinkWish = components['schemas']['StopLinkWish'];
export type Stopped = components['schemas']['Stopped'];
export type StoredDocument = components['schemas']['StoredDocument'];
export type Token = components['schemas']['Token'];
export type TokenWish = components['schemas']['TokenWish'];
export type Trouble = components['schemas']['Trouble'];
export type UnattendedRun = components['schemas']['UnattendedRun'];
export type UnheldServos = components['schemas']['UnheldServos'];
export type VersionReport = components['schemas']['VersionReport'];
export type VersionText = components['schemas']['VersionText'];
export type VersionWrite = components['schemas']['VersionWrite'];
export type You = components['schemas']['You'];
export type $defs = Record<string, never>;
export interface operations {
  auditRead: {
    parameters: {
      query?: {
        /** @description Only of this kind. */
        act?:
          | (
              | 'tookLease'
              | 'leftLease'
              | 'moved'
              | 'ran'
              | 'endedGroup'
              | 'played'
              | 'downloaded'
              | 'downloadFailed'
              | 'erased'
              | 'setSpeed'
              | 'unpowered'
              | 'stopped'
              | 'resumed'
              | 'calibrated'
              | 'allowedUnattended'
              | 'boardChosen'
              | 'gatewayStarted'
              | 'gatewayEnded'
              | 'restored'
              | 'paired'
              | 'pairRefused'
              | 'invited'
              | 'withdrew'
              | 'renamed'
              | 'roleChanged'
              | 'revoked'
              | 'tokenMade'
              | 'tokenExpired'
              | 'stopLinkMade'
              | 'portOpened'
              | 'portClosed'
              | 'robotChosen'
              | 'librarySaved'
              | 'libraryRemoved'
              | 'libraryRestored'
              | 'fleetStopped'
              | 'fleetAsked'
              | 'fleetGrouped'
            )
          | null;
        /** @description Only older ones than that entry. */
        before?: number | null;
        limit?: number;
        /** @description Only of this person, by name. */
        who?: string | null;
      };
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['AuditPage'];
        };
      };
    };
  };
  auditExport: {
    parameters: {
      query?: {
        /** @description Only of this kind. */
        act?:
          | (
              | 'tookLease'
              | 'leftLease'
              | 'moved'
              | 'ran'
              | 'endedGroup'
              | 'played'
              | 'downloaded'
              | 'downloadFailed'
              | 'erased'
              | 'setSpeed'
              | 'unpowered'
              | 'stopped'
              | 'resumed'
              | 'calibrated'
              | 'allowedUnattended'
              | 'boardChosen'
              | 'gatewayStarted'
              | 'gatewayEnded'
              | 'restored'
              | 'paired'
              | 'pairRefused'
              | 'invited'
              | 'withdrew'
              | 'renamed'
              | 'roleChanged'
              | 'revoked'
              | 'tokenMade'
              | 'tokenExpired'
              | 'stopLinkMade'
              | 'portOpened'
              | 'portClosed'
              | 'robotChosen'
              | 'librarySaved'
              | 'libraryRemoved'
              | 'libraryRestored'
              | 'fleetStopped'
              | 'fleetAsked'
              | 'fleetGrouped'
            )
          | null;
        format?: 'csv' | 'jsonl';
        /** @description Only of this person, by name. */
        who?: string | null;
      };
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/jsonl': unknown;
          'text/csv': unknown;
        };
      };
    };
  };
  gatewayBattery: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Battery'];
        };
      };
    };
  };
  gatewayNameBoard: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['BoardChoice'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Status'];
        };
      };
    };
  };
  camerasListCameras: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['CameraName'][];
        };
      };
    };
  };
  camerasStream: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        camera_id: number;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'multipart/x-mixed-replace': unknown;
        };
      };
    };
  };
  jobsDownload: {
    parameters: {
      query?: never;
      header?: {
        /** @description Of this request, by the client. A repeat within ten minutes gets the first answer. */
        'idempotency-key'?: string | null;
      };
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['DownloadWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      202: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['JobState'];
        };
      };
    };
  };
  motionGive: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['DriverWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['LeaseState'];
        };
      };
    };
  };
  motionErase: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: {
      content: {
        'application/json': components['schemas']['EraseWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Erased'];
        };
      };
    };
  };
  eventsEvents: {
    parameters: {
      query?: never;
      header?: {
        'last-event-id'?: string | null;
      };
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'text/event-stream': string;
        };
      };
    };
  };
  fleetChanges: {
    parameters: {
      query?: {
        /** @description 0: all of it. */
        since?: number;
      };
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['FleetChanges'];
        };
      };
    };
  };
  fleetSetCues: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['FleetCues'];
      };
    };
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  fleetDownload: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['FleetDownloadWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['FleetTask'];
        };
      };
    };
  };
  fleetGroup: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['FleetGroupWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  fleetResume: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['FleetResumeWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['FleetTask'];
        };
      };
    };
  };
  fleetRun: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['FleetRunWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['FleetTask'];
        };
      };
    };
  };
  fleetStop: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['FleetStopWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['FleetStopped'];
        };
      };
    };
  };
  fleetRetry: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        task: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['FleetTask'];
        };
      };
    };
  };
  healthHealth: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Health'];
        };
      };
    };
  };
  peopleInvite: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['InviteWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Invitation'];
        };
      };
    };
  };
  peopleWithdraw: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        invitation: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  jobsJobState: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        job: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['JobState'];
        };
      };
    };
  };
  jobsCancel: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        job: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['JobState'];
        };
      };
    };
  };
  motionLease: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['LeaseWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['LeaseState'];
        };
      };
    };
  };
  libraryListDocuments: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['LibraryListing'];
        };
      };
    };
  };
  libraryRead: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        document: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['StoredDocument'];
        };
      };
    };
  };
  libraryWrite: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        document: string;
      };
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['DocumentWrite'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['DocumentWritten'];
        };
      };
    };
  };
  libraryListVersions: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        document: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['ListedVersion'][];
        };
      };
    };
  };
  libraryReadVersion: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        document: string;
        version: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['VersionText'];
        };
      };
    };
  };
  libraryKeepVersion: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        document: string;
        version: string;
      };
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['VersionWrite'];
      };
    };
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  libraryRemoveVersion: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        document: string;
        version: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  libraryPropose: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['Draft'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['DraftStored'];
        };
      };
    };
  };
  libraryRemove: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['DocumentIds'];
      };
    };
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  libraryRestore: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['DocumentIds'];
      };
    };
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  peopleMe: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Me'];
        };
      };
    };
  };
  peopleRenameMe: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['OwnName'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['You'];
        };
      };
    };
  };
  motionMove: {
    parameters: {
      query?: never;
      header?: {
        /** @description Of this request, by the client. A repeat within ten minutes gets the first answer. */
        'idempotency-key'?: string | null;
      };
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['MoveWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['MoveBegun'];
        };
      };
    };
  };
  peoplePair: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['PairWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['You'];
        };
      };
    };
  };
  peoplePeople: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['People'];
        };
      };
    };
  };
  peopleRevoke: {
    parameters: {
      query?: {
        /** @description Whether a group that it let continue without it may continue. */
        continues?: boolean;
      };
      header?: never;
      path: {
        person: string;
      };
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  peopleChange: {
    parameters: {
      query?: never;
      header?: never;
      path: {
        person: string;
      };
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['PersonChange'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Person'];
        };
      };
    };
  };
  playPlay: {
    parameters: {
      query?: never;
      header?: {
        /** @description Of this request, by the client. A repeat within ten minutes gets the first answer. */
        'idempotency-key'?: string | null;
      };
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['PlayWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      202: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['PlayState'];
        };
      };
    };
  };
  playStopPlaying: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['PlayState'] | null;
        };
      };
    };
  };
  gatewayUsePort: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['PortChoice'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['PortState'];
        };
      };
    };
  };
  gatewayClosePort: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['PortState'];
        };
      };
    };
  };
  gatewayListen: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['RateFound'];
        };
      };
    };
  };
  gatewayPorts: {
    parameters: {
      query?: {
        bluetooth?: boolean;
      };
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Device'][];
        };
      };
    };
  };
  posesListPoses: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Poses'];
        };
      };
    };
  };
  posesApply: {
    parameters: {
      query?: never;
      header?: {
        /** @description Of this request, by the client. A repeat within ten minutes gets the first answer. */
        'idempotency-key'?: string | null;
      };
      path: {
        pose: string;
      };
      cookie?: never;
    };
    requestBody?: {
      content: {
        'application/json': components['schemas']['ApplyWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['MoveBegun'];
        };
      };
    };
  };
  gatewayResume: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Status'];
        };
      };
    };
  };
  robotsPutOnBoard: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['RobotChoice'];
      };
    };
    responses: {
      /** @description Successful Response */
      204: {
        headers: {
          [name: string]: unknown;
        };
        content?: never;
      };
    };
  };
  motionRun: {
    parameters: {
      query?: never;
      header?: {
        /** @description Of this request, by the client. A repeat within ten minutes gets the first answer. */
        'idempotency-key'?: string | null;
      };
      path: {
        slot: number;
      };
      cookie?: never;
    };
    requestBody?: {
      content: {
        'application/json': components['schemas']['RunWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['RunBegun'];
        };
      };
    };
  };
  gatewayStatus: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Status'];
        };
      };
    };
  };
  gatewayStop: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody?: never;
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Stopped'];
        };
      };
    };
  };
  peopleMakeStopLink: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['StopLinkWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['StopLink'];
        };
      };
    };
  };
  peopleMakeToken: {
    parameters: {
      query?: never;
      header?: never;
      path?: never;
      cookie?: never;
    };
    requestBody: {
      content: {
        'application/json': components['schemas']['TokenWish'];
      };
    };
    responses: {
      /** @description Successful Response */
      200: {
        headers: {
          [name: string]: unknown;
        };
        content: {
          'application/json': components['schemas']['Token'];
        };
      };
    };
  };
}

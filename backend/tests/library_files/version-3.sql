-- A library file as version 3 left it. Never change it: people have such files.
BEGIN TRANSACTION;
CREATE TABLE document (id TEXT PRIMARY KEY, revision INTEGER NOT NULL, removed_at_ms INTEGER, facts TEXT NOT NULL, text TEXT NOT NULL, kind TEXT NOT NULL DEFAULT 'group', text_sum INTEGER NOT NULL DEFAULT 0, facts_sum INTEGER NOT NULL DEFAULT 0);
INSERT INTO "document" VALUES('wave',2,NULL,'{"name":"Wave","kind":"group"}','{"frames":[1]}','group',2845601113,1623726501);
INSERT INTO "document" VALUES('old-pose',1,4102444800000,'{"name":"Posé","kind":"group"}','{"poses":[]}','group',2522226520,2403794084);
CREATE TABLE version (document TEXT NOT NULL REFERENCES document ON DELETE CASCADE, id TEXT NOT NULL, name TEXT NOT NULL, at_ms INTEGER NOT NULL, text TEXT NOT NULL, text_sum INTEGER NOT NULL DEFAULT 0, PRIMARY KEY (document, id));
INSERT INTO "version" VALUES('wave','v1','First try',1700000000000,'{"frames":[]}',3731264599);
PRAGMA user_version = 3;
COMMIT;

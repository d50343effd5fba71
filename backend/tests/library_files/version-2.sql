-- A library file as version 2 left it. Never change it: people have such files.
BEGIN TRANSACTION;
CREATE TABLE document (id TEXT PRIMARY KEY, revision INTEGER NOT NULL, removed_at_ms INTEGER, facts TEXT NOT NULL, text TEXT NOT NULL, kind TEXT NOT NULL DEFAULT 'group');
INSERT INTO "document" VALUES('wave',2,NULL,'{"name":"Wave","kind":"group"}','{"frames":[1]}','group');
INSERT INTO "document" VALUES('old-pose',1,4102444800000,'{"name":"Posé","kind":"group"}','{"poses":[]}','group');
CREATE TABLE version (document TEXT NOT NULL REFERENCES document ON DELETE CASCADE, id TEXT NOT NULL, name TEXT NOT NULL, at_ms INTEGER NOT NULL, text TEXT NOT NULL, PRIMARY KEY (document, id));
INSERT INTO "version" VALUES('wave','v1','First try',1700000000000,'{"frames":[]}');
PRAGMA user_version = 2;
COMMIT;

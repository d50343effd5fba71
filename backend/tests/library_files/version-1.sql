-- A library file as version 1 left it. Never change it: people have such files.
BEGIN TRANSACTION;
CREATE TABLE document (id TEXT PRIMARY KEY, revision INTEGER NOT NULL, removed_at_ms INTEGER, facts TEXT NOT NULL, text TEXT NOT NULL);
INSERT INTO "document" VALUES('wave',2,NULL,'{"name":"Wave"}','{"frames":[1]}');
INSERT INTO "document" VALUES('old-pose',1,4102444800000,'{"name":"Posé"}','{"poses":[]}');
CREATE TABLE version (document TEXT NOT NULL REFERENCES document ON DELETE CASCADE, id TEXT NOT NULL, name TEXT NOT NULL, at_ms INTEGER NOT NULL, text TEXT NOT NULL, PRIMARY KEY (document, id));
INSERT INTO "version" VALUES('wave','v1','First try',1700000000000,'{"frames":[]}');
PRAGMA user_version = 1;
COMMIT;

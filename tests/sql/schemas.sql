-- schemas.sql: typify, PostGIS and the tables in three schemas, none of them on the search_path, names that need
-- quoting, and a role that owns its tables and nothing else
\set SHOW_CONTEXT never
SET client_min_messages = warning;
SELECT current_database() AS home \gset
DROP DATABASE IF EXISTS typify_schemas;
DROP ROLE IF EXISTS regress_typify_cartographer;
CREATE DATABASE typify_schemas TEMPLATE template0;
CREATE ROLE regress_typify_cartographer;
\c typify_schemas
SET client_min_messages = warning;
CREATE SCHEMA "Post GIS";
CREATE SCHEMA "Typify, 1";
CREATE SCHEMA "My Maps" AUTHORIZATION regress_typify_cartographer;
CREATE SCHEMA not_mine;
REVOKE ALL ON SCHEMA public FROM public;
CREATE EXTENSION postgis SCHEMA "Post GIS";
CREATE EXTENSION typify SCHEMA "Typify, 1";
GRANT USAGE ON SCHEMA "Post GIS", "Typify, 1", not_mine TO public;
SET SESSION AUTHORIZATION regress_typify_cartographer;
SET search_path = '';
RESET client_min_messages;

-- whoever puts his own functions and operators in front changes nothing
CREATE TABLE "My Maps"."Houses, 25" ("Id" integer PRIMARY KEY, "Block ""A""" text, "The Geom" "Post GIS".geometry("Post GIS".Polygon, 25832));

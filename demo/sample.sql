-- sample.sql: the shipped settlement under the names that the demo uses

CREATE SCHEMA demo;
CREATE TABLE demo.subject AS
SELECT 'a small town and its villages'::text AS name, 'sample data, made by arithmetic'::text AS attribution;
CREATE TABLE buildings AS SELECT id, class, block, geom FROM settlement_buildings;
CREATE TABLE demo.road AS SELECT class, geom FROM settlement_roads;

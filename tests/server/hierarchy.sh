#!/bin/bash
# hierarchy.sh - the fear: at some scale a hierarchy shows what the aggregate does not give there; a build that was
# stopped goes on to something else than one that was not; after edits a refreshed hierarchy is not what building it
# anew gives. Uses the server of the PG* variables, and the data in TYPIFY_DATA where there is some.
. "$(dirname "$0")/common.sh"

fresh_database typify_hierarchy tests/data/settlement.sql
scratch=$OWN_FOLDER
sql -o /dev/null <<'SQL'
CREATE TABLE lod25 AS SELECT id, block, geom FROM settlement_buildings;
ALTER TABLE lod25 ADD PRIMARY KEY (id);
-- a hash of the rows that a query gives, in any order
CREATE FUNCTION picture(query text) RETURNS numeric LANGUAGE plpgsql AS
$$
DECLARE
	hash numeric;
BEGIN
	EXECUTE 'SELECT sum(hash_record(q)) FROM (' || query || ') AS q' INTO hash;
	RETURN hash;
END
$$;
-- how many of these scales show what typify_placeholders does not give, for a hierarchy of one group
CREATE FUNCTION unlike(hierarchy regclass, source regclass, s_u float8, scales float8[], members boolean)
RETURNS bigint LANGUAGE sql AS
$$
	SELECT count(*) FILTER (WHERE picture(format('SELECT id, geom, member_count, %s AS members, area, width, length, '
			'orientation FROM typify_at(%L, %L, NULL, %L)', CASE WHEN members THEN 'members' ELSE 'NULL' END, hierarchy, scale,
			members))
		IS DISTINCT FROM picture(format('SELECT id, geom, member_count, %s AS members, area, width, length, orientation FROM
			unnest((SELECT typify_placeholders(geom, id, %L, %s) FROM %s))', CASE WHEN members THEN 'members' ELSE 'NULL' END,
			scale, s_u, source)))
	FROM unnest(scales) AS scale
$$;
-- a hierarchy by what its rows say, whatever its groups are numbered
CREATE FUNCTION content(hierarchy regclass) RETURNS numeric LANGUAGE sql AS
$$
	SELECT picture(format('SELECT g.grp, node, parent, kept, representative, member_count, first_leaf, x, y, area, ratio, ux,
		uy, cost, scale_from, scale_to, place::text, g.count, exponent, psi, built, state, reach, extent, latitude
		FROM %s FULL JOIN %s_groups AS g USING (group_id)', hierarchy, hierarchy))
$$;
SQL

# --- every count, from all buildings to one ---

for s_u in 0 0.5 1; do
	every=$([ $s_u = 0.5 ] && echo 1 || echo 25)
	sql -c "CALL typify_build_hierarchy('whole', 'lod25', $s_u)"
	check "s_u $s_u: scales that show something else, of $(answer "SELECT count(*) FROM whole WHERE node % $every = 0 AND
		member_count > 1"), one for every $every. count" "$(answer "SELECT unlike('whole', 'lod25', $s_u,
		array_agg(scale_from), $every > 1) FROM whole WHERE node % $every = 0 AND member_count > 1")" 0
	sql -c 'DROP TABLE whole, whole_groups'
done

# --- stopped and gone on with ---

sql -o /dev/null <<'SQL'
-- from so many groups on, reading the buildings takes so many seconds longer
CREATE FUNCTION nap() RETURNS boolean LANGUAGE plpgsql AS
$$
BEGIN
	IF current_setting('typify_test.groups', true) <> '' AND to_regclass('stopped') IS NOT NULL THEN
		IF (SELECT count(*) FROM stopped_groups WHERE built) >= current_setting('typify_test.groups')::bigint THEN
			PERFORM pg_sleep(60);
		END IF;
	END IF;
	RETURN true;
END
$$;
CREATE VIEW slow AS SELECT b.* FROM lod25 AS b, (SELECT nap() OFFSET 0) AS n;
SQL
sql -c "CALL typify_build_hierarchy('unstopped', 'lod25', 0.5, 'block')"
# build BATCH GROUPS: in the background, sleeping from so many groups on
build() {
	PGAPPNAME=build PGOPTIONS="-c typify_test.groups=$2" sql -v VERBOSITY=verbose \
		-c "CALL typify_build_hierarchy('stopped', 'slow', 0.5, 'block', batch => $1)" >"$scratch/words" 2>&1 </dev/null &
}
# stop FUNCTION: calls it on the backend that builds as soon as that sleeps
stop() {
	for ((i = 0; i < 300; i++)); do
		if [ "$(answer "SELECT $1(pid) FROM pg_stat_activity WHERE application_name = 'build' AND wait_event = 'PgSleep'")" ]
		then break; fi
		sleep 0.1
	done
	wait || true
}
done_groups() { answer 'SELECT count(*) FROM stopped_groups WHERE built'; }
build 1 5
stop pg_cancel_backend
check "cancelled: groups that are there" "$(done_groups)" 5
check "what a look-up says" "$(sql -c "SELECT * FROM typify_at('stopped', 50000)" 2>&1 | head -1)" \
	'ERROR:  public.stopped is not finished'
build 4 20
stop pg_terminate_backend
check "cut off: groups that are there" "$(done_groups)" 21
sql -c "UPDATE lod25 SET geom = ST_Translate(geom, 1, 0) WHERE block = 1"
sql -c "CALL typify_build_hierarchy('stopped', 'slow', 0.5, 'block', batch => 30)"
sql -c 'DROP TABLE unstopped, unstopped_groups' -c "CALL typify_build_hierarchy('unstopped', 'lod25', 0.5, 'block')"
check "gone on with, after an edit in a group that was done: as if it had never stopped" \
	"$(answer "SELECT content('stopped') = content('unstopped')")" t

# --- dumped and restored ---

pg_dump typify_hierarchy >"$scratch/dump.sql"
createdb typify_hierarchy_restored
OWN_DATABASES+=(typify_hierarchy_restored)
PGDATABASE=typify_hierarchy_restored sql -o /dev/null -f "$scratch/dump.sql"
for scale in 25000 80000; do
	check "restored, at 1:$scale" "$(PGDATABASE=typify_hierarchy_restored answer "SELECT content('unstopped'), count(*)
		FROM typify_at('unstopped', $scale)")" "$(answer "SELECT content('unstopped'), count(*) FROM typify_at('unstopped', $scale)")"
done

# --- edited and refreshed ---

sql -c "CALL typify_build_hierarchy('ranked', 'lod25', 0.5, 'block', life_spans => 'ranked')"
# round FIRST: forty edits, half of the rounds refreshed by the names of the blocks
round() {
	cat <<-SQL
		SELECT array_agg(DISTINCT block) AS touched FROM generate_series($1, $1 + 39) AS number,
			unnest(pg_temp.edit('lod25', number)) AS block \gset
		SELECT 'stale ' || count(*)
		FROM typify_refresh_hierarchy('unstopped', CASE WHEN $1 % 80 = 1 THEN :'touched'::text[] END);
		SELECT count(*) FROM typify_refresh_hierarchy('ranked', max_zoom => NULL) \g /dev/null
		CALL typify_build_hierarchy('anew', 'lod25', 0.5, 'block');
		CALL typify_build_hierarchy('ranked_anew', 'lod25', 0.5, 'block', life_spans => 'ranked');
		SELECT CASE WHEN content('unstopped') = content('anew') AND content('ranked') = content('ranked_anew')
			THEN 'same' ELSE 'other' END;
		DROP TABLE anew, anew_groups, ranked_anew, ranked_anew_groups;
	SQL
}
for ((first = 1; first < 1000; first += 40)); do round $first; done | sql -At -f tests/data/edits.sql -f - >"$scratch/edits"
check "1000 edits, refreshed 25 times, each_group and ranked, half of them by name: as built anew" \
	"$(grep -cx same "$scratch/edits")" 25
check "edits that left no tile stale" "$(grep -c '^stale 0$' "$scratch/edits" || true)" 0

# --- real buildings ---

file=${TYPIFY_DATA:-../shared/data}/liechtenstein_2024/buildings.csv.gz
if [ -r "$file" ]; then
	sql -c 'CREATE TABLE buildings (id bigint PRIMARY KEY, class text, geom geometry NOT NULL)' \
		-c '\copy buildings FROM PSTDIN WITH (FORMAT csv, HEADER true)' -c 'ANALYZE buildings' < <(gzip -dc "$file")
	for s_u in 0 0.5 1; do
		sql -c "CALL typify_build_hierarchy('country', 'buildings', $s_u)"
		check "Liechtenstein, s_u $s_u: of 67 random scales those that show something else" "$(answer "SELECT
			unlike('country', 'buildings', $s_u, array_agg(25000 * exp(8 * (hashint8extended(i, 7) & 1048575) / 1048576.0)::float8),
			false) FROM generate_series(1, 67) AS i")" 0
		check "... with members, at three scales" "$(answer "SELECT unlike('country', 'buildings', $s_u,
			ARRAY[31000, 90000, 400000], true)")" 0
		sql -c 'DROP TABLE country, country_groups'
	done
else
	echo "skipped: no $file (TYPIFY_DATA)"
fi
exit $FAILED

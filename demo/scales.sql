-- scales.sql: typifies the buildings at every scale, ungrouped and, where there are blocks, block by block

DO $$
DECLARE
	at_scale double precision;
	began timestamptz;
BEGIN
	FOR at_scale IN SELECT scale FROM demo.scale ORDER BY scale LOOP
		began := clock_timestamp();
		INSERT INTO demo.result (scale, grouped_by, geom)
		SELECT at_scale, '', typify(geom, at_scale, 0.5) FROM buildings;
		UPDATE demo.result SET milliseconds = 1000 * extract(epoch FROM clock_timestamp() - began)
		WHERE milliseconds IS NULL;
		began := clock_timestamp();
		INSERT INTO demo.result (scale, grouped_by, geom)
		SELECT at_scale, 'block', ST_Collect(placeholder.geom)
		FROM (SELECT typify(geom, at_scale, 0.5) AS placeholders
			  FROM buildings WHERE block IS NOT NULL GROUP BY block) AS blocks,
			ST_Dump(placeholders) AS placeholder
		HAVING count(*) > 0;
		UPDATE demo.result SET milliseconds = 1000 * extract(epoch FROM clock_timestamp() - began)
		WHERE milliseconds IS NULL;
	END LOOP;
	UPDATE demo.result SET placeholders = ST_NumGeometries(geom), area = ST_Area(geom);
END $$;

\pset footer off
\pset title 'Buildings and their placeholders (s_u 0.5); black: the placeholders\' area against the buildings\''
SELECT '1:' || typify_svg_number(scale) AS scale, grouped_by AS "group by", n AS buildings, placeholders,
	round(milliseconds) AS "time, ms", to_char(100 * area / own, 'FM9990') || ' %' AS black
FROM demo.result, (SELECT count(*) AS n, sum(ST_Area(geom)) AS own FROM buildings) AS source
ORDER BY grouped_by, result.scale;

-- pictures.sql: before and after at every scale, all scales on a sheet, and the paper's Figure 7

\pset format unaligned
\pset tuples_only on

CREATE FUNCTION demo.before_after(at_scale double precision) RETURNS text LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT typify_svg(demo.buildings(frame), geom, scale, demo.roads(scale, frame),
		upper(left(name, 1)) || substr(name, 2), frame => frame, attribution => attribution)
	FROM demo.result JOIN demo.frame USING (scale), demo.subject
	WHERE scale = at_scale AND grouped_by = '';
END;

\set file :out '/scale-50000.svg'
SELECT demo.before_after(50000) \g :file
\set file :out '/scale-75000.svg'
SELECT demo.before_after(75000) \g :file
\set file :out '/scale-100000.svg'
SELECT demo.before_after(100000) \g :file
\set file :out '/scale-200000.svg'
SELECT demo.before_after(200000) \g :file
INSERT INTO demo.picture (name, caption)
SELECT 'scale-' || scale, 'before and after at true map size, 1:' || typify_svg_number(scale)
FROM demo.scale ORDER BY scale;

\set file :out '/sheet-true-size.svg'
SELECT typify_svg_sheet(demo.five(frame), 5, 'True map size', attribution)
FROM demo.subject, demo.frame WHERE scale = 0 \g :file
\set file :out '/sheet-enlarged.svg'
SELECT typify_svg_sheet(demo.five(frame, 50000), 3, 'The same ground at every scale', attribution)
FROM demo.subject, demo.frame WHERE scale = 0 \g :file
INSERT INTO demo.picture (name, caption) VALUES
	('sheet-true-size', 'the buildings and the four scales, each as large as on its map'),
	('sheet-enlarged', 'the same, drawn equally large');

-- Figure 7: as many placeholders each time; s_u = 0 evens them out, s_u = 1 keeps dense places dense
\set file :out '/figure-7-density.svg'
SELECT typify_svg_sheet(ARRAY[
		demo.panel(demo.buildings(frame), NULL, 100000, frame, 'buildings', 50000),
		demo.panel(NULL, (SELECT typify(geom, 100000, 0) FROM buildings), 100000, frame, 's_u = 0', 50000),
		demo.panel(NULL, (SELECT typify(geom, 100000, 1) FROM buildings), 100000, frame, 's_u = 1', 50000)],
	3, 'Density control', attribution)
FROM demo.subject, demo.frame WHERE scale = 0 \g :file
INSERT INTO demo.picture (name, caption) VALUES
	('figure-7-density', 'the same number of placeholders with s_u 0 and 1 (paper, Figure 7)');

# report.awk - makes doc/benchmarks.md of "set <tab> figure <tab> value" lines. Every table takes medians; a table is
# left out where nothing of it was measured. Variables: plan, the file with the plan of the two workers; large, not
# empty where 10 and 30 million were measured. Sets are named "... of N" where they differ in size alone.

BEGIN { FS = "\t" }

# values of a set and figure, in the order they came
{ key = $1 SUBSEP $2; value[key, ++count[key]] = $3 }
$2 == "points" || $2 == "buildings" { if (!(("set", $1) in known)) { known["set", $1]; sets[++set_count] = $1 } }
$2 == "shape to a third" { if (!(("shape", $1) in known)) { known["shape", $1]; shape[++shape_count] = $1 } }
$2 == "instructions order" { counted_set[++counted] = $1 }

# --- values ---

function has(set, figure) { return (set, figure) in count }
function text(set, figure) { return has(set, figure) ? value[set, figure, 1] : "" }

function median(set, figure, key, n, i, j, v, list) {
	if (!has(set, figure)) return 0
	key = set SUBSEP figure
	n = count[key]
	for (i = 1; i <= n; i++) {
		v = value[key, i] + 0
		for (j = i - 1; j > 0 && list[j] > v; j--) list[j + 1] = list[j]
		list[j + 1] = v
	}
	return n % 2 ? list[(n + 1) / 2] : (list[n / 2] + list[n / 2 + 1]) / 2
}
# of the processor's time, which other work on the machine disturbs less, where that is known
function cpu(set, figure) { return median(set, has(set, figure " cpu") ? figure " cpu" : figure) }
function size(set) { return text(set, has(set, "buildings") ? "buildings" : "points") }
function grouped(n) { while (match(n, /[0-9][0-9][0-9][0-9]( |$)/)) n = substr(n, 1, RSTART) " " substr(n, RSTART + 1); return n }
function label(set) { gsub("_", " ", set); return set }

# --- cells: "" where something was not measured ---

function ms(set, figure) { return has(set, figure) ? sprintf("%.0f ms", 1000 * median(set, figure)) : "" }
function ns(set, figure) { return has(set, figure) ? sprintf("%.0f ns", 1e9 * median(set, figure) / size(set)) : "" }
function ratio(a, b) { return a > 0 && b > 0 ? sprintf("%.2f", a / b) : "" }
# of the time that passed, and in brackets of the processor's
function of(set, a, b, passed) {
	passed = ratio(median(set, a), median(set, b))
	return passed == "" ? "" : passed " (" ratio(cpu(set, a), cpu(set, b)) ")"
}
function memory(set, figure) {
	if (!has(set, figure " kB") || !has(set, "count kB")) return ""
	return sprintf("%.0f", 1024 * (median(set, figure " kB") - median(set, "count kB")) / size(set))
}

# --- tables ---

# A table's columns are sets: head(NAMES, "first column"), then row("label", CELLS); names and cells from split().
function head(first, extra, i, line, rule) {
	line = "| " first " |" extra
	rule = "|---|" (extra == "" ? "" : "---|")
	for (i = 1; i <= columns; i++) { line = line " " label(column[i]) " |"; rule = rule "---|" }
	print line "\n" rule
}
function row(name, i, line, any) {
	line = "| " name " |"
	for (i = 1; i <= columns; i++) { line = line " " cell[i] " |"; if (cell[i] != "") any = 1 }
	if (any) print line
}
# the sets that have the figure become the columns
function choose(figure, i) {
	columns = 0
	for (i = 1; i <= set_count; i++)
		if (has(sets[i], figure) && sets[i] !~ / of [0-9]+$/) column[++columns] = sets[i]
	return columns
}
function section(title, words) { print "\n## " title "\n\n" words "\n" }

# --- sections ---

function ours(set) { return median(set, "core order") + median(set, "core collapse to a third") }
function mesh_step(set) { return median(set, "core order") + median(set, "core mesh") }
function full(set) { return median(set, "core order") + median(set, "core collapse to one") }

function reach_cell(figure, set) {
	if (figure == 1) return of(set, "typify", "envelopes")
	if (figure == 2) return of(set, "typify", "delaunay")
	if (figure == 3) return has(set, "GEOS Delaunay") ? ratio(mesh_step(set), median(set, "GEOS Delaunay")) : ""
	if (figure == 4) return ratio(ours(set), mesh_step(set))
	if (figure == 5) return memory(set, "typify")
	if (figure == 6) return has(set, "core collapse to one") ? ratio(full(set), ours(set)) : ""
	if (figure == 7) return of(set, "to_one", "typify")
	if (figure == 8) return of(set, "blocks", "typify")
	return ratio(median(set, "workers"), median(set, "serial"))
}

function reach(name, goal, then_goal, i, f) {
	split("`typify(geom, 75000, 0.5)` / `count(ST_OrientedEnvelope(geom))`@the same / `ST_DelaunayTriangles` of the " \
		"centroids@core: order and mesh / GEOS's Delaunay@core: points to a third / its own order and mesh@peak memory " \
		"above `count(*)`, bytes a building@core: down to one vertex / down to a third@the same in SQL@blocks of 10 / " \
		"one group@two workers / serial, districts of 1000", name, "@")
	split("1.00 0.35 0.15 4.0 150 1.8 1.8 0.8 0.60", goal, " ")
	split("0.60 0.22 0.10 2.5 110 1.4 1.4 0.5 0.55", then_goal, " ")
	section("Ratios", "Of the medians of the time that passed, in brackets of the processor's; less is better. The " \
		"goals are those for towns and real buildings, a million each.")
	head("figure", " goal, then |")
	for (f = 1; f <= 9; f++) {
		for (i = 1; i <= columns; i++) cell[i] = reach_cell(f, column[i])
		row(name[f] " | " goal[f] ", " then_goal[f])
	}
}

# The core's steps are measured on the same centroids without a server; what is left is the making of the result.
function step(part, set, scan, read) {
	scan = cpu(set, "scan")
	read = cpu(set, "measure")
	if (part == 1) return scan
	if (part == 2) return read - scan
	if (part == 3) return cpu(set, "core order")
	if (part == 4) return cpu(set, "core mesh")
	if (part == 5) return cpu(set, "core collapse to a third") - cpu(set, "core mesh")
	if (part == 6) return cpu(set, "typify") - read - ours(set)
	return cpu(set, "typify")
}

function where_the_time_goes(name, i, part) {
	split("scan (read and detoast)@measure@canonical order@mesh@collapse to a third@output@whole statement", name, "@")
	section("Where the time goes", "`typify(geom, 75000, 0.5)`, one group, one process: the processor's time.")
	head("step", "")
	for (part = 1; part <= 7; part++) {
		for (i = 1; i <= columns; i++)
			cell[i] = sprintf("%.0f ms, %.0f %%", 1000 * step(part, column[i]),
				100 * step(part, column[i]) / step(7, column[i]))
		row(name[part])
	}
}

function statement_rows(list, with_memory, name, n, i, k) {
	n = split(list, name, " ")
	for (k = 1; k <= n; k++) {
		for (i = 1; i <= columns; i++) {
			cell[i] = ms(column[i], name[k])
			if (cell[i] != "" && with_memory && name[k] != "count")
				cell[i] = cell[i] ", " memory(column[i], name[k]) " B"
		}
		row(text("query", name[k]))
	}
}

function statements() {
	section("Statements", "Time, and peak memory of the backend above that of `count(*)`, bytes a building. `b` stands " \
		"for the table, `block` and `district` are groups of 10 and of 1000 neighbours (with `work_mem` 512 MB).")
	head("statement", "")
	statement_rows("count scan measure envelopes delaunay typify unmerged to_one placeholders cluster blocks districts", 1)
}

function option_row(name, figure, i) {
	for (i = 1; i <= columns; i++) cell[i] = has(column[i], figure) ? of(column[i], figure, "typify") : ""
	row(name)
}

function options() {
	section("Options", "What each costs on the sets that are like towns.")
	head("statement", "")
	statement_rows("typify s_u_0 s_u_1 counted to_one min_distance black_white median sum square footprint min_area " \
		"keep_area placeholders importance alignment legible barriers barrier_gaps", 1)
	option_row("`min_side` and `min_gap` / plain (goal 2)", "legible")
	option_row("`alignment` / plain", "alignment")
	option_row("`barriers` / plain (goal 4)", "barriers")
	option_row("`barriers` with `min_side` and `min_gap` / plain (goal 4)", "barrier_gaps")
}

function hierarchies(i) {
	section("Any scale", "A hierarchy of all buildings in one group, and look-ups in it. The goal is at most 3.")
	head("statement", "")
	statement_rows("typify hierarchy build_hierarchy write_hierarchy lookups", 1)
	for (i = 1; i <= columns; i++)
		cell[i] = sprintf("%.2f (%.2f)",
			(median(column[i], "build_hierarchy") - median(column[i], "write_hierarchy")) / median(column[i], "typify"),
			(cpu(column[i], "build_hierarchy") - cpu(column[i], "write_hierarchy")) / cpu(column[i], "typify"))
	row("building without writing / `typify(geom, 75000, 0.5)`, in brackets of the processor's time")
	for (i = 1; i <= columns; i++) cell[i] = sprintf("%.2f ms", 1000 * median(column[i], "lookups") / 200)
	row("one look-up")
}

function workers(line) {
	section("Two workers", "Groups are districts, and the table is hash-partitioned by them in 8. Of a group that is " \
		"the whole table, two workers and the leader share the reading; its mesh is one process's.")
	head("statement", "")
	statement_rows("serial workers typify typify_workers", 0)
	if (plan == "") return
	print "\nThe plan, with `enable_partitionwise_aggregate = on`, `max_parallel_workers_per_gather = 2` and\n" \
		"`parallel_leader_participation = off`:\n\n```"
	while ((getline line < plan) > 0) print line
	print "```"
}

# zoom by zoom, as far as there were any tiles of it
function tiles(set, zoom, name) {
	name = "tiles " zoom " "
	if (!has(set, name "n")) return
	printf "| %s | %d | %s | %.1f, %.1f ms | %.1f, %.1f ms | %.1f | %.1f |\n", zoom, text(set, name "n"),
		grouped(text(set, name "buildings")), text(set, name "plain 50"), text(set, name "plain 99"),
		text(set, name "ours 50"), text(set, name "ours 99"), text(set, name "faster"), text(set, name "smaller")
}

function tile_section(i, zoom) {
	section("Vector tiles", "Of a hierarchy of the whole table (s_u 0.5) beside `ST_AsMVT` of the buildings themselves, for " \
		"the same random tiles: 50th and 99th percentile of the time in the server, warm; how many times faster and how many " \
		"times smaller (medians of the ratio, ratio of the bytes). From zoom 13 on both show the buildings.")
	for (i = 1; i <= columns; i++) {
		printf "%s%s, hierarchy built in %.1f s:\n\n", (i > 1 ? "\n" : ""), column[i], median(column[i], "tiles built")
		print "| zoom | tiles | buildings in a tile | buildings | ours | faster | smaller |\n|---|---|---|---|---|---|---|"
		for (zoom = 8; zoom <= 16; zoom++) tiles(column[i], zoom)
		tiles(column[i], "all")
	}
}

function core_alone(name, n, i, k) {
	section("The core alone", "No server; the processor's time, nanoseconds a building. The collapses contain the mesh, the whole contains " \
		"order, collapse to a third and output.")
	head("step", "")
	n = split("core order@core mesh@GEOS Delaunay@core collapse to a third@core collapse to one@core whole", name, "@")
	for (k = 1; k <= n; k++) {
		for (i = 1; i <= columns; i++) cell[i] = ns(column[i], name[k])
		row(name[k])
	}
	for (i = 1; i <= columns; i++) cell[i] = sprintf("%.0f B", median(column[i], "core bytes"))
	row("peak memory of the whole, buildings and result included")
}

function shapes(i, k, n, f) {
	n = split("shape to a third@shape to one, s_u 0@shape to one, s_u 0.5@shape to one, s_u 1", f, "@")
	section("Shapes that are known to hurt", grouped(text("shapes", "n")) " points, the core alone: nanoseconds a building, and " \
		"times the uniform set. Memory as above.")
	print "| set | to a third | to one, s_u 0 | to one, s_u 0.5 | to one, s_u 1 | memory |\n|---|---|---|---|---|---|"
	for (i = 1; i <= shape_count; i++) {
		printf "| %s |", shape[i]
		for (k = 1; k <= n; k++)
			printf " %.0f ns, %.2f |", 1e9 * median(shape[i], f[k]) / text("shapes", "n"),
				median(shape[i], f[k]) / median("uniform", f[k])
		printf " %.0f B |\n", median(shape[i], "shape bytes")
	}
}

function instructions(i, k, n, f, t) {
	n = split("order mesh third one", f, " ")
	section("Instructions", "Counted by callgrind at " grouped(text("instructions", "n")) " points: the same on a busy machine. " \
		"A building's share.")
	print "| set | order | mesh | collapse to a third, with its mesh | collapse to one |\n|---|---|---|---|---|"
	for (i = 1; i <= counted; i++) {
		printf "| %s |", counted_set[i]
		for (k = 1; k <= n; k++) printf " %.0f |", value[counted_set[i], "instructions " f[k], 1] / text("instructions", "n")
		print ""
	}
}

function growth(set, n, k, small) {
	section("Ten million and more", "The processor's time a building, and times that at 100 000. One run, " \
		"three of the 100 000.")
	print "| set | core, 100 000 | core, 10 million | SQL, 100 000 | SQL, 10 million |\n|---|---|---|---|---|"
	n = split("uniform towns", set, " ")
	for (k = 1; k <= n; k++) {
		small = set[k] " of 100000"
		printf "| %s | %.0f ns | %.0f ns, %.2f |", set[k], 1e4 * ours(small), 100 * ours(set[k] " of 10000000"),
			ours(set[k] " of 10000000") / ours(small) / 100
		small = cpu(set[k] "_of_100000", "typify")
		printf " %.0f ns | %.0f ns, %.2f |\n", 1e4 * small, 100 * cpu(set[k] "_of_10000000", "typify"),
			cpu(set[k] "_of_10000000", "typify") / small / 100
	}
	printf "\n30 million buildings in one group, at 1:100 000: %.0f s with their making, %.0f placeholders, at most %.1f GB.\n",
		text("large", "30 million seconds"), text("large", "30 million placeholders"), text("large", "30 million kB") / 1e6
	print "\n20 million buildings that one worker has to hand on:\n\n```"
	for (k = 1; k <= count["large", "refused"]; k++) print value["large", "refused", k]
	print "```"
}

END {
	if (choose("typify") > 0) { reach(); where_the_time_goes(); statements() }
	if (choose("s_u_0") > 0) options()
	if (choose("build_hierarchy") > 0) hierarchies()
	if (choose("workers") > 0) workers()
	if (choose("tiles built") > 0) tile_section()
	if (choose("core order") > 0) core_alone()
	if (shape_count > 0) shapes()
	if (counted > 0) instructions()
	if (large != "") growth()
}

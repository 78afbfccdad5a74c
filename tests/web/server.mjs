// server.mjs - serves the map page and the vector tiles of a database's tile functions. The database is that of the PG*
// variables; PORT chooses the port (default: any that is free). Prints the address when it answers.
//
// The table web_maps says what there is: s_u, tiles (the tile function), hierarchy, buildings.
//
//   /                             the page
//   /about.json                   which density controls there are, where the buildings are, from which zoom on outlines
//   /tiles/S_U/Z/X/Y?finer=0.5    a vector tile
//   /members/S_U/ID?zoom=&lng=&lat=   the outlines of the members of a placeholder, GeoJSON
//   /roads.json                   lines below the buildings, GeoJSON
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname } from 'node:path';
import pg from 'pg';

const pool = new pg.Pool({ max: 4 });
const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css' };
const files = {
	'/': 'page/index.html',
	'/map.mjs': 'page/map.mjs',
	'/map.css': 'page/map.css',
	'/maplibre-gl.js': 'node_modules/maplibre-gl/dist/maplibre-gl.js',
	'/maplibre-gl.css': 'node_modules/maplibre-gl/dist/maplibre-gl.css',
};

// Whatever the page does, the browser refuses to ask another host.
const policy = "default-src 'self'; worker-src blob:; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'";

async function rows(text, values) {
	return (await pool.query(text, values)).rows;
}

class NotFound extends Error {}

async function chosen(s_u) {
	const [found] = await rows('SELECT tiles, hierarchy, buildings FROM web_maps WHERE s_u = $1', [Number(s_u)]);
	if (!found) throw new NotFound(`there is no hierarchy of s_u ${s_u}`);
	return found;
}

async function tile(s_u, z, x, y, query) {
	const { tiles } = await chosen(s_u);
	const [row] = await rows(`SELECT ${tiles}($1, $2, $3, $4) AS tile`, [z, x, y, JSON.stringify(query)]);
	return row.tile;
}

async function members(s_u, id, query) {
	const { hierarchy, buildings } = await chosen(s_u);
	const [row] = await rows(
		'SELECT web_members($1::regclass, $2::regclass, $3, $4, $5, $6) AS members',
		[hierarchy, buildings, id, query.zoom, query.lng, query.lat],
	);
	return row.members;
}

const about = async () => (await rows('SELECT web_about() AS about'))[0].about;
const roads = async () => (await rows('SELECT web_roads() AS roads'))[0].roads;

const routes = [
	[/^\/about\.json$/, 'application/json', async () => JSON.stringify(await about())],
	[/^\/roads\.json$/, 'application/json', async () => JSON.stringify(await roads())],
	[/^\/tiles\/([\d.]+)\/(\d+)\/(\d+)\/(\d+)$/, 'application/vnd.mapbox-vector-tile', tile],
	[/^\/members\/([\d.]+)\/(-?\d+)$/, 'application/json', async (...all) => JSON.stringify(await members(...all))],
];

async function answer(url) {
	if (files[url.pathname]) {
		const name = files[url.pathname];
		return [types[extname(name)], await readFile(new URL(name, import.meta.url))];
	}
	for (const [pattern, type, make] of routes) {
		const match = pattern.exec(url.pathname);
		if (match) return [type, await make(...match.slice(1), Object.fromEntries(url.searchParams))];
	}
	throw new NotFound(`there is no ${url.pathname}`);
}

const server = createServer(async (request, response) => {
	response.setHeader('Content-Security-Policy', policy);
	response.setHeader('Cache-Control', 'no-store');
	try {
		const [type, body] = await answer(new URL(request.url, 'http://localhost'));
		response.writeHead(body.length ? 200 : 204, { 'Content-Type': type });
		response.end(body);
	} catch (error) {
		// 22...: a value that the database refuses is the asker's
		const status = error instanceof NotFound ? 404 : String(error.code).startsWith('22') ? 400 : 500;
		response.writeHead(status, { 'Content-Type': 'text/plain; charset=utf-8' });
		response.end(`${error.message}\n`);
	}
});
server.listen(Number(process.env.PORT ?? 0), '127.0.0.1', () => console.log(`http://localhost:${server.address().port}/`));

function stop() {
	server.closeAllConnections();
	server.close(() => pool.end().then(() => process.exit(0)));
}
process.on('SIGINT', stop);
process.on('SIGTERM', stop);

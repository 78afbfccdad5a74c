// map.mjs - the map. Two sources of the same tiles: as of the zoom, and as of half a zoom further in. Each is shown for
// its half of a zoom, so that counts and sizes change in steps of the square root of 2 in scale, half as wide as tiles
// by themselves would give.
const ink = { paper: '#f5f2ea', building: '#4b453e', street: '#ffffff', edge: '#d9d2c3', track: '#d3cbb9', mark: '#b4442a' };
const pixel = 0.00028; // metres on the screen, as OGC takes them
const tileSize = 512;
const empty = { type: 'FeatureCollection', features: [] };
const element = (id) => document.getElementById(id);
const about = await (await fetch('about.json')).json();
let s_u = about.s_u[Math.floor(about.s_u.length / 2)];

const address = (finer) => `${location.origin}/tiles/${s_u}/{z}/{x}/{y}?finer=${finer}`;
const source = (finer) => ({
	type: 'vector', tiles: [address(finer)], minzoom: 0, maxzoom: about.outlines + 2, bounds: about.bounds,
});

// 1 in the half zooms that a source is for, 0 in the others; from the zoom of outlines on the first source alone
function turns(first, second) {
	const stops = [];
	for (let zoom = 0; zoom < about.outlines; zoom++) {
		stops.push(zoom, first, zoom + 0.499, first, zoom + 0.5, second, zoom + 0.999, second);
	}
	return ['interpolate', ['linear'], ['zoom'], ...stops, about.outlines, first];
}
const buildings = (id, first, second) => ({
	id, source: id, 'source-layer': about.layer, type: 'fill',
	paint: { 'fill-color': ink.building, 'fill-opacity': turns(first, second), 'fill-opacity-transition': { duration: 0 } },
});
// widths in pixels by zoom; a street is a light line with an edge, at small scales its edge alone
const width = (...stops) => ['interpolate', ['exponential', 1.6], ['zoom'], ...stops];
const roads = (id, classes, color, ...stops) => ({
	id, source: 'roads', type: 'line', filter: ['in', ['get', 'class'], ['literal', classes]],
	layout: { 'line-cap': 'round', 'line-join': 'round' }, paint: { 'line-color': color, 'line-width': width(...stops) },
});

const map = new maplibregl.Map({
	container: 'map',
	style: {
		version: 8,
		sources: {
			whole: source(0), half: source(0.5),
			roads: { type: 'geojson', data: 'roads.json' },
			members: { type: 'geojson', data: empty },
		},
		layers: [
			{ id: 'paper', type: 'background', paint: { 'background-color': ink.paper } },
			{ ...roads('tracks', ['track'], ink.track, 11, 0.4, 14, 1, 18, 3), minzoom: 11.5 },
			roads('street edges', ['residential', 'service', 'other'], ink.edge, 9, 0.3, 12, 1, 15, 7, 18, 40),
			roads('main edges', ['main'], ink.edge, 7, 0.7, 10, 1.4, 12, 2.6, 15, 10, 18, 56),
			{ ...roads('streets', ['residential', 'service', 'other'], ink.street, 12, 0.5, 15, 5.4, 18, 36), minzoom: 12 },
			{ ...roads('mains', ['main'], ink.street, 10, 0.6, 12, 1.6, 15, 8, 18, 50), minzoom: 10 },
			buildings('whole', 1, 0), buildings('half', 0, 1),
			{
				id: 'member fills', source: 'members', type: 'fill',
				paint: { 'fill-color': ink.mark, 'fill-opacity': 0.35 },
			},
			{
				id: 'members', source: 'members', type: 'line',
				paint: { 'line-color': ink.mark, 'line-width': ['interpolate', ['linear'], ['zoom'], 10, 0.8, 16, 1.6] },
			},
		],
	},
	bounds: about.bounds, fitBoundsOptions: { padding: 40 }, hash: true, minZoom: 6, maxZoom: 18.9,
	dragRotate: false, pitchWithRotate: false, attributionControl: false, fadeDuration: 0,
});
map.touchZoomRotate.disableRotation();
map.keyboard.disableRotation();
map.addControl(new maplibregl.NavigationControl({ showCompass: false }), 'top-right');
map.addControl(new maplibregl.ScaleControl({ maxWidth: 140 }), 'bottom-left');

const finer = () => (map.getZoom() < about.outlines && map.getZoom() % 1 >= 0.5 ? 0.5 : 0);
const visible = () => (finer() ? 'half' : 'whole');

// --- what is shown ---

const grouped = (number) => String(Math.round(number)).replace(/\B(?=(\d{3})+$)/g, '\u2009');
function denominator() {
	const metres = (2 * Math.PI * 6378137 * Math.cos((map.getCenter().lat * Math.PI) / 180)) / tileSize / 2 ** map.getZoom();
	return metres / pixel;
}
// every placeholder once, though several tiles show it
function shown() {
	return new Map(map.queryRenderedFeatures({ layers: [visible()] }).map((feature) => [feature.id, feature]));
}
function tell() {
	const features = [...shown().values()];
	const members = features.reduce((sum, feature) => sum + feature.properties.member_count, 0);
	const exact = denominator();
	element('scale').value = `1 : ${grouped(Number(exact.toPrecision(exact < 1e4 ? 2 : 3)))}`;
	element('shown').value = members === features.length
		? `${grouped(members)} buildings`
		: `${grouped(features.length)} placeholders for ${grouped(members)} buildings`;
}
map.on('idle', tell);
map.on('zoom', tell);

// --- density control ---

const slider = element('s_u');
slider.max = about.s_u.length - 1;
slider.value = about.s_u.indexOf(s_u);
function choose() {
	s_u = about.s_u[slider.value];
	element('s_u_value').value = s_u;
	forget();
	for (const [id, part] of [['whole', 0], ['half', 0.5]]) map.getSource(id)?.setTiles([address(part)]);
}
element('s_u_value').value = s_u;
slider.addEventListener('input', choose);

// --- members ---

let pointed = null;
function forget() {
	pointed = null;
	map.getSource('members')?.setData(empty);
	element('members').value = '';
	map.getCanvas().style.cursor = '';
}
async function point(event) {
	const [feature] = map.queryRenderedFeatures(event.point, { layers: [visible()] });
	if (!feature || feature.properties.member_count === 1) return forget();
	if (pointed === feature.id) return;
	pointed = feature.id;
	const zoom = Math.floor(map.getZoom()) + finer();
	const place = `zoom=${zoom}&lng=${event.lngLat.lng}&lat=${event.lngLat.lat}`;
	const answer = await fetch(`members/${s_u}/${feature.id}?${place}`);
	if (pointed !== feature.id) return;
	map.getSource('members').setData(answer.ok ? await answer.json() : empty);
	element('members').value = `${feature.properties.member_count} members`;
	map.getCanvas().style.cursor = 'pointer';
}
map.on('mousemove', point);
map.on('mouseout', forget);
map.on('zoomstart', forget);

// for the test
window.typify = { map, shown, visible, middle: map.getCenter() };

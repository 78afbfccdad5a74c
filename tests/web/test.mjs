// test.mjs URL FOLDER - the fear: the map is empty, black, jumps, complains, or asks a stranger. Opens the page in a
// headless Chromium (CHROMIUM, by default Debian's), counts features, moves the slider, points at a placeholder, and
// leaves a screenshot of each zoom in the folder. Exit status 1 when something is not as it should be.
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from 'playwright-core';

const [url, folder] = process.argv.slice(2);
const zooms = [9, 10, 11, 12, 13, 14, 15, 16];
const profile = await mkdtemp(join(tmpdir(), 'chromium-'));
let failed = 0;
function check(what, found, holds) {
	console.log(`${holds ? 'ok' : 'failed'}: ${what}: ${found}`);
	if (!holds) failed++;
}

const context = await chromium.launchPersistentContext(profile, {
	executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
	viewport: { width: 1100, height: 760 },
	args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
		'--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run', '--disable-quic'],
});
const complaints = [];
const strangers = new Set();
const page = await context.newPage();
page.setDefaultTimeout(40000);
page.on('console', (message) => {
	if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
});
page.on('pageerror', (error) => complaints.push(error.message));
page.on('requestfailed', (request) => {
	if (request.failure().errorText !== 'net::ERR_ABORTED') complaints.push(`${request.url()} ${request.failure().errorText}`);
});
page.on('response', (response) => {
	if (response.status() >= 400) complaints.push(`${response.url()} ${response.status()}`);
});
context.on('request', (request) => {
	const other = new URL(request.url());
	if (!['data:', 'blob:'].includes(other.protocol) && other.host !== new URL(url).host) strangers.add(other.host);
});

const settled = () => page.waitForFunction(() => window.typify?.map.loaded() && window.typify.map.areTilesLoaded());
// moves there, waits until nothing is missing, and tells how many of what is shown
async function look(zoom) {
	await page.evaluate((to) => new Promise((resolve) => {
		typify.map.once('idle', resolve);
		typify.map.jumpTo({ zoom: to, center: typify.middle });
		typify.map.triggerRepaint();
	}), zoom);
	await settled();
	return page.evaluate(() => {
		const features = [...typify.shown().values()];
		return { features: features.length, members: features.reduce((sum, f) => sum + f.properties.member_count, 0) };
	});
}
// the share of dark pixels where the town is, 600 pixels around the middle or less
async function ink() {
	const picture = (await page.screenshot({ clip: { x: 250, y: 80, width: 600, height: 600 } })).toString('base64');
	return page.evaluate(async (data) => {
		const image = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (byte) => byte.charCodeAt(0))]));
		const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
		context.drawImage(image, 0, 0);
		const pixels = context.getImageData(0, 0, image.width, image.height).data;
		let dark = 0;
		for (let i = 0; i < pixels.length; i += 4) if (pixels[i] < 128) dark++;
		return dark / (pixels.length / 4);
	}, picture);
}

try {
	await page.goto(url);
	await settled();
	const whole = await look(11);
	const seen = {};
	for (const zoom of zooms) {
		seen[zoom] = { ...(await look(zoom)), ink: await ink() };
		await page.screenshot({ path: join(folder, `zoom-${zoom}.png`) });
		console.log(`zoom ${zoom}: ${seen[zoom].features} features for ${seen[zoom].members} buildings, ` +
			`${(100 * seen[zoom].ink).toFixed(2)} % ink`);
	}
	check('zoom 11: placeholders that stand for more than themselves', seen[11].features,
		seen[11].features > 20 && seen[11].members > 3 * seen[11].features);
	check('zoom 13: every building by itself', seen[13].features,
		seen[13].features > 100 && seen[13].members === seen[13].features);
	check('zoom 15: single houses', seen[15].features, seen[15].features > 50 && seen[15].features < seen[13].features);
	for (const zoom of zooms.slice(1)) {
		const [before, now] = [seen[zoom - 1], seen[zoom]];
		// as many as the ground that left the window and the law together explain
		check(`from zoom ${zoom - 1} to ${zoom} no jump`, `${before.features} to ${now.features}`,
			now.features > before.features / 5 && now.features < 5 * before.features);
		check(`zoom ${zoom} is not black`, now.ink.toFixed(4), now.ink > 0.0002 && now.ink < 0.35);
	}

	await look(11);
	const half = await look(11.6);
	check('half a zoom further in: more than at zoom 11, fewer than at 12', half.features,
		half.features > seen[11].features / 2 && half.members > 0 && (await page.evaluate(() => typify.visible())) === 'half');

	await look(11);
	const counts = [];
	for (const value of ['0', '2', '4']) {
		await page.locator('#s_u').fill(value);
		await page.waitForTimeout(300);
		counts.push(await look(11));
	}
	check('every density control shows as many', counts.map((one) => one.features).join(', '),
		counts.every((one) => Math.abs(one.features - counts[0].features) < 0.2 * counts[0].features + 5));
	await page.locator('#s_u').fill('2');
	await page.waitForTimeout(300);
	check('back to where it was', (await look(11)).features, (await look(11)).features === whole.features);

	await page.setViewportSize({ width: 760, height: 520 });
	await look(12.7);
	const target = await page.evaluate(() => {
		const feature = typify.map.queryRenderedFeatures({ layers: [typify.visible()] })
			.filter((one) => one.properties.member_count > 2)
			.map((one) => ({ count: one.properties.member_count, ring: one.geometry.coordinates[0] }))
			.map(({ count, ring }) => ({ count, at: typify.map.project([(ring[0][0] + ring[2][0]) / 2, (ring[0][1] + ring[2][1]) / 2]) }))
			.find(({ at }) => at.x > 320 && at.x < 700 && at.y > 160 && at.y < 500);
		return feature;
	});
	await page.mouse.move(target.at.x + 1, target.at.y);
	await page.mouse.move(target.at.x, target.at.y);
	await page.waitForFunction(() => document.getElementById('members').value !== '');
	await page.waitForFunction(() => typify.map.querySourceFeatures('members').length > 0);
	const outlines = await page.evaluate(async () => (await typify.map.getSource('members').getData()).features.length);
	const told = await page.evaluate(() => Number(document.getElementById('members').value.split(' ')[0]));
	check('members of a placeholder that is pointed at', `${outlines} outlines, ${told} told`, outlines === told && told > 2);
	await page.waitForTimeout(300);
	await page.screenshot({ path: join(folder, 'members.png') });

	check('hosts asked besides our own', [...strangers].join(' ') || 'none', strangers.size === 0);
	check('words in the console', complaints.join('; ') || 'none', complaints.length === 0);
} finally {
	await context.close();
	await rm(profile, { recursive: true, force: true });
}
process.exit(failed ? 1 : 0);

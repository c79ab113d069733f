// SPDX-License-Identifier: Apache-2.0
// Opens pages in headless Chromium, for the tests beside it. Environment:
//   STURZ_PAGES     folder with the pages that write_pages makes
//   STURZ_MODULES   folder whose node_modules holds playwright-core
//   STURZ_CHROMIUM  the browser; the tests are skipped with a message when it is missing
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {after, before} from 'node:test';
import {pathToFileURL} from 'node:url';

export const pages = process.env.STURZ_PAGES;
const modules = process.env.STURZ_MODULES ?? '';
const executablePath = process.env.STURZ_CHROMIUM ?? '/usr/bin/chromium';

function missing() {
  if (!existsSync(executablePath)) return `no browser at ${executablePath}`;
  if (!existsSync(join(modules, 'node_modules/playwright-core')))
    return 'playwright-core is not installed in the build folder';
  return false;
}
export const skip = missing();
if (skip) console.log(`skipped: ${skip}`);

let browser;
before(async () => {
  if (skip) return;
  const {chromium} = createRequire(join(modules, 'package.json'))('playwright-core');
  browser = await chromium.launch({
    executablePath,
    args: ['--no-sandbox', '--disable-quic', '--no-first-run',
           '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });
});
after(async () => browser?.close());

/** Opens a page and collects everything that must not happen on it. */
export async function open(name, options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 900}, ...options});
  const page = await context.newPage();
  const trouble = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) trouble.push(message.text());
  });
  page.on('pageerror', (error) => trouble.push(error.message));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) trouble.push(`request: ${request.url()}`);
  });
  await page.goto(pathToFileURL(join(pages, `${name}.html`)).href);
  return {page, trouble, close: () => context.close()};
}

/** Two frames of the browser, however slow the machine is. */
const twoFrames = (page) => page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** What an element looks like once it stays as it is, as one text. */
export async function steady(page, shot) {
  let before = '';
  for (let k = 0; k < 40; k++) {
    await page.waitForTimeout(250);
    await twoFrames(page);
    const now = (await shot()).toString('base64');
    if (now === before) return now;
    before = now;
  }
  throw new Error('the picture does not come to rest');
}

/** What the map looks like right now, as one text. */
export async function picture(page) {
  await page.mouse.move(2, 2);
  return steady(page, () => page.locator('#map').screenshot());
}

export async function liveMap(page) {
  await page.waitForSelector('.live-maps #map canvas', {timeout: 60000});
  await page.waitForTimeout(400);
}

/** Clicks the map at fractions of its width and height. */
export async function clickMap(page, fx, fy) {
  await page.locator('#map').scrollIntoViewIfNeeded();
  const box = await page.locator('#map').boundingBox();
  await page.mouse.move(box.x + fx * box.width, box.y + fy * box.height);
  await page.mouse.click(box.x + fx * box.width, box.y + fy * box.height);
  await page.waitForTimeout(500);
}

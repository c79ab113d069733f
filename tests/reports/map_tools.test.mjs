// SPDX-License-Identifier: Apache-2.0
// Tools of the map in headless Chromium, see browser.mjs: what they give equals the maps that
// write_pages left beside its pages.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {clickMap, liveMap, open, pages, picture, skip, steady} from './browser.mjs';

const truth = skip ? null : JSON.parse(readFileSync(join(pages, 'ensemble_layers.json'), 'utf8'));

/** What the maps hold at a place; NaN outside. */
function valueAt(layer, x, y) {
  const {west, north, cell, cols, rows} = truth.grid;
  const col = Math.floor((x - west) / cell);
  const row = Math.floor((north - y) / cell);
  if (col < 0 || row < 0 || col >= cols || row >= rows) return NaN;
  return truth[layer][row * cols + col] ?? NaN;
}

async function csvOf(page, button) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
  const lines = readFileSync(await download.path(), 'utf8').trim().split('\n');
  return {head: lines[0].split(','), rows: lines.slice(1).map((line) => line.split(',').map(Number))};
}

/** Within a thousandth of the largest value, which is how maps are rounded; shares are exact. */
function sameValue(layer, got, x, y) {
  const wanted = valueAt(layer, x, y);
  const largest = truth[layer].reduce((m, v) => v > m ? v : m, 0);
  const off = layer === 'probability_of_reach' ? 1e-6 : 1e-3 * largest;
  assert.ok(Math.abs(got - wanted) <= off, `${layer} at ${x}, ${y}: ${got}, not ${wanted}`);
}

async function profile(page) {
  await page.locator('#map').scrollIntoViewIfNeeded();
  const box = await page.locator('#map').boundingBox();
  const at = (fx, fy) => [box.x + fx * box.width, box.y + fy * box.height];
  await page.mouse.click(...at(0.32, 0.45));
  await page.waitForTimeout(350);
  await page.mouse.move(...at(0.6, 0.55));
  await page.mouse.dblclick(...at(0.68, 0.5));
  await page.waitForTimeout(500);
}

test('cell values in the CSV equal the maps', {skip}, async () => {
  const {page, trouble, close} = await open('ensemble', {acceptDownloads: true});
  await liveMap(page);
  const reached = await csvOf(page, '#save-csv');
  assert.deepEqual(reached.head, ['x_m', 'y_m', 'probability_of_reach']);
  assert.equal(reached.rows.length, truth.probability_of_reach.filter((v) => v > 0).length);
  for (const [x, y, v] of reached.rows) sameValue('probability_of_reach', v, x, y);
  await page.click('[data-key="thickness"]');
  await page.click('[data-key="quantile"]');
  await page.waitForTimeout(300);
  const thickness = await csvOf(page, '#save-csv');
  for (const [x, y, v] of thickness.rows) sameValue('median_thickness', v, x, y);
  assert.ok(thickness.rows.length > 100);
  assert.equal(thickness.head[2], 'thickness_quantile_0.5_m', 'it says which of the quantiles');
  assert.deepEqual(trouble, []);
  await close();
});

test('the profile along a drawn line equals the raster', {skip}, async () => {
  const {page, trouble, close} = await open('ensemble', {acceptDownloads: true});
  await liveMap(page);
  await page.click('#tool-profile');
  assert.match(await page.textContent('#profile'), /Draw a line/);
  await profile(page);
  assert.ok(await page.locator('.profile-chart canvas').count() > 0);
  const drawn = await csvOf(page, '#profile-csv');
  assert.deepEqual(drawn.head, ['distance_m', 'x_m', 'y_m', 'ground_m', 'probability_of_reach']);
  let hits = 0;
  for (const [, x, y, , v] of drawn.rows) {
    const wanted = valueAt('probability_of_reach', x, y);
    if (!Number.isNaN(wanted)) sameValue('probability_of_reach', v, x, y);
    hits += v > 0;
  }
  assert.ok(hits > 10, `${hits} points of the line are reached`);
  assert.ok(drawn.rows.every(([s], i) => i === 0 || s > drawn.rows[i - 1][0]), 'distances rise');
  await page.click('[data-key="upper"]');
  assert.match(await page.textContent('.profile-head b'), /upper end/);
  const upper = await csvOf(page, '#profile-csv');
  assert.equal(upper.head[4], 'probability_of_reach_upper', 'an end of the interval is called one');
  assert.ok(upper.rows.some(([, , , , v], i) => v > drawn.rows[i][4]));
  await page.click('[data-key="arrival"]');
  await page.waitForTimeout(300);
  assert.equal((await csvOf(page, '#profile-csv')).head[4], 'arrival_quantile_0.5_s', 'times have none');
  await page.click('[data-key="reached"]');
  await page.click('[data-key="value"]');
  await page.click('#tool-profile');
  assert.ok(!await page.locator('#profile').isVisible());
  assert.deepEqual(trouble, []);
  await close();
});

test('swipe shows another plane to the right of its handle only', {skip}, async () => {
  const {page, trouble, close} = await open('ensemble');
  await liveMap(page);
  const clip = async (left) => {
    const box = await page.locator('#map').boundingBox();
    await page.mouse.move(2, 2);
    return steady(page, () => page.screenshot({
      clip: {x: box.x + (left ? 0.3 : 0.55) * box.width, y: box.y + 60,
             width: 0.15 * box.width, height: box.height - 120},
    }));
  };
  const [left, right] = [await clip(true), await clip(false)];
  await page.click('#tool-swipe');
  await page.selectOption('#pick-beside', {label: 'Arrival time, median'});
  assert.equal(await clip(true), left, 'left of the handle nothing changes');
  assert.notEqual(await clip(false), right);
  assert.match(await page.textContent('.beside-legend'), /Arrival time \[s\]/);
  await page.locator('.swipe').focus();
  for (let k = 0; k < 30; k++) await page.keyboard.press('ArrowLeft');
  assert.notEqual(await clip(true), left, 'the keyboard moves the handle');
  await page.click('#tool-swipe');
  assert.equal(await clip(true), left);
  assert.equal(await clip(false), right);
  assert.deepEqual(trouble, []);
  await close();
});

test('two ensembles lie beside each other from the start', {skip}, async () => {
  const {page, trouble, close} = await open('comparison');
  await liveMap(page);
  assert.ok(await page.locator('.swipe').isVisible());
  assert.equal(await page.getAttribute('.side-b', 'title'), 'out/with a <dam>');
  assert.ok(!await page.locator('.beside-legend').isVisible(), 'the same classes are told once');
  assert.match(await page.textContent('.plain-words'), /From A \(out\/as it is\) to B .* by −50 to 0 percentage points: it is less on 25\sha/);
  const chosen = () => page.evaluate(() => {
    const option = document.querySelector('#pick-beside').selectedOptions[0];
    return `${option.parentNode.label}: ${option.text}`;
  });
  assert.match(await chosen(), /^B: out.*Probability that the flow arrives$/);
  const right = async () => {
    const box = await page.locator('#map').boundingBox();
    await page.mouse.move(2, 2);
    return steady(page, () => page.screenshot({
      clip: {x: box.x + 0.55 * box.width, y: box.y + 60, width: 0.15 * box.width, height: box.height - 120},
    }));
  };
  const ofB = await right();
  await page.selectOption('#pick-beside', {index: await page.evaluate(
      () => [...document.querySelector('#pick-beside').options].findIndex(
          (o) => o.parentNode.label.startsWith('A') && o.text === 'Probability that the flow arrives'))});
  assert.notEqual(await right(), ofB, 'B differs from A');
  await page.click('[data-key="thickness"]');
  await page.waitForTimeout(300);
  assert.match(await chosen(), /^B: .*thickness/i, 'B follows what A shows');
  assert.ok(await page.locator('[data-key="difference"]').count() === 0);
  await page.click('[data-key="reached"]');
  assert.equal(await page.textContent('.map-title'), 'A: Probability that the flow arrives');
  // The same end of the interval on both sides.
  await page.click('[data-key="lower"]');
  await page.waitForTimeout(300);
  assert.notEqual(await right(), ofB, 'lower ends of B');
  await page.click('[data-key="value"]');
  await page.waitForTimeout(300);
  assert.equal(await right(), ofB);
  // Differences below 0 are painted, and have no interval of a share.
  await page.click('#tool-swipe');
  await page.click('[data-key="difference"]');
  await page.waitForTimeout(300);
  assert.equal(await page.locator('[data-key="lower"]').count(), 0);
  const less = await right();
  await page.locator('#pick-opacity').fill('0');
  await page.waitForTimeout(300);
  assert.notEqual(await right(), less, 'less is seen');
  assert.deepEqual(trouble, []);
  await close();
});

test('the saved picture holds map and legend', {skip}, async () => {
  const {page, trouble, close} = await open('ensemble', {acceptDownloads: true});
  await liveMap(page);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-png')]);
  assert.equal(download.suggestedFilename(), 'probability_of_reach.png');
  const png = readFileSync(await download.path()).toString('base64');
  const colours = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement('canvas');
    canvas.width = image.width;
    canvas.height = image.height;
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const seen = {left: new Set(), right: new Set()};
    const {data: pixels} = context.getImageData(0, 0, image.width, image.height);
    for (let i = 0; i < pixels.length; i += 4) {
      const x = (i / 4) % image.width;
      seen[x < image.width * 0.7 ? 'left' : 'right'].add(
          (pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2]);
    }
    const legend = [...document.querySelectorAll('.legend-box .swatch')].map(
        (s) => s.style.background).filter(Boolean).map((c) => c.match(/\d+/g).map(Number))
        .map(([r, g, b]) => (r << 16) | (g << 8) | b);
    return {map: seen.left.size, legend: legend.filter((c) => seen.right.has(c)).length,
            all: legend.length};
  }, png);
  assert.ok(colours.map > 500, `${colours.map} colours on the map`);
  assert.equal(colours.legend, colours.all);
  assert.deepEqual(trouble, []);
  await close();
});

test('overlays are named, switched, and give lines for a profile', {skip}, async () => {
  const {page, trouble, close} = await open('overlays', {acceptDownloads: true});
  await liveMap(page);
  assert.match(await page.textContent('.switches'), /Houses <new>.*Roads.*Orthophoto/s);
  const all = await picture(page);
  for (const id of ['#pick-overlay-0', '#pick-overlay-1']) {
    await page.uncheck(id);
    assert.notEqual(await picture(page), all, id);
    await page.check(id);
  }
  assert.equal(await picture(page), all);
  await page.check('#pick-photo');
  assert.notEqual(await picture(page), all);
  await page.click('#tool-profile');
  await page.selectOption('#pick-line', '0');
  await page.waitForTimeout(300);
  const given = await csvOf(page, '#profile-csv');
  const [, x0, y0] = given.rows[0];
  assert.deepEqual([x0, y0], truth.road[0]);
  assert.deepEqual(trouble, []);
  await close();
});

test('the keyboard moves the map and reads the cell in its middle', {skip}, async () => {
  const {page, trouble, close} = await open('ensemble');
  await liveMap(page);
  await page.locator('#map').focus();
  const before = await picture(page);
  for (let k = 0; k < 3; k++) await page.keyboard.press('ArrowRight');
  await page.waitForTimeout(500);
  assert.notEqual(await picture(page), before);
  await page.locator('#map').focus();
  await page.keyboard.press('Enter');
  assert.match(await page.textContent('.cell-box'), /At this cell x 41\d{4}/);
  assert.deepEqual(trouble, []);
  await close();
});

test('the 3-D view turns, follows the layer, and plays a member to its deposit', {skip}, async () => {
  const {page, trouble, close} = await open('frames');
  await liveMap(page);
  await page.click('#tool-3d');
  await page.waitForSelector('#view3d canvas', {timeout: 30000});
  await page.waitForSelector('#frame');
  // The drawing alone: buttons above it change with the focus.
  const shot = () => steady(page, async () => Buffer.from(await page.evaluate(
      () => document.querySelector('#view3d canvas').toDataURL())));
  const start = await shot();
  await page.fill('#frame', '3');
  const later = await shot();
  assert.notEqual(later, start);
  const last = await page.getAttribute('#frame', 'max');
  await page.fill('#frame', last);
  const end = await shot();
  assert.notEqual(end, later);
  assert.ok(!await page.locator('.map-panel').isVisible(), 'the frames have a legend of their own');
  await page.click('#play');  // from the end it begins anew
  await page.waitForFunction((end) => document.getElementById('frame').value !== end, last);
  await page.waitForFunction((end) => document.getElementById('frame').value === end, last);
  assert.equal(await shot(), end);
  const box = await page.locator('#view3d').boundingBox();
  await page.mouse.move(box.x + 500, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 600, box.y + 220, {steps: 4});
  await page.mouse.up();
  assert.notEqual(await shot(), end, 'dragging turns it');
  await page.click('#tool-3d');
  assert.equal(await page.locator('#view3d canvas').count(), 0);
  assert.deepEqual(trouble.filter((line) => !/GPU stall|swiftshader|GL Driver/i.test(line)), []);
  await close();
});

test('the whole screen keeps legend, choices and hover', {skip}, async () => {
  const {page, close} = await open('ensemble');
  await liveMap(page);
  await page.click('.ol-full-screen button');
  await page.waitForTimeout(500);
  await clickMap(page, 0.5, 0.46);
  for (const part of ['.legend-box', '.pickers', '.map-title', '.hover', '.cell-box'])
    assert.ok(await page.locator(part).isVisible(), part);
  const before = await picture(page);
  await page.click('[data-key="energy"]');
  assert.notEqual(await picture(page), before);
  await close();
});

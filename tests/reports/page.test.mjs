// SPDX-License-Identifier: Apache-2.0
// The page's switches, charts and tables in headless Chromium, see browser.mjs.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {clickMap, liveMap, open, picture, skip} from './browser.mjs';

test('every page opens without errors or requests', {skip}, async () => {
  for (const name of ['ensemble', 'single', 'cut', 'phases', 'phases_single', 'empty', 'region']) {
    const {page, trouble, close} = await open(name);
    if (name !== 'empty') await liveMap(page);
    await page.waitForTimeout(300);
    assert.deepEqual(trouble, [], name);
    await close();
  }
});

test('switching quantity and threshold redraws the map', {skip}, async () => {
  const {page, trouble, close} = await open('ensemble');
  await liveMap(page);
  assert.equal(await page.textContent('.map-title'), 'Probability that the flow arrives');
  const reached = await picture(page);
  await page.click('[data-key="energy"]');
  assert.match(await page.textContent('.map-title'), /kinetic energy per area exceeds 10/);
  const low = await picture(page);
  assert.notEqual(low, reached);
  await page.click('[data-key="level-2"]');
  assert.match(await page.textContent('.map-title'), /exceeds 1000/);
  assert.notEqual(await picture(page), low);
  await page.click('[data-key="quantile"]');
  assert.equal(await page.textContent('.map-title'), 'Kinetic energy per area, median');
  assert.deepEqual(trouble, []);
  await close();
});

test('thresholds below half a particle spacing are marked', {skip}, async () => {
  const {page, close} = await open('ensemble');
  await liveMap(page);
  await page.click('[data-key="thickness"]');
  assert.equal(await page.locator('.chips .flag', {hasText: 'not resolved'}).count(), 4);
  await close();
});

test('hover tells the value, a click draws the exceedance curve', {skip}, async () => {
  const {page, trouble, close} = await open('ensemble');
  await liveMap(page);
  await page.click('[data-key="energy"]');
  await clickMap(page, 0.40, 0.46);
  assert.match(await page.textContent('.hover'), /%.*x 41\d{4} y 465\d{4}/);
  assert.match(await page.textContent('.cell-box'), /Reached by \d+ of 31 members/);
  assert.ok(await page.locator('.cell-chart canvas').count() > 0);
  assert.match(await page.textContent('.cell-box'), />\s100\skJ\/m²\d+\s%\d+\s% – \d+\s%/);
  await clickMap(page, 0.04, 0.9);
  assert.match(await page.textContent('.cell-box'), /No valid member came here/);
  assert.deepEqual(trouble, []);
  await close();
});

test('a region tells which sources reach a cell', {skip}, async () => {
  const {page, trouble, close} = await open('region');
  await liveMap(page);
  assert.equal(await page.textContent('.map-title'),
               'Probability that the likeliest source arrives');
  assert.match(await page.textContent('.cell-box'), /which sources reach it/);
  await clickMap(page, 0.40, 0.46);
  assert.match(await page.textContent('.hover'), /north <gully> \d+/);
  assert.match(await page.textContent('.cell-box'), /Reached by 2 sources/);
  assert.match(await page.textContent('.cell-box'), /(north <gully>|south gully)\d+\s%/);
  await clickMap(page, 0.04, 0.9);
  assert.match(await page.textContent('.cell-box'), /No source reaches this cell/);
  await page.click('[data-key="sources"]');
  await page.click('[data-key="value"]');
  assert.match(await page.textContent('.pickers'), /most likely source/);
  assert.match(await page.textContent('#sources'), /nowhere.*beyond the terrain/);
  assert.deepEqual(trouble, []);
  await close();
});

test('opacity and contours change the picture', {skip}, async () => {
  const {page, close} = await open('ensemble');
  await liveMap(page);
  const full = await picture(page);
  assert.equal(await picture(page), full, 'nothing was changed yet');
  await page.uncheck('#pick-contours');
  const bare = await picture(page);
  assert.notEqual(bare, full);
  await page.fill('#pick-opacity', '20');
  assert.notEqual(await picture(page), bare);
  await close();
});

test('what is cut off is said first and drawn as such', {skip}, async () => {
  const {page, trouble, close} = await open('cut');
  await liveMap(page);
  const banner = await page.locator('.banner').boundingBox();
  assert.ok(banner.y + banner.height < 700, 'above the fold');
  assert.match(await page.textContent('.banner'), /of 31 simulations \(\d+ %\) are cut off/);
  assert.match(await page.textContent('#read-runout'), /cut off/);
  assert.match(await page.textContent('#chart-scatter'), /τ = −?\d\.\d+ from \d+ % of the pairs/);
  assert.match(await page.textContent('.card:nth-child(3)'), /≥/);
  assert.deepEqual(trouble, []);
  await close();
});

test('grains, liquid and both are switched in plain words', {skip}, async () => {
  const {page, trouble, close} = await open('phases');
  await liveMap(page);
  const chips = () => page.$$eval('.pickers .chips', (rows) => rows.map(
                                      (row) => [...row.children].map((chip) => chip.textContent)));
  assert.deepEqual((await chips())[0], ['Whole flow', 'Grains alone', 'Liquid alone']);
  assert.ok((await chips())[1].includes('Share of liquid'));
  const whole = await picture(page);
  await page.click('[data-key="material-grains"]');
  assert.equal(await page.textContent('.map-title'), 'Probability that grains arrive');
  assert.deepEqual((await chips())[1],
                   ['Reached', 'Arrival', 'Thickness', 'Speed', 'Energy', 'Pressure']);
  const grains = await picture(page);
  assert.notEqual(grains, whole);
  await page.click('[data-key="solid_pressure"]');
  assert.match(await page.textContent('.map-title'), /dynamic pressure of the grains exceeds/);
  await page.click('[data-key="material-liquid"]');
  assert.match(await page.textContent('.map-title'), /dynamic pressure of the liquid exceeds/);
  await page.click('[data-key="liquid_reached"]');
  assert.notEqual(await picture(page), grains);
  const marks = await page.textContent('.legend.marks');
  assert.match(marks, /grains arrive with a probability of 50\s% or more/);
  assert.match(marks, /liquid arrives with a probability of 50\s% or more/);
  for (const x of [0.40, 0.45, 0.5, 0.55, 0.6]) {  // the first place that the flow came to
    await clickMap(page, x, 0.5);
    if (/Grains in/.test(await page.textContent('.cell-box'))) break;
  }
  assert.match(await page.textContent('.cell-box'), /Grains in \d+: \d+\s%.*Liquid in \d+: /);
  const rows = () => page.$$eval('.cell-table:last-of-type tbody th', (all) => all.map(
                                     (cell) => cell.textContent));
  assert.ok((await rows()).every((row) => /liquid/.test(row)), (await rows()).join());
  await page.click('[data-key="material-"]');
  assert.ok((await rows()).some((row) => /^Flow speed/.test(row)), (await rows()).join());
  assert.ok((await rows()).every((row) => !/grains/.test(row)), (await rows()).join());
  assert.deepEqual(trouble, []);
  await close();
});

test('a flow of one material has no switch of materials', {skip}, async () => {
  const {page, close} = await open('ensemble');
  await liveMap(page);
  assert.equal(await page.locator('[data-key^="material-"]').count(), 0);
  assert.equal(await page.locator('#phases').count(), 0);
  await close();
});

test('grains are cut off by grains alone', {skip}, async () => {
  const {page, close} = await open('phases');
  const rows = await page.$$eval('#phases tbody tr', (all) => all.map(
                                     (row) => [...row.cells].map((c) => c.textContent)));
  assert.deepEqual(rows.slice(0, 3).map((r) => r[1]), ['grains', 'liquid', 'whole flow']);
  assert.equal(rows[0].at(-1), '–');
  assert.match(rows[1].at(-1), /\d+ of 31 cut off/);
  assert.match(rows[2].at(-1), /\d+ of 31 cut off/);
  assert.match(await page.textContent('body'), /grains in 0, liquid in \d+ \(up to/);
  await close();
});

test('both ends of the interval are maps of their own', {skip}, async () => {
  const {page, close} = await open('ensemble');
  await liveMap(page);
  const share = await picture(page);
  await page.click('[data-key="lower"]');
  assert.match(await page.textContent('.map-title'), /lower end of its 95 % interval/);
  const lower = await picture(page);
  assert.notEqual(lower, share);
  await page.click('[data-key="upper"]');
  assert.notEqual(await picture(page), lower);
  await close();
});

test('the plain wheel says what zooms, and the whole screen keeps legend and choices', {skip},
     async () => {
       const {page, close} = await open('ensemble');
       await liveMap(page);
       await page.locator('#map').scrollIntoViewIfNeeded();
       const box = await page.locator('#map').boundingBox();
       await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
       await page.mouse.wheel(0, 40);
       assert.ok(await page.locator('.wheel-hint').isVisible());
       await page.click('.ol-full-screen button');
       await page.waitForTimeout(500);
       assert.equal(await page.evaluate(() => document.fullscreenElement?.id), 'map-app');
       for (const part of ['.legend-box', '.pickers', '.map-title'])
         assert.ok(await page.locator(part).isVisible(), part);
       await close();
     });

test('charts are drawn and the table sorts', {skip}, async () => {
  const {page, trouble, close} = await open('ensemble');
  await liveMap(page);
  for (const id of ['chart-runout', 'chart-convergence', 'chart-scatter'])
    assert.ok(await page.locator(`#${id} canvas`).count() > 0, id);
  const column = () => page.$$eval('#member-table tbody tr', (rows) => rows.map(
                                       (row) => Number(row.cells[2].dataset.v)));
  await page.locator('#member-table th button').nth(2).click();
  const ascending = await column();
  assert.deepEqual(ascending, [...ascending].sort((a, b) => a - b));
  await page.locator('#member-table th button').nth(2).click();
  assert.deepEqual(await column(), ascending.reverse());
  assert.deepEqual(trouble, []);
  await close();
});

test('a run is followed through time with one cursor', {skip}, async () => {
  const {page, trouble, close} = await open('single');
  await liveMap(page);
  for (const name of ['travel', 'speed', 'states'])
    assert.ok(await page.locator(`#chart-${name} canvas`).count() > 0, name);
  assert.ok(!await page.locator('#motion .still-chart').first().isVisible());
  assert.equal(await page.textContent('#read-states'), '');
  await page.locator('#chart-speed').scrollIntoViewIfNeeded();
  const box = await page.locator('#chart-speed').boundingBox();
  const before = (await page.locator('#chart-states').boundingBox()).y;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.waitForTimeout(300);
  assert.match(await page.textContent('#read-speed'), /^\d+(\.\d+)?\ss: fastest particle 2\d/);
  assert.match(await page.textContent('#read-states'), /dense 8\d(\.\d)?\s%/);
  assert.equal((await page.locator('#chart-states').boundingBox()).y, before, 'nothing may jump');
  assert.deepEqual(trouble, []);
  await close();
});

test('a phone shows the page without sideways scrolling', {skip}, async () => {
  for (const name of ['ensemble', 'single', 'cut', 'phases', 'phases_single', 'empty']) {
    const {page, close} = await open(
        name, {viewport: {width: 360, height: 740}, isMobile: true, hasTouch: true});
    if (name !== 'empty') await liveMap(page);
    const [inner, outer] = await page.evaluate(
        () => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
    assert.ok(inner <= outer, `${name}: ${inner} px of content on ${outer} px`);
    await close();
  }
});

test('without script and in print the still maps stand in', {skip}, async () => {
  const {page, close} = await open('ensemble', {javaScriptEnabled: false});
  assert.ok(await page.locator('#still-maps figure').first().isVisible());
  await close();
  const run = await open('single', {javaScriptEnabled: false});
  assert.ok(await run.page.locator('#motion .still-chart').first().isVisible());
  await run.close();
  const live = await open('ensemble');
  await liveMap(live.page);
  assert.ok(!await live.page.locator('#still-maps').isVisible());
  await live.page.emulateMedia({media: 'print'});
  assert.ok(await live.page.locator('#still-maps').isVisible());
  assert.ok(!await live.page.locator('#map-app').isVisible());
  await live.close();
});

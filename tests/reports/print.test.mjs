// SPDX-License-Identifier: Apache-2.0
// The printed page in headless Chromium, see browser.mjs: one map sheet, one page of numbers, annex.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {liveMap, open, skip} from './browser.mjs';

const sheets = (pdf) => (pdf.toString('latin1').match(/\/Type\s*\/Page\b(?!s)/g) ?? []).length;
const print = (page) => page.pdf({preferCSSPageSize: true, printBackground: true});

async function hide(page, selector) {
  await page.evaluate((s) => { document.querySelector(s).remove(); }, selector);
}

test('print is one map sheet, one page of numbers and an annex', {skip}, async () => {
  for (const name of ['ensemble', 'cut', 'single', 'region', 'german']) {
    const {page, trouble, close} = await open(name);
    await liveMap(page);
    const all = sheets(await print(page));
    assert.ok(all >= 3, `${name}: ${all} pages`);
    await hide(page, '.annex');
    assert.equal(sheets(await print(page)), 2, `${name}: map and numbers`);
    await hide(page, '.number-sheet');
    assert.equal(sheets(await print(page)), 1, `${name}: the map alone`);
    assert.deepEqual(trouble, [], name);
    await close();
  }
});

test('the sheets hold what they shall, and nothing is cut off', {skip}, async () => {
  for (const name of ['ensemble', 'cut', 'region', 'german']) {
    const {page, close} = await open(name, {viewport: {width: 1047, height: 718}});
    await liveMap(page);
    await page.emulateMedia({media: 'print'});
    const overflow = await page.evaluate(() => ['.map-sheet', '.title-block', '.number-sheet'].map((s) => {
      const box = document.querySelector(s);
      return [s, box.scrollHeight - box.clientHeight, box.scrollWidth - box.clientWidth];
    }));
    for (const [part, down, across] of overflow)
      assert.ok(down <= 1 && across <= 1, `${name} ${part}: ${down}, ${across} px too much`);
    assert.match(await page.innerText('.title-block'), /EPSG:32633/);
    assert.ok(await page.locator('.map-sheet figure svg').first().isVisible());
    assert.ok(!await page.locator('.map-app').isVisible());
    assert.ok(!await page.locator('#computation').isVisible(), 'developer material');
    await close();
  }
});

test('the member table of the annex marks what failed and what is cut off', {skip}, async () => {
  const {page, close} = await open('cut');
  await page.emulateMedia({media: 'print'});
  assert.ok(await page.locator('#member-table').isVisible());
  const marks = await page.$$eval('#member-table tbody tr', (rows) => rows.map(
                                      (row) => [row.className, row.cells[1].textContent[0]]));
  assert.ok(marks.some(([kind]) => kind === 'lost') && marks.some(([kind]) => kind === 'cut'));
  for (const [kind, mark] of marks)
    if (kind) assert.equal(mark, kind === 'lost' ? '✕' : '→');
  assert.equal(await page.evaluate(
      () => getComputedStyle(document.querySelector('#member-table thead')).display),
               'table-header-group', 'heads repeat on every sheet');
  await close();
});

test('what was chosen on the screen is what is printed', {skip}, async () => {
  const {page, close} = await open('ensemble');
  await liveMap(page);
  await page.click('[data-key="energy"]');
  await page.waitForTimeout(300);
  await print(page);
  assert.match(await page.textContent('#seen-map'), /exceeds 10/);
  await page.click('[data-key="reached"]');
  await page.waitForTimeout(300);
  await print(page);
  assert.ok(await page.evaluate(() => document.getElementById('seen-map').hidden));
  await close();
});

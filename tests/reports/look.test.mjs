// SPDX-License-Identifier: Apache-2.0
// How the pages look in headless Chromium, see browser.mjs: widths, schemes, languages, size, time.
import assert from 'node:assert/strict';
import {statSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {liveMap, open, pages, skip} from './browser.mjs';

const names = ['ensemble', 'single', 'cut', 'phases', 'phases_single', 'region', 'overlays', 'frames',
               'german', 'empty'];

test('no page scrolls sideways, on a phone or a desk', {skip}, async () => {
  for (const [width, height, phone] of [[390, 844, true], [1400, 900, false]])
    for (const name of names) {
      const {page, trouble, close} = await open(
          name, {viewport: {width, height}, isMobile: phone, hasTouch: phone});
      if (name !== 'empty') await liveMap(page);
      const [inner, outer] = await page.evaluate(
          () => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
      assert.ok(inner <= outer, `${name} at ${width}: ${inner} px of content on ${outer} px`);
      assert.deepEqual(trouble, [], name);
      await close();
    }
});

test('the finding comes first, and the map begins above the fold at full width', {skip}, async () => {
  for (const name of ['ensemble', 'single', 'region']) {
    const {page, close} = await open(name, {viewport: {width: 1400, height: 900}});
    await liveMap(page);
    const finding = await page.locator('.finding').first().boundingBox();
    const map = await page.locator('#map').boundingBox();
    assert.ok(finding.y < map.y, name);
    assert.ok(map.y < 480 && map.y + map.height <= 980, `${name}: map from ${map.y}`);
    assert.ok(map.width > 1300, `${name}: ${map.width} px wide`);
    await close();
  }
  const {page, close} = await open('ensemble');
  assert.match(await page.textContent('.finding'),
               /If this mass.* runs [\d\u202f]+\sm or farther in half of the 31 simulations \(95\s% interval .*\) and passes over .* with a probability of 50\s% or more; .*after about (\d+ min )?\d+ s\./);
  assert.match(await page.textContent('.holds'), /friction coefficient 0\.\d+–0\.\d+.*31 simulations; 1 failed/);
  await close();
});

test('light and dark differ, and text can be read in both', {skip}, async () => {
  for (const colorScheme of ['light', 'dark']) {
    const {page, close} = await open('ensemble', {colorScheme});
    await liveMap(page);
    const weak = await page.evaluate(() => {
      const channels = (text) => text.match(/[\d.]+/g).slice(0, 3).map(Number);
      const luminance = (rgb) => {
        const [r, g, b] = rgb.map((c) => {
          const s = c / 255;
          return s <= 0.03928 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
        });
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const paper = luminance(channels(getComputedStyle(document.body).backgroundColor));
      const found = [];
      for (const selector of ['h1', '.finding', '.holds', '.note', 'nav a', '.card dt', '.card .detail', 'summary']) {
        const node = document.querySelector(selector);
        const ink = luminance(channels(getComputedStyle(node).color));
        const contrast = (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
        if (contrast < 4.5) found.push(`${selector} ${contrast.toFixed(2)}`);
      }
      return found;
    });
    assert.deepEqual(weak, [], colorScheme);
    await close();
  }
});

test('a German page is German', {skip}, async () => {
  const {page, trouble, close} = await open('german');
  await liveMap(page);
  assert.equal(await page.getAttribute('html', 'lang'), 'de');
  assert.equal(await page.textContent('.map-title'), 'Wahrscheinlichkeit, dass die Masse ankommt');
  assert.match(await page.textContent('.finding'), /Löst sich diese Masse/);
  assert.match(await page.textContent('.holds'), /0,\d+–0,\d+/, 'decimal commas');
  const text = await page.evaluate(() => {
    for (const part of document.querySelectorAll(
        'script, style, pre, h1, .manifest, .warnings li, .attention, .map-comment, #computation, #member-table, .lost-list, .origin'))
      part.remove();
    return document.body.innerText;
  });
  const left = text.match(/\b(the|of|with|and|members?|simulations|cut off|probability|share)\b/gi);
  assert.deepEqual(left, null, 'English words are left');
  assert.deepEqual(trouble, []);
  await close();
});

test('a page of 500 x 500 cells is small and quick', {skip}, async () => {
  const size = statSync(join(pages, 'large.html')).size;
  assert.ok(size < 15e6, `${size} bytes`);
  const {page, trouble, close} = await open('large');
  const planes = await page.evaluate(() => {
    const {maps} = JSON.parse(document.getElementById('sturz-data').textContent);
    return maps.layers.reduce((sum, layer) => sum + layer.planes.length, 0);
  });
  assert.ok(planes >= 20, `${planes} planes`);
  // Seconds of the tab's own processor time, on which other load of the machine has no say.
  const tab = await page.context().newCDPSession(page);
  await tab.send('Performance.enable');
  await page.waitForSelector('.live-maps #map canvas', {timeout: 60000});
  const {metrics} = await tab.send('Performance.getMetrics');
  const seconds = metrics.find(({name}) => name === 'ProcessTime').value;
  assert.ok(seconds < 3, `${seconds} s to the first map`);
  assert.deepEqual(trouble, []);
  await close();
});

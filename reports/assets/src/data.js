// SPDX-License-Identifier: Apache-2.0
// Unpacks rasters: base64, deflate, differences along rows, whole numbers to values.

import {languageOf} from './texts.js';

export async function inflate(base64) {
  const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Values of a packed raster, row by row from the north-west; NaN where there are none. */
export async function unpack(raster, cols) {
  const bytes = await inflate(raster.data);
  const wide = raster.bits === 16;
  const n = wide ? bytes.length / 2 : bytes.length;
  const mask = wide ? 0xffff : 0xff;
  const values = new Float32Array(n);
  let code = 0;
  for (let i = 0; i < n; i++) {
    const step = wide ? (bytes[i] << 8) | bytes[n + i] : bytes[i];
    code = (i % cols === 0 ? step : code + step) & mask;
    values[i] = code === raster.nodata
        ? NaN
        : raster.offset + raster.factor * (raster.square ? code * code : code);
  }
  return values;
}

/** Column and row of a map point in a grid, as one index; -1 outside. */
export function cellIndex(grid, x, y) {
  const col = Math.floor((x - grid.west) / grid.cell);
  const row = Math.floor((grid.north - y) / grid.cell);
  return col < 0 || row < 0 || col >= grid.cols || row >= grid.rows ? -1 : row * grid.cols + col;
}

/** [west, south, east, north] */
export function extentOf(grid) {
  return [
    grid.west, grid.north - grid.rows * grid.cell, grid.west + grid.cols * grid.cell, grid.north,
  ];
}

/** Whether a cell stays clear: no value, or nothing came (of a difference: nothing changed). */
export const isClear = (legend, stored) => Number.isNaN(stored) ||
    (legend.clearZero && (legend.diverging ? stored === 0 : stored <= 0));

/** Index of the legend class of a stored value, -1 where the cell stays clear. */
export function classOf(legend, stored) {
  if (isClear(legend, stored)) return -1;
  const shown = stored * legend.unitFactor;
  if (legend.nominal) return Math.round(shown - legend.classes[0].lower);
  let found = 0;
  for (let i = 1; i < legend.classes.length; i++) {
    const lower = legend.classes[i].lower;
    if (shown >= lower - 1e-6 * Math.abs(lower)) found = i;
  }
  return found;
}

/** Wilson's interval of a share p in n members. */
export function wilson(p, n, z) {
  const shrink = 1 + z * z / n;
  const centre = (p + z * z / (2 * n)) / shrink;
  const half = z * Math.sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / shrink;
  return [Math.max(0, centre - half), Math.min(1, centre + half)];
}

const grouped = new Intl.NumberFormat('en', {maximumSignificantDigits: 3, useGrouping: 'always'});
const local = (text) => languageOf() === 'en' ? text : text.replace('.', decimalMark());
const decimalMark = () => new Intl.NumberFormat(languageOf()).format(0.5)[1];

/** "8.69 × 10⁻¹²", as tables have it. */
function powerText(value) {
  const [number, power] = value.toExponential(2).split('e-');
  const raised = [...power].map((digit) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[digit]).join('');
  return `${local(number.replace(/0+$/, '').replace(/\.$/, '').replace('-', '−'))}\u00a0×\u00a010⁻${raised}`;
}

/** Three significant digits, thousands separated by narrow spaces. */
export function numberText(value) {
  if (!Number.isFinite(value)) return '–';
  const whole = Math.abs(value) >= 1000 ? Math.round(value).toString() : null;
  if (value !== 0 && Math.abs(value) < 1e-6) return powerText(value);
  if (whole === null) return local(grouped.format(value).replace('-', '−'));
  const digits = Math.abs(value) >= 10000 ? whole.replace(/\B(?=(\d{3})+$)/g, '\u202f') : whole;
  return digits.replace('-', '−');
}

/** With so many decimals. */
export const fixedText = (value, decimals) => local(value.toFixed(decimals).replace('-', '−'));

export function percentText(p) {
  if (!Number.isFinite(p)) return '–';
  if (p > 0 && p < 0.01) return '<\u00a01\u00a0%';
  if (p < 1 && p > 0.99) return '>\u00a099\u00a0%';
  return `${Math.round(100 * p)}\u00a0%`;
}

/** A stored value of a layer as a reader wants it. */
export function valueText(legend, stored) {
  if (Number.isNaN(stored)) return '–';
  // A difference says which way it goes.
  if (legend.diverging && stored !== 0 && Number.isFinite(stored))
    return `${stored > 0 ? '+' : '−'}${percentText(Math.abs(stored))}`;
  if (legend.probability) return percentText(stored);
  if (legend.nominal) return legend.classes[classOf(legend, stored)]?.label ?? '–';
  return `${numberText(stored * legend.unitFactor)} ${legend.unit}`.trim().replace(' ', '\u00a0');
}

// SPDX-License-Identifier: Apache-2.0
// Ground and values along a line that the reader draws, or that the scene brought along.
import uPlot from 'uplot';

import {colours, onColourChange} from './colours.js';
import {cellIndex, isClear, numberText, valueText} from './data.js';
import {element, saveAs, toggle} from './dom.js';
import {columnOf} from './save.js';
import {t} from './texts.js';

const font = '11px system-ui, sans-serif';
const mostPoints = 2000;

/** Points along a line about half a cell apart: [{s, x, y}]. */
export function pointsAlong(line, cell) {
  const lengths = line.slice(1).map(([x, y], i) => Math.hypot(x - line[i][0], y - line[i][1]));
  const total = lengths.reduce((sum, l) => sum + l, 0);
  const n = Math.max(2, Math.min(mostPoints, Math.ceil(total / (0.5 * cell)) + 1));
  const points = [];
  let leg = 0;
  let before = 0;
  for (let k = 0; k < n; k++) {
    const s = total * k / (n - 1);
    while (leg < lengths.length - 1 && s > before + lengths[leg]) before += lengths[leg++];
    const share = lengths[leg] > 0 ? Math.min(1, (s - before) / lengths[leg]) : 0;
    const [x0, y0] = line[leg];
    const [x1, y1] = line[leg + 1];
    points.push({s, x: x0 + share * (x1 - x0), y: y0 + share * (y1 - y0)});
  }
  return points;
}

/** Lines of the overlays that a reader may choose. */
function givenLines(overlays) {
  const lines = [];
  for (const {name, features} of overlays)
    features.filter((f) => f.kind === 'line').forEach((f, k) => lines.push(
        {label: f.name ? `${name}: ${f.name}` : `${name} ${k + 1}`, at: f.at}));
  return lines.slice(0, 100);
}

function plotOf(box, rows, legend, view) {
  const c = colours();
  const axis = {stroke: c.muted, grid: {stroke: c.line, width: 1}, ticks: {show: false}, font,
                labelFont: font, values: (_, ticks) => ticks.map((v) => v === null ? null : numberText(v))};
  const factor = legend.probability ? 100 : legend.unitFactor;
  const shown = (v) => isClear(legend, v) ? null : v * factor;
  const lowest = Math.min(...rows.map((r) => r.z).filter(Number.isFinite));
  const read = box.parentNode.querySelector('.profile-read');
  return new uPlot({
    width: box.clientWidth, height: 220, legend: {show: false},
    cursor: {drag: {x: false, y: false}, y: false},
    scales: {x: {time: false}, z: {}, v: {range: (_, __, max) => [0, max > 0 ? 1.08 * max : 1]}},
    axes: [
      {...axis, label: t('profile_distance'), labelSize: 16, size: 28},
      {...axis, scale: 'z', label: t('profile_ground'), labelSize: 16, size: 46},
      {...axis, scale: 'v', side: 1, grid: {show: false}, labelSize: 16, size: 46,
       label: legend.probability ? `${legend.title} [%]` : legend.title},
    ],
    series: [
      {},
      {scale: 'z', stroke: c.muted, width: 1.5, fill: c.line, fillTo: lowest, points: {show: false}},
      {scale: 'v', stroke: c.warm, width: 2.2, points: {show: false}},
    ],
    hooks: {
      setCursor: [(plot) => {
        const row = rows[plot.cursor.idx ?? -1];
        view.point(row ? [row.x, row.y] : null);
        read.textContent = row ? `${numberText(row.s)} m: ${valueText(legend, row.v)}, ` +
            `${t('ground')} ${numberText(row.z)} m` : '';
      }],
    },
  }, [rows.map((r) => r.s), rows.map((r) => Number.isFinite(r.z) ? r.z : null),
      rows.map((r) => shown(r.v))], box);
}

const digits = (v, n) => Number.isNaN(v) ? '' : String(Number(v.toFixed(n)));

/**
 * @param {object} view of createMap
 * @param {Function} current gives {layer, values, title, name} that is seen
 * @param {Function} groundHeight of [x, y]
 */
export function profileTool(view, grid, current, groundHeight) {
  const chart = element('div', {class: 'profile-chart'});
  const read = element('small', {class: 'profile-read'});
  const title = element('b', {});
  const csv = element('button', {type: 'button', id: 'profile-csv', class: 'tool'}, t('save_csv'));
  const lines = givenLines(view.overlays.named);
  const pick = element('select', {id: 'pick-line', 'aria-label': t('profile_given')});
  pick.append(new Option(t('profile_given'), ''));
  lines.forEach((line, k) => pick.append(new Option(line.label, k)));
  pick.hidden = lines.length === 0;
  const box = element('div', {class: 'profile', id: 'profile'},
                      element('p', {class: 'profile-head'}, title, pick, read, csv), chart);
  box.hidden = true;
  let line = null;
  let rows = [];
  let plot = null;

  const draw = () => {
    plot?.destroy();
    plot = null;
    csv.hidden = line === null;
    title.textContent = line === null ? t('profile_draw') : current().title;
    if (box.hidden || line === null) return;
    const {layer, values} = current();
    rows = pointsAlong(line, grid.cell).map(({s, x, y}) => {
      const at = cellIndex(grid, x, y);
      return {s, x, y, z: groundHeight([x, y]), v: at < 0 ? NaN : values[at]};
    });
    plot = plotOf(chart, rows, layer.legend, view);
  };
  csv.addEventListener('click', () => {
    const {layer: {legend}, name} = current();
    const shown = (v) => Number.isNaN(v) ? '' : Number((v * legend.unitFactor).toPrecision(6));
    const text = rows.map((r) => [digits(r.s, 2), digits(r.x, 2), digits(r.y, 2), digits(r.z, 2),
                                  shown(r.v)].join(','));
    const head = `distance_m,x_m,y_m,ground_m,${columnOf(name, legend)}`;
    saveAs(`profile_${name}.csv`, new Blob([`${head}\n${text.join('\n')}\n`], {type: 'text/csv'}));
  });
  const follow = (coordinates) => {
    line = coordinates;
    draw();
  };
  pick.addEventListener('change', () => {
    if (pick.value === '') return;
    view.showLine(lines[Number(pick.value)].at);
    follow(lines[Number(pick.value)].at);
  });
  const {button} = toggle('tool-profile', t('profile'), (on) => {
    box.hidden = !on;
    view.setDrawing(on);
    view.point(null);
    if (!on) line = null;
    draw();
  });
  onColourChange(draw);
  addEventListener('resize', draw);
  return {button, box, follow, redraw: draw};
}

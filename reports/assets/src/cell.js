// SPDX-License-Identifier: Apache-2.0
// What the members say at one cell: exceedance curve with its interval, quantiles, or peaks.
import uPlot from 'uplot';

import {colours, onColourChange} from './colours.js';
import {numberText, percentText, valueText, wilson} from './data.js';
import {t} from './texts.js';

const named = (tag, className, ...children) => {
  const node = document.createElement(tag);
  node.className = className;
  node.append(...children);
  return node;
};

/** P above each threshold; a quantile q of value v says the same thing: P(above v) = 1 - q. */
function curveData(entries, quantiles, at, page) {
  const points = entries.map(({plane, values}) => ({x: plane.axis, p: values[at], ring: false}));
  for (const {layer, plane, values} of quantiles)
    points.push({x: values[at] * layer.legend.unitFactor, p: 1 - plane.axis, ring: true});
  const usable = points.filter(({x, p}) => x > 0 && p >= 0).sort((a, b) => a.x - b.x || b.p - a.p);
  const curve = usable.filter(({x}, i) => i === 0 || x !== usable[i - 1].x);
  const bounds = curve.map(({p}) => wilson(p, page.trials, page.z));
  return [
    curve.map(({x}) => x),
    curve.map(({p}) => 100 * p),
    bounds.map(([low]) => 100 * low),
    bounds.map(([, high]) => 100 * high),
    curve.map(({p, ring}) => ring ? null : 100 * p),
    curve.map(({p, ring}) => ring ? 100 * p : null),
  ];
}

function drawCurve(box, entries, quantiles, at, page) {
  const data = curveData(entries, quantiles, at, page);
  const c = colours();
  const logarithmic = data[0].at(-1) / data[0][0] > 20;
  const unit = entries[0].layer.axisUnit;
  const axis = {stroke: c.muted, grid: {stroke: c.line, width: 1}, ticks: {show: false},
                font: '11px system-ui, sans-serif', labelFont: '11px system-ui, sans-serif'};
  const dots = {stroke: c.accent, paths: () => null};
  new uPlot({
    width: box.clientWidth, height: 220, legend: {show: false},
    cursor: {drag: {x: false, y: false}, y: false},
    scales: {
      x: {time: false, distr: logarithmic ? 3 : 1},
      y: {range: [0, 100]},
    },
    axes: [
      {...axis, label: `${entries[0].layer.quantityTitle} [${unit}]`, labelSize: 18, size: 28,
       values: (_, ticks) => ticks.map((t) => t === null ? null : numberText(t))},
      {...axis, size: 40, values: (_, ticks) => ticks.map((t) => `${t} %`)},
    ],
    series: [
      {},
      {stroke: c.accent, width: 2, points: {show: false}},
      {stroke: 'transparent', points: {show: false}},
      {stroke: 'transparent', points: {show: false}},
      {...dots, points: {show: true, size: 7, fill: c.accent}},
      {...dots, points: {show: true, size: 7, width: 1.6, fill: c.sheet}},
    ],
    bands: [{series: [3, 2], fill: c.band}],
  }, data, box);
}

function thresholdTable(entries, at, page) {
  const table = named('table', 'plain cell-table');
  const body = table.createTBody();
  for (const {layer, plane, values} of entries) {
    const p = values[at];
    const [low, high] = wilson(p, page.trials, page.z);
    const row = body.insertRow();
    row.append(named('th', '', plane.label,
                     plane.resolved === false ? named('small', 'flag', t('not_resolved')) : ''));
    row.append(named('td', 'n', valueText(layer.legend, p)));
    row.append(named('td', 'n soft', `${percentText(low)} – ${percentText(high)}`));
  }
  return table;
}

/** Rows: quantities; columns: quantile levels. */
function quantileTable(planes, at) {
  const layers = [...new Set(planes.map((p) => p.layer))];
  if (layers.length === 0) return '';
  const table = named('table', 'plain cell-table');
  const head = table.createTHead().insertRow();
  head.append(named('th', ''));
  for (const plane of layers[0].planes)
    head.append(named('th', 'n', plane.axis === 0.5 ? t('median') : `${numberText(100 * plane.axis)}\u00a0%`));
  const body = table.createTBody();
  for (const layer of layers) {
    const row = body.insertRow();
    row.append(named('th', '', `${layer.quantityTitle}`,
                     named('small', '', layer.legend.unit)));
    for (const p of planes.filter((entry) => entry.layer === layer))
      row.append(named('td', 'n', numberText(p.values[at] * layer.legend.unitFactor)));
  }
  return table;
}

function peakTable(planes, at) {
  const table = named('table', 'plain cell-table');
  const body = table.createTBody();
  for (const {layer, plane, values} of planes) {
    const row = body.insertRow();
    row.append(named('th', '', plane.title), named('td', 'n', valueText(layer.legend, values[at])));
  }
  return table;
}

/** Sources with their probabilities, the most probable first. */
function sourceTable(list) {
  const most = 40;
  const table = named('table', 'plain cell-table');
  const body = table.createTBody();
  for (const {name, p} of list.slice(0, most)) {
    const row = body.insertRow();
    row.append(named('th', '', name), named('td', 'n', percentText(p)));
  }
  if (list.length > most) {
    const row = body.insertRow();
    row.append(named('th', '', t('and_more', list.length - most)), named('td', 'n', ''));
  }
  return table;
}

/** What comes to a cell of a region: its sources, and values of all of them together. */
function regionPanel(box, list, planes, at) {
  if (list.length === 0) {
    box.append(named('p', 'note', t('cell.no_source')));
    return;
  }
  const n = list.length;
  box.append(named('p', 'cell-line', t('cell.reached_by_sources'),
                   named('b', '', t(n > 1 ? 'cell.sources.many' : 'cell.sources.one', n)),
                   t(n > 1 ? 'cell.each_probability' : 'cell.its_probability')),
             sourceTable(list));
  const together = planes.filter((p) => p.layer.quantity === 'sources' && !p.layer.legend.nominal);
  if (together.length > 0)
    box.append(named('p', 'chart-title', t('cell.if_all')), peakTable(together, at));
  const worst = planes.filter((p) => p.layer.statistic === 'source_quantile');
  if (worst.length > 0)
    box.append(named('p', 'chart-title', t('cell.worst_source')),
               quantileTable(worst, at));
}

export function createCellPanel(box, page, planes, sources, closed) {
  const of = (statistic, quantity) => planes.filter(
      (p) => p.layer.statistic === statistic && (!quantity || p.layer.quantity === quantity));
  const curves = [...new Set(planes.filter((p) => p.layer.statistic === 'probability' &&
                                                  p.layer.planes.length > 1)
                                 .map((p) => p.layer.quantity))];
  const reached = planes.find((p) => p.layer.quantity === 'reached');
  let shown = null;
  let quantity = curves[0];
  let material = '';  // '' is the whole flow

  const draw = () => {
    if (!shown) {
      box.replaceChildren(named('p', 'note', t(
          sources ? 'cell.click_sources' : page.single ? 'cell.click_peaks' : 'cell.click_curve')));
      return;
    }
    const {at, coordinate, height} = shown;
    const place = `x ${Math.round(coordinate[0])}, y ${Math.round(coordinate[1])}` +
        (Number.isFinite(height) ? `, ${Math.round(height)} m` : '');
    const close = named('button', 'tool close', '×');
    close.type = 'button';
    close.title = t('close');
    close.addEventListener('click', () => {
      shown = null;
      draw();
      closed();
    });
    box.replaceChildren(close, named('h4', '', `${t('cell.here')} `, named('small', '', place)));
    if (page.beside) box.append(named('p', 'note', `A: ${page.beside.nameA}`));
    if (sources) {
      regionPanel(box, sources.at(at), planes, at);
      return;
    }
    const touched = at >= 0 &&
        (reached ? reached.values[at] > 0 : planes.some((p) => p.values[at] > 0));
    if (!touched) {
      box.append(named('p', 'note', t(page.single ? 'cell.flow_not' : 'cell.none_came')));
      return;
    }
    if (reached) {
      const p = reached.values[at];
      const [low, high] = wilson(p, page.trials, page.z);
      box.append(named('p', 'cell-line',
                       page.weighted ? t('cell.reached_weighted')
                                     : t('cell.reached_by', Math.round(p * page.valid), page.valid),
                       named('b', '', percentText(p)),
                       ` (${percentText(low)} – ${percentText(high)})`));
      for (const [quantity, name] of [['solid_reached', t('cell.grains_in')], ['liquid_reached', t('cell.liquid_in')]]) {
        const own = planes.find((p) => p.layer.quantity === quantity)?.values[at];
        if (own === undefined) continue;
        const [least, most] = wilson(own, page.trials, page.z);
        box.append(named('p', 'cell-line', page.weighted ? `${name} ` : `${name} ${Math.round(own * page.valid)}: `,
                         named('b', '', percentText(own)),
                         ` (${percentText(least)} – ${percentText(most)})`));
      }
    }
    if (quantity) {
      const entries = of('probability', quantity);
      const chart = named('div', 'cell-chart');
      box.append(named('p', 'chart-title', t('cell.share_above')), chart);
      drawCurve(chart, entries, of('quantile', quantity), at, page);
      box.append(named('p', 'note', t('cell.curve_key')), thresholdTable(entries, at, page));
    }
    const own = (p) => p.layer.material === material;
    const quantiles = of('quantile').filter(own);
    if (quantiles.length > 0)
      box.append(named('p', 'chart-title', t('cell.quantiles')),
                 quantileTable(quantiles, at));
    if (!quantity && quantiles.length === 0) box.append(peakTable(planes.filter(own), at));
  };
  onColourChange(draw);
  addEventListener('resize', () => shown && draw());
  draw();

  return {
    redraw: draw,
    show(at, coordinate, height) {
      shown = {at, coordinate, height};
      draw();
    },
    /** The curve follows the map's quantity where that has thresholds, the tables its material. */
    follow(next, nextMaterial) {
      const newCurve = curves.includes(next) && next !== quantity;
      if (!newCurve && nextMaterial === material) return;
      material = nextMaterial;
      if (newCurve) quantity = next;
      draw();
    },
  };
}

// SPDX-License-Identifier: Apache-2.0
// Charts of the whole ensemble: runout histogram, convergence, parameters against runout. What is
// cut off is drawn as such: hatched bars, rings with an arrow.
import uPlot from 'uplot';

import {colours, onColourChange} from './colours.js';
import {fixedText, numberText} from './data.js';
import {t} from './texts.js';

const font = '11px system-ui, sans-serif';

export function axes(c, xLabel, yLabel) {
  const shared = {
    stroke: c.muted, grid: {stroke: c.line, width: 1}, ticks: {show: false}, font, labelFont: font,
    values: (_, ticks) => ticks.map((t) => t === null ? null : numberText(t)),
  };
  return [
    {...shared, label: xLabel, labelSize: 18, size: 28},
    {...shared, label: yLabel, labelSize: 16, size: 42},
  ];
}

/** Keeps a plot as wide as its box, and redraws it when the page's colours change. */
export function keepDrawn(box, make) {
  let plot = null;
  const draw = () => {
    plot?.destroy();
    plot = make(box.clientWidth);
  };
  draw();
  onColourChange(draw);
  new ResizeObserver(() => {
    if (plot && box.clientWidth > 0 && box.clientWidth !== plot.width)
      plot.setSize({width: box.clientWidth, height: plot.height});
  }).observe(box);
  return draw;
}

function niceStep(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 2.5, 5, 10].map((s) => s * power).find((s) => s >= rough);
}

/** Bars of all values, and of those that are cut off. */
function histogram(values, cut) {
  const low = Math.min(...values);
  const high = Math.max(...values);
  const wished = Math.min(24, Math.max(8, Math.ceil(2.5 * Math.cbrt(values.length))));
  const step = niceStep(Math.max((high - low) / wished, 1e-9 * Math.max(1, Math.abs(high))));
  const first = Math.floor(low / step);
  const counts = new Array(Math.max(1, Math.floor(high / step) - first + 1)).fill(0);
  const cutCounts = counts.map(() => 0);
  values.forEach((v, i) => {
    const k = Math.min(counts.length - 1, Math.floor(v / step) - first);
    counts[k]++;
    if (cut[i]) cutCounts[k]++;
  });
  return {step, centres: counts.map((_, k) => (first + k + 0.5) * step), counts, cutCounts};
}

/** The median and its interval on top of the bars. */
function drawMedian(plot, runout, c) {
  if (runout.median === null) return;
  const {ctx, bbox} = plot;
  const x = (value) => plot.valToPos(value, 'x', true);
  ctx.save();
  if (runout.lower !== null) {
    const end = runout.open ? bbox.left + bbox.width : x(runout.upper);
    ctx.fillStyle = c.band;
    ctx.fillRect(x(runout.lower), bbox.top, end - x(runout.lower), bbox.height);
  }
  ctx.strokeStyle = c.warm;
  ctx.lineWidth = 2 * devicePixelRatio;
  ctx.beginPath();
  ctx.moveTo(x(runout.median), bbox.top);
  ctx.lineTo(x(runout.median), bbox.top + bbox.height);
  ctx.stroke();
  ctx.fillStyle = c.warm;
  ctx.font = `${11 * devicePixelRatio}px system-ui, sans-serif`;
  ctx.textAlign = x(runout.median) > bbox.left + bbox.width / 2 ? 'right' : 'left';
  const gap = (ctx.textAlign === 'left' ? 6 : -6) * devicePixelRatio;
  const word = runout.weighted ? t('median_weighted') : t('median');
  ctx.fillText(runout.atLeast ? `${word} ≥` : word, x(runout.median) + gap, bbox.top + 12 * devicePixelRatio);
  ctx.restore();
}

/** Slanted lines on the sheet's colour: a fill for what is cut off. */
function hatch(c) {
  const tile = document.createElement('canvas');
  const size = 6 * devicePixelRatio;
  tile.width = tile.height = size;
  const ctx = tile.getContext('2d');
  ctx.fillStyle = c.sheet;
  ctx.fillRect(0, 0, size, size);
  ctx.strokeStyle = c.accent;
  ctx.lineWidth = 1.6 * devicePixelRatio;
  ctx.beginPath();
  for (const shift of [-size, 0, size]) {
    ctx.moveTo(shift, size);
    ctx.lineTo(shift + size, 0);
  }
  ctx.stroke();
  return ctx.createPattern(tile, 'repeat');
}

function drawRunout(page) {
  const box = document.getElementById('chart-runout');
  const {members} = page;
  const rows = members.scalars.runout.map((_, i) => i).filter(
      (i) => members.valid[i] && members.scalars.runout[i] !== null);
  if (!box || rows.length === 0) return;
  const {step, centres, counts, cutCounts} =
      histogram(rows.map((i) => members.scalars.runout[i]), rows.map((i) => members.cut[i]));
  const anyCut = cutCounts.some((n) => n > 0);
  if (anyCut)
    document.getElementById('read-runout').textContent = t('hatched');
  keepDrawn(box, (width) => {
    const c = colours();
    const bars = {width: 1, points: {show: false}, paths: uPlot.paths.bars({size: [0.92], gap: 1})};
    return new uPlot({
      width, height: 240, legend: {show: false}, cursor: {show: false},
      scales: {
        x: {time: false, range: [centres[0] - step, centres[centres.length - 1] + step]},
        y: {range: (_, __, max) => [0, Math.max(1, max * 1.12)]},
      },
      axes: axes(c, t('runout_m'), t('simulations')),
      series: [
        {}, {fill: c.accent, stroke: c.accent, ...bars},
        {fill: () => hatch(c), stroke: c.accent, ...bars},
      ],
      hooks: {draw: [(plot) => drawMedian(plot, page.runout, c)]},
    }, [centres, counts, cutCounts.map((n) => n || null)], box);
  });
}

function drawConvergence(page) {
  const box = document.getElementById('chart-convergence');
  if (!box) return;
  const pick = document.getElementById('pick-convergence');
  const {n, series} = page.convergence;
  series.forEach((s, k) => pick.append(new Option(s.label, k)));
  const redraw = keepDrawn(box, (width) => {
    const c = colours();
    const chosen = series[Number(pick.value)];
    return new uPlot({
      width, height: 240, legend: {show: false}, cursor: {show: false},
      scales: {
        x: {time: false, range: [0, n[n.length - 1] * 1.02]},
        y: {range: (_, __, max) => [0, max > 0 ? max * 1.1 : 1]},
      },
      axes: axes(c, t('simulations_counted'), chosen.unit),
      series: [{}, {
        stroke: c.accent, width: 2, fill: c.band,
        points: {show: true, size: 5, fill: c.accent},
      }],
    }, [n, chosen.values], box);
  });
  pick.addEventListener('change', redraw);
}

/** Crosses at the foot: members that failed. */
function drawLost(plot, lost, c) {
  const {ctx, bbox} = plot;
  const r = 3.5 * devicePixelRatio;
  ctx.save();
  ctx.strokeStyle = c.warm;
  ctx.lineWidth = 1.5 * devicePixelRatio;
  for (const value of lost) {
    const px = plot.valToPos(value, 'x', true);
    const py = bbox.top + bbox.height - 2 * r;
    ctx.beginPath();
    ctx.moveTo(px - r, py - r);
    ctx.lineTo(px + r, py + r);
    ctx.moveTo(px - r, py + r);
    ctx.lineTo(px + r, py - r);
    ctx.stroke();
  }
  ctx.restore();
}

/** Rings with an arrow up: at least so far. */
function drawCut(plot, xs, ys, c) {
  const {ctx} = plot;
  const r = (xs.length > 300 ? 2 : 3) * devicePixelRatio;
  ctx.save();
  ctx.strokeStyle = c.accent;
  ctx.fillStyle = c.sheet;
  ctx.lineWidth = 1.3 * devicePixelRatio;
  ys.forEach((y, i) => {
    if (y === null || y === undefined) return;
    const px = plot.valToPos(xs[i], 'x', true);
    const py = plot.valToPos(y, 'y', true);
    ctx.beginPath();
    ctx.moveTo(px, py - r);
    ctx.lineTo(px, py - 4 * r);
    ctx.moveTo(px - r, py - 2.8 * r);
    ctx.lineTo(px, py - 4 * r);
    ctx.lineTo(px + r, py - 2.8 * r);
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(px, py, r, 0, 2 * Math.PI);
    ctx.fill();
    ctx.stroke();
  });
  ctx.restore();
}

/** "τ = 0.52", and how many pairs that is counted from where not from all. */
function agreementText({tau, ordered, pairs}) {
  if (tau === null) return t('tau_not_known');
  const text = `τ = ${fixedText(tau, 2)}`;
  return ordered < pairs ? t('tau_from', text, Math.round(100 * ordered / pairs)) : text;
}

function scatterPlot(figure, sample, page) {
  const {members} = page;
  const shown = sample.values.map((v) => v === null ? NaN : v * sample.factor);
  const usable = shown.map((_, i) => i).filter(
      (i) => members.valid[i] && members.scalars.runout[i] !== null && Number.isFinite(shown[i]));
  usable.sort((a, b) => shown[a] - shown[b]);
  const lost = shown.filter((v, i) => !members.valid[i] && Number.isFinite(v));
  const x = usable.map((i) => shown[i]);
  const y = usable.map((i) => members.scalars.runout[i]);
  const known = usable.map((i, k) => members.cut[i] ? null : y[k]);
  const cut = usable.map((i, k) => members.cut[i] ? y[k] : null);
  const caption = document.createElement('figcaption');
  const readout = document.createElement('small');
  const agreement = agreementText(sample.agreement);
  caption.append(sample.label, readout);
  readout.textContent = agreement;
  const box = document.createElement('div');
  figure.append(caption, box);
  keepDrawn(box, (width) => {
    const c = colours();
    return new uPlot({
      width, height: 210, legend: {show: false},
      cursor: {drag: {x: false, y: false}, y: false, x: false, points: {size: 11, fill: c.warm}},
      scales: {
        x: {time: false, range: (_, min, max) => {
          const low = Math.min(min, ...lost);
          const high = Math.max(max, ...lost);
          const pad = 0.04 * (high - low) || Math.abs(high) * 0.1 || 1;
          return [low - pad, high + pad];
        }},
        y: {range: (_, min, max) => [0, Math.max(max * 1.12, 1e-9)]},
      },
      axes: axes(c, sample.unit ? `[${sample.unit}]` : '', t('runout_m')),
      series: [
        {}, {
          stroke: c.accent, paths: () => null,
          points: {show: true, size: x.length > 300 ? 4 : 6, width: 0, fill: c.accent},
        },
        {stroke: 'transparent', paths: () => null, points: {show: false}},
      ],
      hooks: {
        setCursor: [(plot) => {
          const k = plot.cursor.idx ?? -1;
          const least = k >= 0 && cut[k] !== null ? '≥ ' : '';
          const pair = k >= 0 ? `${numberText(x[k])} → ${least}${numberText(y[k])} m` : '';
          readout.textContent = pair ? t('member_pair', members.member[usable[k]], pair) : agreement;
        }],
        draw: [(plot) => {
          drawCut(plot, x, cut, c);
          drawLost(plot, lost, c);
        }],
      },
    }, [x, known, cut], box);
  });
}

function drawScatter(page) {
  const box = document.getElementById('chart-scatter');
  if (!box) return;
  for (const sample of page.members.samples) {
    const figure = document.createElement('figure');
    figure.className = 'chart';
    box.append(figure);
    scatterPlot(figure, sample, page);
  }
}

export function drawCharts(page) {
  drawRunout(page);
  drawConvergence(page);
  drawScatter(page);
}

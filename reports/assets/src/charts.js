// SPDX-License-Identifier: Apache-2.0
// Charts of the whole ensemble: runout histogram, convergence, parameters against runout.
import uPlot from 'uplot';

import {colours, onColourChange} from './colours.js';
import {numberText} from './data.js';

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

function histogram(values) {
  const low = Math.min(...values);
  const high = Math.max(...values);
  const wished = Math.min(24, Math.max(8, Math.ceil(2.5 * Math.cbrt(values.length))));
  const step = niceStep(Math.max((high - low) / wished, 1e-9 * Math.max(1, Math.abs(high))));
  const first = Math.floor(low / step);
  const counts = new Array(Math.max(1, Math.floor(high / step) - first + 1)).fill(0);
  for (const v of values) counts[Math.min(counts.length - 1, Math.floor(v / step) - first)]++;
  return {step, centres: counts.map((_, k) => (first + k + 0.5) * step), counts};
}

/** The median and its interval on top of the bars. */
function drawMedian(plot, runout, c) {
  if (runout.median === null) return;
  const {ctx, bbox} = plot;
  const x = (value) => plot.valToPos(value, 'x', true);
  ctx.save();
  if (runout.lower !== null) {
    ctx.fillStyle = c.band;
    ctx.fillRect(x(runout.lower), bbox.top, x(runout.upper) - x(runout.lower), bbox.height);
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
  ctx.fillText('median', x(runout.median) + gap, bbox.top + 12 * devicePixelRatio);
  ctx.restore();
}

function drawRunout(page) {
  const box = document.getElementById('chart-runout');
  const values = page.members.scalars.runout.filter((v, i) => page.members.valid[i] && v !== null);
  if (!box || values.length === 0) return;
  const {step, centres, counts} = histogram(values);
  keepDrawn(box, (width) => {
    const c = colours();
    return new uPlot({
      width, height: 240, legend: {show: false}, cursor: {show: false},
      scales: {
        x: {time: false, range: [centres[0] - step, centres[centres.length - 1] + step]},
        y: {range: (_, __, max) => [0, Math.max(1, max * 1.12)]},
      },
      axes: axes(c, 'runout [m]', 'members'),
      series: [{}, {
        fill: c.accent, stroke: c.accent, width: 0, points: {show: false},
        paths: uPlot.paths.bars({size: [0.92], gap: 1}),
      }],
      hooks: {draw: [(plot) => drawMedian(plot, page.runout, c)]},
    }, [centres, counts], box);
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
      axes: axes(c, 'members counted', chosen.unit),
      series: [{}, {
        stroke: c.accent, width: 2, fill: c.band,
        points: {show: true, size: 5, fill: c.accent},
      }],
    }, [n, chosen.values], box);
  });
  pick.addEventListener('change', redraw);
}

/** Ranks from 1, ties share their mean. */
function ranks(values) {
  const order = values.map((_, i) => i).sort((a, b) => values[a] - values[b]);
  const out = new Array(values.length);
  for (let i = 0; i < order.length;) {
    let j = i;
    while (j + 1 < order.length && values[order[j + 1]] === values[order[i]]) j++;
    for (let k = i; k <= j; k++) out[order[k]] = (i + j) / 2 + 1;
    i = j + 1;
  }
  return out;
}

/** Spearman's rank correlation; NaN where one of both never varies. */
export function rankCorrelation(a, b) {
  const [ra, rb] = [ranks(a), ranks(b)];
  const mean = (a.length + 1) / 2;
  let ab = 0;
  let aa = 0;
  let bb = 0;
  for (let i = 0; i < a.length; i++) {
    ab += (ra[i] - mean) * (rb[i] - mean);
    aa += (ra[i] - mean) ** 2;
    bb += (rb[i] - mean) ** 2;
  }
  return ab / Math.sqrt(aa * bb);
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
  const rho = rankCorrelation(x, y);
  const caption = document.createElement('figcaption');
  const readout = document.createElement('small');
  const rhoText = Number.isFinite(rho) ? `ρ = ${rho.toFixed(2).replace('-', '−')}` : '';
  caption.append(sample.label, readout);
  readout.textContent = rhoText;
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
        y: {range: (_, min, max) => [0, Math.max(max * 1.08, 1e-9)]},
      },
      axes: axes(c, sample.unit ? `[${sample.unit}]` : '', 'runout [m]'),
      series: [{}, {
        stroke: c.accent, paths: () => null,
        points: {show: true, size: x.length > 300 ? 4 : 6, width: 0, fill: c.accent},
      }],
      hooks: {
        setCursor: [(plot) => {
          const k = plot.cursor.idx ?? -1;
          const pair = k >= 0 ? `${numberText(x[k])} → ${numberText(y[k])} m` : '';
          readout.textContent = pair ? `member ${members.member[usable[k]]}: ${pair}` : rhoText;
        }],
        draw: [(plot) => {
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
        }],
      },
    }, [x, y], box);
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

// SPDX-License-Identifier: Apache-2.0
// Charts of a run over time: travel, speeds, states. One cursor moves through all of them.
import uPlot from 'uplot';

import {axes, keepDrawn} from './charts.js';
import {colourOf, colours} from './colours.js';
import {numberText} from './data.js';
import {t} from './texts.js';

/** Share or length that a line stands for; lines of a stack hold their upper edges. */
function own(chart, k, i) {
  const value = chart.lines[k].values[i];
  return chart.stacked && k > 0 ? value - chart.lines[k - 1].values[i] : value;
}

function readout(chart, time, i) {
  const parts = chart.lines.map(
      (line, k) => `${line.label} ${numberText(own(chart, k, i))}\u00a0${chart.unit}`);
  return `${numberText(time[i])}\u00a0s: ${parts.join(', ')}`;
}

function seriesOf(chart, line) {
  const colour = colourOf(line.paint);
  if (chart.stacked) return {width: 0, fill: colour, points: {show: false}};
  return {stroke: colour, width: line.paint === 'fastest' ? 1 : 2, points: {show: false}};
}

/** The grid lies over the areas of a stack, and must let them through. */
function gridded(chart) {
  return chart.stacked ? {...colours(), line: 'rgba(127, 127, 127, 0.35)'} : colours();
}

function draw(chart, time) {
  const box = document.getElementById(`chart-${chart.name}`);
  if (!box) return;
  const text = document.getElementById(`read-${chart.name}`);
  box.hidden = false;
  // The uppermost area first: each covers what is not its own.
  const lines = chart.stacked ? chart.lines.toReversed() : chart.lines;
  keepDrawn(box, (width) => new uPlot({
    width, height: 240, legend: {show: false}, padding: [8, 12, 0, 0],
    drawOrder: chart.stacked ? ['series', 'axes'] : ['axes', 'series'],
    cursor: {drag: {x: false, y: false}, y: false, points: {show: !chart.stacked, size: 7},
             sync: {key: 'motion'}},
    scales: {
      x: {time: false, range: [0, time[time.length - 1]]},
      y: {range: [0, chart.top]},
    },
    axes: axes(gridded(chart), t('time_s'), `[${chart.unit}]`),
    series: [{}, ...lines.map((line) => seriesOf(chart, line))],
    hooks: {
      setCursor: [(plot) => {
        const i = plot.cursor.idx;
        text.textContent = i === null || i === undefined ? '' : readout(chart, time, i);
      }],
    },
  }, [time, ...lines.map((line) => line.values)], box));
}

export function drawMotion(motion) {
  for (const chart of motion.charts) draw(chart, motion.time);
}

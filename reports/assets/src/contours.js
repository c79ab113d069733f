// SPDX-License-Identifier: Apache-2.0
// Contour lines of the ground.
import {contours as d3Contours} from 'd3-contour';
import Feature from 'ol/Feature.js';
import MultiLineString from 'ol/geom/MultiLineString.js';
import Fill from 'ol/style/Fill.js';
import Stroke from 'ol/style/Stroke.js';
import Style from 'ol/style/Style.js';
import Text from 'ol/style/Text.js';

/** The largest of ..., 5, 10, 20, 50, ... metres that still gives about `wished` lines. */
function contourInterval(low, high, wished) {
  const rough = Math.max((high - low) / wished, 1e-3);
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((s) => s * power).find((s) => s >= rough);
}

/** Rings of a contour without the parts that only follow the raster's edge. */
function openLines(rings, grid) {
  const onEdge = (a, b) => (a[0] === b[0] && (a[0] <= 0.5 || a[0] >= grid.cols - 0.5)) ||
      (a[1] === b[1] && (a[1] <= 0.5 || a[1] >= grid.rows - 0.5));
  const toMap = ([x, y]) => [grid.west + x * grid.cell, grid.north - y * grid.cell];
  const lines = [];
  for (const ring of rings) {
    let line = [];
    for (let i = 0; i < ring.length; i++) {
      if (i > 0 && onEdge(ring[i - 1], ring[i])) {
        if (line.length > 1) lines.push(line);
        line = [];
      }
      line.push(toMap(ring[i]));
    }
    if (line.length > 1) lines.push(line);
  }
  return lines;
}

export function contourFeatures(ground, heights) {
  let low = Infinity;
  let high = -Infinity;
  for (const z of heights) {
    if (z < low) low = z;
    if (z > high) high = z;
  }
  if (!(high > low)) return [];
  const interval = contourInterval(low, high, 24);
  const grid = ground.grid;
  const maker = d3Contours().size([grid.cols, grid.rows]);
  const features = [];
  for (let k = Math.ceil(low / interval); k * interval < high; k++) {
    const level = k * interval;
    const lines = openLines(maker.contour(heights, level).coordinates.flat(), grid);
    if (lines.length === 0) continue;
    const feature = new Feature(new MultiLineString(lines));
    feature.set('level', level);
    feature.set('index', k % 5 === 0);
    features.push(feature);
  }
  return features;
}

const thin = new Style({stroke: new Stroke({color: 'rgba(66,54,44,0.42)', width: 0.7})});
export function contourStyle(feature) {
  if (!feature.get('index')) return thin;
  return new Style({
    stroke: new Stroke({color: 'rgba(66,54,44,0.62)', width: 1.2}),
    text: new Text({
      text: String(Math.round(feature.get('level') * 10) / 10),
      placement: 'line',
      font: '500 10px system-ui, sans-serif',
      fill: new Fill({color: 'rgba(50,40,32,0.95)'}),
      stroke: new Stroke({color: 'rgba(255,255,255,0.75)', width: 2.5}),
    }),
  });
}

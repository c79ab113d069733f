// SPDX-License-Identifier: Apache-2.0
// What every map of the page shows over its colours: outlines, fronts, edges that were crossed.
import Feature from 'ol/Feature.js';
import MultiLineString from 'ol/geom/MultiLineString.js';
import MultiPolygon from 'ol/geom/MultiPolygon.js';
import {fromExtent} from 'ol/geom/Polygon.js';
import VectorLayer from 'ol/layer/Vector.js';
import VectorSource from 'ol/source/Vector.js';
import Fill from 'ol/style/Fill.js';
import Stroke from 'ol/style/Stroke.js';
import Style from 'ol/style/Style.js';

/** Slanted lines for cells where mass crossed the edge of the terrain. */
function hatchFill() {
  const tile = document.createElement('canvas');
  const size = 7 * devicePixelRatio;
  tile.width = tile.height = size;
  const ctx = tile.getContext('2d');
  ctx.fillStyle = 'rgba(255,255,255,0.75)';
  ctx.fillRect(0, 0, size, size);
  ctx.strokeStyle = '#b3123f';
  ctx.lineWidth = 1.8 * devicePixelRatio;
  ctx.beginPath();
  for (const shift of [-size, 0, size]) {
    ctx.moveTo(shift, size);
    ctx.lineTo(shift + size, 0);
  }
  ctx.stroke();
  return new Fill({color: ctx.createPattern(tile, 'repeat')});
}

/** Cells of a plane that are not 0, as one shape; null when there is none. */
function cellShape(values, grid) {
  const squares = [];
  values.forEach((v, i) => {
    if (!(v > 0)) return;
    const west = grid.west + (i % grid.cols) * grid.cell;
    const south = grid.north - (Math.floor(i / grid.cols) + 1) * grid.cell;
    squares.push(fromExtent([west, south, west + grid.cell, south + grid.cell]).getCoordinates());
  });
  return squares.length > 0 ? new Feature(new MultiPolygon(squares)) : null;
}

/** Outlines of the release, of how far grains and liquid come, of a mapped event and of the member nearest to it, and cells where mass left: what every map of the page shows. */
export function marksLayer(maps, leftValues) {
  const source = new VectorSource();
  if (maps.release.length > 0) {
    const outline = new Feature(new MultiLineString(
        maps.release.map(([x0, y0, x1, y1]) => [[x0, y0], [x1, y1]])));
    outline.setStyle([
      new Style({stroke: new Stroke({color: 'rgba(255,255,255,0.9)', width: 4})}),
      new Style({stroke: new Stroke({color: '#111', width: 1.8})}),
    ]);
    source.addFeature(outline);
  }
  // The liquid's line is the wider one below: where both run together both are seen.
  for (const [kind, colour, width] of [['liquid', '#00798c', 5], ['grains', '#7a3b00', 2]]) {
    for (const front of maps.fronts.filter((f) => f.kind === kind)) {
      const line = new Feature(new MultiLineString(
          front.lines.map(([x0, y0, x1, y1]) => [[x0, y0], [x1, y1]])));
      line.setStyle([
        new Style({stroke: new Stroke({color: 'rgba(255,255,255,0.8)', width: width + 1.2})}),
        new Style({stroke: new Stroke({color: colour, width})}),
      ]);
      source.addFeature(line);
    }
  }
  if (maps.nearest) {
    const covered = new Feature(new MultiLineString(
        maps.nearest.lines.map(([x0, y0, x1, y1]) => [[x0, y0], [x1, y1]])));
    covered.setStyle(new Style({stroke: new Stroke({color: '#7b1fa2', width: 1.8})}));
    source.addFeature(covered);
  }
  if (maps.observed) {
    const mapped = new Feature(new MultiLineString(maps.observed.rings));
    mapped.setStyle([
      new Style({stroke: new Stroke({color: 'rgba(255,255,255,0.9)', width: 4.5})}),
      new Style({stroke: new Stroke({color: '#0a58ca', width: 2.2, lineDash: [9, 6]})}),
    ]);
    source.addFeature(mapped);
  }
  const left = leftValues ? cellShape(leftValues, maps.cells) : null;
  if (left) {
    left.setStyle(new Style({
      fill: hatchFill(), stroke: new Stroke({color: '#b3123f', width: 2}),
    }));
    source.addFeature(left);
  }
  return new VectorLayer({source, updateWhileInteracting: true});
}

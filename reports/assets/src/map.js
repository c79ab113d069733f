// SPDX-License-Identifier: Apache-2.0
// The map: hillshade, contours, one coloured plane of results, hover and click.
import {contours as d3Contours} from 'd3-contour';
import {defaults as defaultControls} from 'ol/control/defaults.js';
import FullScreen from 'ol/control/FullScreen.js';
import ScaleLine from 'ol/control/ScaleLine.js';
import {platformModifierKeyOnly} from 'ol/events/condition.js';
import Feature from 'ol/Feature.js';
import MultiLineString from 'ol/geom/MultiLineString.js';
import MultiPolygon from 'ol/geom/MultiPolygon.js';
import Polygon, {fromExtent} from 'ol/geom/Polygon.js';
import {defaults as defaultInteractions} from 'ol/interaction/defaults.js';
import DragPan from 'ol/interaction/DragPan.js';
import MouseWheelZoom from 'ol/interaction/MouseWheelZoom.js';
import ImageLayer from 'ol/layer/Image.js';
import VectorLayer from 'ol/layer/Vector.js';
import OlMap from 'ol/Map.js';
import Projection from 'ol/proj/Projection.js';
import ImageCanvas from 'ol/source/ImageCanvas.js';
import Static from 'ol/source/ImageStatic.js';
import VectorSource from 'ol/source/Vector.js';
import Fill from 'ol/style/Fill.js';
import Stroke from 'ol/style/Stroke.js';
import Style from 'ol/style/Style.js';
import Text from 'ol/style/Text.js';
import View from 'ol/View.js';

import {cellIndex, classOf, extentOf} from './data.js';

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

function contourFeatures(ground, heights) {
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
function contourStyle(feature) {
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

/** Four corners, as a picture: fonts need not have a sign for it. */
function wholeScreenSign() {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '0 0 12 12');
  svg.setAttribute('width', '12');
  const path = document.createElementNS(space, 'path');
  path.setAttribute('d', 'M1 4V1h3M8 1h3v3M11 8v3H8M4 11H1V8');
  path.setAttribute('fill', 'none');
  path.setAttribute('stroke', 'currentColor');
  path.setAttribute('stroke-width', '1.6');
  svg.append(path);
  return svg;
}

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
function marksLayer(maps, leftValues) {
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

/** One pixel per cell, in the legend's colours. */
function paint(canvas, legend, values) {
  const context = canvas.getContext('2d');
  const image = context.createImageData(canvas.width, canvas.height);
  const rgb = legend.classes.map((c) => Number.parseInt(c.colour.slice(1), 16));
  for (let i = 0; i < values.length; i++) {
    const k = classOf(legend, values[i]);
    if (k < 0) continue;
    image.data[4 * i] = rgb[k] >> 16;
    image.data[4 * i + 1] = (rgb[k] >> 8) & 255;
    image.data[4 * i + 2] = rgb[k] & 255;
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}

/**
 * @param {HTMLElement} target
 * @param {object} maps of the page's data; `heights` are the ground's, null when unknown;
 *   `leftValues` tell where mass left, null when it did nowhere
 * @param {{hover: Function, click: Function, plainWheel: Function}} on hover and click get the map
 *   coordinate, hover also null on leaving; plainWheel: the wheel turned without Ctrl
 */
export function createMap(target, maps, heights, leftValues, on) {
  const viewExtent = extentOf(maps.view);
  const projection = new Projection({
    code: 'sturz', units: 'm', extent: viewExtent, getPointResolution: (resolution) => resolution,
  });
  const shade = new ImageLayer({
    source: new Static({
      url: document.getElementById('hillshade').getAttribute('href'),
      imageExtent: viewExtent, projection,
    }),
  });

  const cells = document.createElement('canvas');
  cells.width = maps.cells.cols;
  cells.height = maps.cells.rows;
  const cellExtent = extentOf(maps.cells);
  const drawCells = (extent, resolution, ratio, size) => {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = size.map(Math.round);
    const context = canvas.getContext('2d');
    context.imageSmoothingEnabled = false;
    const scale = ratio / resolution;
    context.drawImage(cells, (cellExtent[0] - extent[0]) * scale,
                      (extent[3] - cellExtent[3]) * scale,
                      maps.cells.cols * maps.cells.cell * scale,
                      maps.cells.rows * maps.cells.cell * scale);
    return canvas;
  };
  const resultSource =
      new ImageCanvas({canvasFunction: drawCells, projection, ratio: 1.2, interpolate: false});
  const results = new ImageLayer({source: resultSource, opacity: 0.78});

  const lines = new VectorLayer({
    source: new VectorSource(), style: contourStyle, declutter: true, updateWhileInteracting: true,
  });
  const marker = new VectorLayer({
    source: new VectorSource(),
    style: [
      new Style({stroke: new Stroke({color: '#fff', width: 4})}),
      new Style({stroke: new Stroke({color: '#111', width: 1.8})}),
    ],
  });

  // One finger and the plain wheel scroll the page; two fingers, the mouse's drag and Ctrl with
  // the wheel move the map.
  target.style.aspectRatio = `${maps.view.cols} / ${maps.view.rows}`;
  const fingersOrMouse = function(event) {
    return event.originalEvent.pointerType === 'mouse' || this.getPointerCount() === 2;
  };
  const map = new OlMap({
    target,
    layers: [shade, results, lines, marksLayer(maps, leftValues), marker],
    controls: defaultControls({rotate: false, attribution: false}).extend([
      new ScaleLine({minWidth: 80}), new FullScreen({
        tipLabel: 'Whole screen', label: wholeScreenSign(), labelActive: wholeScreenSign(),
        source: 'map-app',
      }),
    ]),
    interactions: defaultInteractions({
      dragPan: false, mouseWheelZoom: false, altShiftDragRotate: false, pinchRotate: false,
    }).extend([
      new DragPan({condition: fingersOrMouse}),
      new MouseWheelZoom({
        condition: (event) => platformModifierKeyOnly(event) || document.fullscreenElement !== null,
      }),
    ]),
    view: new View({
      projection, extent: viewExtent, showFullExtent: true,
      minResolution: maps.cells.cell / 40, constrainResolution: false,
    }),
  });
  map.getView().fit(viewExtent, {padding: [0, 0, 0, 0]});

  target.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !event.metaKey && document.fullscreenElement === null) on.plainWheel();
  }, {passive: true});
  map.on('pointermove', (event) => {
    if (!event.dragging) on.hover(event.coordinate);
  });
  target.addEventListener('pointerleave', () => on.hover(null));
  map.on('singleclick', (event) => on.click(event.coordinate));

  if (heights)
    setTimeout(() => lines.getSource().addFeatures(contourFeatures(maps.ground, heights)), 30);

  return {
    map,
    show(legend, values) {
      paint(cells, legend, values);
      resultSource.changed();
    },
    setOpacity: (opacity) => results.setOpacity(opacity),
    setContours: (visible) => lines.setVisible(visible),
    mark(coordinate) {
      marker.getSource().clear();
      if (cellIndex(maps.cells, ...coordinate) < 0) return;
      const snap = (value, start, cell) => start + Math.floor((value - start) / cell) * cell;
      const west = snap(coordinate[0], maps.cells.west, maps.cells.cell);
      const south = snap(coordinate[1], maps.cells.north, maps.cells.cell);
      const extent = [west, south, west + maps.cells.cell, south + maps.cells.cell];
      marker.getSource().addFeature(new Feature(new Polygon(fromExtent(extent).getCoordinates())));
    },
  };
}

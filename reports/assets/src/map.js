// SPDX-License-Identifier: Apache-2.0
// The map: hillshade, contours, one or two coloured planes of results, hover and click.
import {defaults as defaultControls} from 'ol/control/defaults.js';
import FullScreen from 'ol/control/FullScreen.js';
import ScaleLine from 'ol/control/ScaleLine.js';
import {platformModifierKeyOnly} from 'ol/events/condition.js';
import Feature from 'ol/Feature.js';
import LineString from 'ol/geom/LineString.js';
import Point from 'ol/geom/Point.js';
import Polygon, {fromExtent} from 'ol/geom/Polygon.js';
import {defaults as defaultInteractions} from 'ol/interaction/defaults.js';
import DragPan from 'ol/interaction/DragPan.js';
import Draw from 'ol/interaction/Draw.js';
import MouseWheelZoom from 'ol/interaction/MouseWheelZoom.js';
import ImageLayer from 'ol/layer/Image.js';
import VectorLayer from 'ol/layer/Vector.js';
import OlMap from 'ol/Map.js';
import Projection from 'ol/proj/Projection.js';
import {getRenderPixel} from 'ol/render.js';
import ImageCanvas from 'ol/source/ImageCanvas.js';
import Static from 'ol/source/ImageStatic.js';
import VectorSource from 'ol/source/Vector.js';
import CircleStyle from 'ol/style/Circle.js';
import Fill from 'ol/style/Fill.js';
import Stroke from 'ol/style/Stroke.js';
import Style from 'ol/style/Style.js';
import View from 'ol/View.js';

import {contourFeatures, contourStyle} from './contours.js';
import {cellIndex, extentOf} from './data.js';
import {svgElement} from './dom.js';
import {marksLayer} from './marks.js';
import {overlayLayers} from './overlays.js';
import {paint} from './paint.js';
import {t} from './texts.js';

/** Four corners, as a picture: fonts need not have a sign for it. */
function wholeScreenSign() {
  const svg = svgElement('svg', {viewBox: '0 0 12 12', width: '12'});
  svg.append(svgElement('path', {d: 'M1 4V1h3M8 1h3v3M11 8v3H8M4 11H1V8', fill: 'none',
                                 stroke: 'currentColor', 'stroke-width': '1.6'}));
  return svg;
}

/** A layer of the result cells: {layer, show(legend, values)}. */
function cellsLayer(grid, projection) {
  const cells = document.createElement('canvas');
  cells.width = grid.cols;
  cells.height = grid.rows;
  const extentCells = extentOf(grid);
  const drawCells = (extent, resolution, ratio, size) => {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = size.map(Math.round);
    const context = canvas.getContext('2d');
    context.imageSmoothingEnabled = false;
    const scale = ratio / resolution;
    context.drawImage(cells, (extentCells[0] - extent[0]) * scale,
                      (extent[3] - extentCells[3]) * scale, grid.cols * grid.cell * scale,
                      grid.rows * grid.cell * scale);
    return canvas;
  };
  const source =
      new ImageCanvas({canvasFunction: drawCells, projection, ratio: 1.2, interpolate: false});
  return {
    layer: new ImageLayer({source, opacity: 0.78}),
    show(legend, values) {
      paint(cells, legend, values);
      source.changed();
    },
  };
}

/** Keeps a layer to the left or to the right of the share `at()` of the map's width. */
function clipTo(layer, map, side, at) {
  layer.on('prerender', (event) => {
    const share = at();
    const context = event.context;
    context.save();
    if (share === null) return;
    const [width, height] = map.getSize();
    const from = side === 'left' ? 0 : share * width;
    const to = side === 'left' ? share * width : width;
    const corners = [[from, 0], [to, 0], [to, height], [from, height]].map(
        (corner) => getRenderPixel(event, corner));
    context.beginPath();
    corners.forEach(([x, y], i) => i === 0 ? context.moveTo(x, y) : context.lineTo(x, y));
    context.closePath();
    context.clip();
  });
  layer.on('postrender', (event) => event.context.restore());
}

const halo = new Style({stroke: new Stroke({color: '#fff', width: 4})});
const ink = new Style({
  stroke: new Stroke({color: '#111', width: 1.8}),
  image: new CircleStyle({radius: 6, fill: new Fill({color: '#111'}),
                          stroke: new Stroke({color: '#fff', width: 2})}),
});

/** Lines are drawn by click and double click; on touch by taps. */
function drawing(map, source, done) {
  const draw = new Draw({source, type: 'LineString', style: [halo, ink]});
  draw.on('drawstart', () => source.clear());
  draw.on('drawend', (event) => done(event.feature.getGeometry().getCoordinates()));
  draw.setActive(false);
  map.addInteraction(draw);
  return draw;
}

/** Contours take a moment: the map is shown without them first. */
function addContours(layer, ground, heights) {
  if (heights)
    setTimeout(() => layer.getSource().addFeatures(contourFeatures(ground, heights)), 30);
}

function fingersOrMouse(event) {
  return event.originalEvent.pointerType === 'mouse' || this.getPointerCount() === 2;
}

/** At which the whole ground is seen, and a little around it. */
function widestResolution(target, [west, south, east, north]) {
  return 1.3 * Math.max((east - west) / Math.max(target.clientWidth, 100),
                        (north - south) / Math.max(target.clientHeight, 100));
}

/** The results with a margin, between the panels where there is room for them. */
function fitResults(map, cells) {
  const [west, south, east, north] = extentOf(cells);
  const margin = 0.06 * Math.max(east - west, north - south);
  const wide = map.getSize()[0] > 900;
  map.getView().fit([west - margin, south - margin, east + margin, north + margin],
                    {padding: wide ? [10, 60, 10, 240] : [6, 6, 6, 6]});
}

/**
 * @param {HTMLElement} target
 * @param {object} maps of the page's data; `heights` are the ground's, null when unknown;
 *   `leftValues` tell where mass left, null when it did nowhere
 * @param {object} on hover(coordinate or null), click(coordinate), plainWheel() (the wheel turned
 *   without Ctrl), line(coordinates) (a profile was drawn)
 */
export function createMap(target, maps, heights, leftValues, on) {
  const viewExtent = extentOf(maps.view);
  target.style.setProperty('--map-shape', `${maps.view.cols} / ${maps.view.rows}`);
  const projection = new Projection({
    code: 'sturz', units: 'm', extent: viewExtent, getPointResolution: (resolution) => resolution,
  });
  const shade = new ImageLayer({
    source: new Static({
      url: document.getElementById('hillshade').getAttribute('href'),
      imageExtent: viewExtent, projection,
    }),
  });
  const results = cellsLayer(maps.cells, projection);
  const beside = cellsLayer(maps.cells, projection);
  beside.layer.setVisible(false);
  const lines = new VectorLayer({
    source: new VectorSource(), style: contourStyle, declutter: true, updateWhileInteracting: true,
  });
  const marker = new VectorLayer({source: new VectorSource(), style: [halo, ink]});
  const track = new VectorLayer({source: new VectorSource(), style: [halo, ink]});
  const overlays = overlayLayers(maps, projection);

  const map = new OlMap({
    target,
    layers: [shade, ...overlays.below, results.layer, beside.layer, lines, ...overlays.above,
             marksLayer(maps, leftValues), track, marker],
    controls: defaultControls({
      rotate: false, attribution: false,
      zoomOptions: {zoomInTipLabel: t('zoom_in'), zoomOutTipLabel: t('zoom_out')},
    }).extend([
      new ScaleLine({minWidth: 80}), new FullScreen({
        tipLabel: t('whole_screen'), label: wholeScreenSign(), labelActive: wholeScreenSign(),
        source: 'map-app',
      }),
    ]),
    // One finger and the plain wheel scroll the page; two fingers, the mouse's drag and Ctrl with
    // the wheel move the map.
    interactions: defaultInteractions({
      dragPan: false, mouseWheelZoom: false, altShiftDragRotate: false, pinchRotate: false,
      doubleClickZoom: false,
    }).extend([
      new DragPan({condition: fingersOrMouse}),
      new MouseWheelZoom({
        condition: (event) => platformModifierKeyOnly(event) || document.fullscreenElement !== null,
      }),
    ]),
    view: new View({
      projection, extent: viewExtent, constrainOnlyCenter: true,
      minResolution: maps.cells.cell / 40, maxResolution: widestResolution(target, viewExtent),
      constrainResolution: false,
    }),
  });
  fitResults(map, maps.cells);

  let share = null;
  clipTo(results.layer, map, 'left', () => share);
  clipTo(beside.layer, map, 'right', () => share);
  const draw = drawing(map, track.getSource(), (coordinates) => on.line(coordinates));

  target.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !event.metaKey && document.fullscreenElement === null) on.plainWheel();
  }, {passive: true});
  map.on('pointermove', (event) => {
    if (!event.dragging) on.hover(event.coordinate);
  });
  target.addEventListener('pointerleave', () => on.hover(null));
  map.on('singleclick', (event) => {
    if (!draw.getActive()) on.click(event.coordinate);
  });
  // The keyboard reads the cell in the middle; arrows and +/- move the map below it.
  target.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter') return;
    on.hover(map.getView().getCenter());
    on.click(map.getView().getCenter());
  });
  addContours(lines, maps.ground, heights);

  const snap = (value, start, cell) => start + Math.floor((value - start) / cell) * cell;
  return {
    map,
    show: results.show,
    showBeside: beside.show,
    overlays,
    setOpacity(opacity) {
      results.layer.setOpacity(opacity);
      beside.layer.setOpacity(opacity);
    },
    setContours: (visible) => lines.setVisible(visible),
    /** Share of the width left of which the first plane is seen; null: everywhere. */
    setSwipe(next) {
      share = next;
      beside.layer.setVisible(next !== null);
      map.render();
    },
    setDrawing(active) {
      draw.setActive(active);
      if (!active) track.getSource().clear();
    },
    showLine(coordinates) {
      track.getSource().clear();
      track.getSource().addFeature(new Feature(new LineString(coordinates)));
    },
    point(coordinate) {
      marker.getSource().clear();
      if (coordinate) marker.getSource().addFeature(new Feature(new Point(coordinate)));
    },
    mark(coordinate) {
      marker.getSource().clear();
      if (cellIndex(maps.cells, ...coordinate) < 0) return;
      const west = snap(coordinate[0], maps.cells.west, maps.cells.cell);
      const south = snap(coordinate[1], maps.cells.north, maps.cells.cell);
      const extent = [west, south, west + maps.cells.cell, south + maps.cells.cell];
      marker.getSource().addFeature(new Feature(new Polygon(fromExtent(extent).getCoordinates())));
    },
  };
}

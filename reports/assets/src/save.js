// SPDX-License-Identifier: Apache-2.0
// What is seen, as a picture and as numbers.
import {getIntersection, isEmpty} from 'ol/extent.js';

import {isClear} from './data.js';
import {element, saveAs} from './dom.js';
import {t} from './texts.js';

const font = 'system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';
const side = 250;  // CSS pixels beside the map for the legend
const margin = 14;
const mostClasses = 12;

/** The map's canvases on one, with their opacities. */
function drawMap(context, map, scale) {
  for (const canvas of map.getViewport().querySelectorAll('.ol-layer canvas, canvas.ol-layer')) {
    if (canvas.width === 0) continue;
    context.save();
    context.globalAlpha = Number(canvas.parentNode.style.opacity || canvas.style.opacity || 1);
    const matrix = canvas.style.transform.match(/^matrix\(([^)]*)\)$/)?.[1].split(',').map(Number);
    const own = matrix ?? [canvas.clientWidth / canvas.width, 0, 0, canvas.clientHeight / canvas.height, 0, 0];
    context.transform(scale * own[0], scale * own[1], scale * own[2], scale * own[3],
                      scale * own[4], scale * own[5]);
    context.drawImage(canvas, 0, 0);
    context.restore();
  }
}

/** Text in lines of at most `width`; returns the height below the last one. */
function wrapped(context, text, x, y, width, height) {
  let line = '';
  for (const word of text.split(' ')) {
    if (line !== '' && context.measureText(`${line} ${word}`).width > width) {
      context.fillText(line, x, y);
      y += height;
      line = word;
    } else {
      line = line === '' ? word : `${line} ${word}`;
    }
  }
  context.fillText(line, x, y);
  return y + height;
}

function drawScale(context, map, x, y) {
  const resolution = map.getView().getResolution();
  const longest = 150 * resolution;
  const power = 10 ** Math.floor(Math.log10(longest));
  const length = [5, 2, 1].map((s) => s * power).find((s) => s <= longest);
  const width = length / resolution;
  context.strokeStyle = '#111';
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(x, y - 6);
  context.lineTo(x, y);
  context.lineTo(x + width, y);
  context.lineTo(x + width, y - 6);
  context.stroke();
  context.fillText(length >= 1000 ? `${length / 1000} km` : `${length} m`, x + width + 8, y);
}

function drawNorth(context, x, y) {
  context.beginPath();
  for (const [dx, dy] of [[0, 0], [7, 22], [0, 17], [-7, 22]]) context.lineTo(x + dx, y + dy);
  context.closePath();
  context.fillStyle = '#111';
  context.fill();
  context.font = `700 12px ${font}`;
  context.textAlign = 'center';
  context.fillText('N', x, y + 35);
  context.textAlign = 'left';
}

/** Swatches as the map draws the marks. */
function drawMark(context, {kind, colour: own, dash}, x, y) {
  const colour = own ?? {release: '#111', observed: '#0a58ca', nearest: '#7b1fa2', left: '#b3123f',
                  'front-grains': '#7a3b00', 'front-liquid': '#00798c'}[kind] ?? '#111';
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.setLineDash(kind === 'observed' || dash ? [5, 3] : []);
  if (kind.startsWith('front') || kind === 'overlay') {
    context.beginPath();
    context.moveTo(x, y + 7);
    context.lineTo(x + 24, y + 7);
    context.stroke();
  } else {
    context.strokeRect(x + 1, y + 1, 22, 12);
  }
  context.setLineDash([]);
}

/** A legend from (x, y) down; returns where it ends. */
function drawClasses(context, legend, x, y) {
  context.font = `600 12px ${font}`;
  y = wrapped(context, legend.title, x, y, side, 16) + 2;
  context.font = `12px ${font}`;
  for (const c of legend.classes.slice(0, mostClasses)) {
    context.fillStyle = c.colour;
    context.fillRect(x, y - 11, 24, 14);
    context.fillStyle = '#111';
    context.fillText(c.label, x + 32, y);
    y += 18;
  }
  if (legend.classes.length > mostClasses) {
    context.fillText(t('in_all', legend.classes.length), x + 32, y);
    y += 18;
  }
  return y;
}

/** @param {object} seen {view, title, legend, marks, scene, system, beside: {title, legend} or null} */
export function composePicture(seen) {
  const {map} = seen.view;
  map.renderSync();
  const [width, height] = map.getSize();
  const scale = Math.max(2, devicePixelRatio);
  const canvas = element('canvas');
  canvas.width = scale * (width + side + 3 * margin);
  canvas.height = scale * (Math.max(height, 420) + 2 * margin);
  const context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.save();
  context.translate(scale * margin, scale * margin);
  context.beginPath();
  context.rect(0, 0, scale * width, scale * height);
  context.clip();
  context.fillStyle = '#eceeec';
  context.fillRect(0, 0, scale * width, scale * height);
  drawMap(context, map, scale);
  context.restore();

  context.scale(scale, scale);
  context.strokeStyle = '#5b6770';
  context.strokeRect(margin, margin, width, height);
  drawNorth(context, margin + width - 20, margin + 10);
  const x = width + 2 * margin;
  context.fillStyle = '#111';
  context.font = `600 15px ${font}`;
  let y = wrapped(context, seen.scene, x, margin + 14, side, 19) + 4;
  context.font = `13px ${font}`;
  y = wrapped(context, seen.title, x, y, side, 17) + 6;
  y = drawClasses(context, seen.legend, x, y);
  if (seen.beside) {
    context.font = `13px ${font}`;
    y = wrapped(context, `${t('swipe_right')}: ${seen.beside.title}`, x, y + 6, side, 17) + 6;
    y = drawClasses(context, seen.beside.legend, x, y);
  }
  y += 6;
  for (const mark of seen.marks) {
    drawMark(context, mark, x, y - 11);
    context.fillStyle = '#111';
    y = wrapped(context, mark.label, x + 32, y, side - 32, 16) + 4;
  }
  y += 8;
  drawScale(context, map, x, y + 4);
  context.fillText(seen.system, x, y + 24);
  return canvas;
}

const round = (v) => Number(v.toPrecision(6));

const asWord = (text) => text.replaceAll('²', '2').replaceAll('³', '3').replaceAll(/[^\w.]+/g, '_');

/** What a plane is called in names of files and heads of columns: its layer, its threshold or
 *  quantile where the layer has several, and which end of the interval it is ('value': none). */
export function nameOf({layer, plane}, bound) {
  const level = layer.planes.length > 1 && plane.axis !== undefined
      ? `_${round(plane.axis)}${layer.axisUnit}` : '';
  const end = bound === 'value' || !layer.legend.probability || layer.legend.diverging ? '' : `_${bound}`;
  return asWord(layer.name + level + end);
}

/** The same with the unit of its shown numbers behind it. */
export const columnOf = (name, legend) => asWord(legend.unit ? `${name}_${legend.unit}` : name);

/** Cells of the seen part of the map that hold a value: x, y of their middles, value as shown. */
export function cellsAsCsv(grid, extent, legend, values, name) {
  const rows = [`x_m,y_m,${columnOf(name, legend)}`];
  for (let i = 0; i < values.length; i++) {
    const v = values[i];
    if (isClear(legend, v)) continue;
    const x = grid.west + (i % grid.cols + 0.5) * grid.cell;
    const y = grid.north - (Math.floor(i / grid.cols) + 0.5) * grid.cell;
    if (x < extent[0] || x > extent[2] || y < extent[1] || y > extent[3]) continue;
    rows.push(`${x},${y},${round(v * legend.unitFactor)}`);
  }
  return `${rows.join('\n')}\n`;
}

/** Buttons that save picture and numbers of `seen()`. */
export function saveTools(seen, grid) {
  const png = element('button', {type: 'button', id: 'save-png', class: 'tool'}, t('save_png'));
  png.addEventListener('click', () => {
    const {name} = seen();
    composePicture(seen()).toBlob((blob) => saveAs(`${name}.png`, blob), 'image/png');
  });
  const csv = element('button', {type: 'button', id: 'save-csv', class: 'tool'}, t('save_csv'));
  csv.addEventListener('click', () => {
    const {view, name, legend, values} = seen();
    const extent = view.map.getView().calculateExtent(view.map.getSize());
    saveAs(`${name}.csv`,
           new Blob([cellsAsCsv(grid, extent, legend, values, name)], {type: 'text/csv'}));
  });
  return [png, csv];
}

const sheet = [640, 760];  // CSS pixels of the map on a printed sheet

/** Draws what is seen of the ground in the shape of a sheet, whatever shape the screen has. */
function composeSheet(seen, ground) {
  const {map} = seen.view;
  const view = map.getView();
  const [size, centre, resolution] = [map.getSize(), view.getCenter(), view.getResolution()];
  const shown = getIntersection(view.calculateExtent(size), ground);
  map.setSize(sheet);
  if (!isEmpty(shown)) view.fit(shown, {size: sheet});
  const canvas = composePicture(seen);
  map.setSize(size);
  view.setCenter(centre);
  view.setResolution(resolution);
  map.renderSync();
  return canvas;
}

/** What is printed is what is seen, where that is no longer what the page opened with. */
export function printWhatIsSeen(seen, isFirst, ground) {
  const figure = document.getElementById('seen-map');
  if (!figure) return;
  addEventListener('beforeprint', () => {
    figure.hidden = isFirst();
    document.documentElement.classList.toggle('print-seen', !isFirst());
    if (isFirst()) return;
    const what = seen();
    const canvas = composeSheet(what, ground);
    const caption = what.beside ? `${what.title} | ${what.beside.title}` : what.title;
    figure.replaceChildren(element('figcaption', {}, caption),
                           element('img', {src: canvas.toDataURL('image/png'), alt: caption}));
  });
}


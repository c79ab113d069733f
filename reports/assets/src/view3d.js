// SPDX-License-Identifier: Apache-2.0
// The map on its ground in 3-D, and a member's thickness over time on it. The drawing code lies
// packed in the page until it is asked for.
import {extentOf, inflate, numberText, unpack} from './data.js';
import {element, toggle} from './dom.js';
import {legendList} from './legend.js';
import {paint} from './paint.js';
import {t} from './texts.js';

const picturePixels = 2048;
const frameMilliseconds = 160;

async function loadDrawing() {
  if (globalThis.sturzView3d) return globalThis.sturzView3d;
  const packed = document.getElementById('sturz-view3d').textContent.trim();
  const script = element('script');
  script.textContent = new TextDecoder().decode(await inflate(packed));
  document.head.append(script);  // the page's policy knows its hash
  return globalThis.sturzView3d;
}

/** Release, observed event and front, as the map has them. */
function drawOutlines(context, maps, place) {
  const runs = (lines) => lines.map(([x0, y0, x1, y1]) => [[x0, y0], [x1, y1]]);
  const kinds = [
    ['#111', runs(maps.release)], ['#0a58ca', maps.observed?.rings ?? []],
    ['#7b1fa2', runs(maps.nearest?.lines ?? [])],
  ];
  for (const [colour, lines] of kinds)
    for (const [stroke, width] of [['rgba(255,255,255,0.9)', 7], [colour, 3.5]]) {
      context.strokeStyle = stroke;
      context.lineWidth = width;
      context.beginPath();
      for (const line of lines)
        line.map(place).forEach(([x, y], i) => i === 0 ? context.moveTo(x, y) : context.lineTo(x, y));
      context.stroke();
    }
}

/** Relief and the colours of one plane, as large as a texture may well be. */
function createPicture(maps) {
  const {cols, rows} = maps.ground.grid;
  const scale = Math.min(picturePixels / Math.max(cols, rows), 8);
  const canvas = element('canvas');
  canvas.width = Math.round(scale * cols);
  canvas.height = Math.round(scale * rows);
  const context = canvas.getContext('2d');
  const shade = new Image();
  const ready = new Promise((resolve) => {
    shade.onload = resolve;
    shade.src = document.getElementById('hillshade').getAttribute('href');
  });
  const view = extentOf(maps.ground.grid);
  const cells = element('canvas');
  return {
    canvas, ready,
    draw(grid, legend, values) {
      cells.width = grid.cols;
      cells.height = grid.rows;
      paint(cells, legend, values);
      context.globalAlpha = 1;
      context.drawImage(shade, 0, 0, canvas.width, canvas.height);
      context.globalAlpha = 0.78;
      context.imageSmoothingEnabled = false;
      const perMetre = canvas.width / (view[2] - view[0]);
      context.drawImage(cells, (grid.west - view[0]) * perMetre, (view[3] - grid.north) * perMetre,
                        grid.cols * grid.cell * perMetre, grid.rows * grid.cell * perMetre);
      context.globalAlpha = 1;
      drawOutlines(context, maps, ([x, y]) => [(x - view[0]) * perMetre, (view[3] - y) * perMetre]);
    },
  };
}

/** Slider, button and time of a member's frames; `show(k)` draws one. */
function createPlayer(frames, show) {
  const last = frames.times.length - 1;
  const slider = element('input', {type: 'range', min: '0', max: String(last), value: '0',
                                   id: 'frame', 'aria-label': t('frame_time')});
  const time = element('output', {class: 'frame-time'});
  const play = element('button', {type: 'button', id: 'play', class: 'tool'}, t('play'));
  let timer = 0;
  const go = (k) => {
    slider.value = String(k);
    time.textContent = `${numberText(frames.times[k])} s`;
    show(k);
  };
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    play.textContent = t('play');
  };
  play.addEventListener('click', () => {
    if (timer) {
      stop();
      return;
    }
    play.textContent = t('pause');
    if (Number(slider.value) === last) go(0);
    timer = setInterval(() => {
      if (Number(slider.value) === last) stop();
      else go(Number(slider.value) + 1);
    }, frameMilliseconds);
  });
  slider.addEventListener('input', () => {
    stop();
    go(Number(slider.value));
  });
  const box = element('div', {class: 'player'}, play, slider, time,
                      element('span', {class: 'note'}, frames.label));
  return {box, go, stop};
}

/** @returns {{button, redraw} | null} null where the page holds no ground or no drawing code */
export function view3dTool(stage, page, heights, current) {
  const {maps, frames} = page;
  if (!heights || !document.getElementById('sturz-view3d')) return null;
  const box = element('div', {class: 'solid', id: 'view3d', tabindex: '0', 'aria-label': t('solid_label')});
  box.hidden = true;
  stage.append(box);
  let drawing = null;
  let picture = null;
  let player = null;

  const area = stage.parentNode;
  const redraw = () => {
    if (!drawing) return;
    player?.stop();
    area.classList.remove('is-playing');
    const {layer, values} = current();
    picture.draw(maps.cells, layer.legend, values);
    drawing.update();
  };
  const addPlayer = async () => {
    const planes = await Promise.all(frames.planes.map((p) => unpack(p, frames.grid.cols)));
    player = createPlayer(frames, (k) => {
      area.classList.add('is-playing');  // the map's own legend is not that of the frames
      picture.draw(frames.grid, frames.legend, planes[k]);
      drawing.update();
    });
    const legend = element('div', {class: 'frame-legend'},
                           element('p', {class: 'legend-title'},
                                   `${frames.legend.title}, ${frames.label}`),
                           legendList(frames.legend));
    box.append(player.box, legend);
  };
  const start = async () => {
    try {
      const code = await loadDrawing();
      picture ??= createPicture(maps);
      await picture.ready;
      picture.draw(maps.cells, current().layer.legend, current().values);
      drawing = code.create(box, maps.ground.grid, heights, picture.canvas);
      if (frames) await addPlayer();
    } catch (error) {
      box.replaceChildren(element('p', {class: 'note'}, t('no_solid', error.message)));
    }
  };
  const {button} = toggle('tool-3d', t('solid'), (on) => {
    box.hidden = !on;
    stage.classList.toggle('is-solid', on);
    area.classList.remove('is-playing');
    if (on) {
      start();
      return;
    }
    player?.stop();
    drawing?.dispose();
    drawing = null;
    player = null;
    box.replaceChildren();
  });
  return {button, redraw};
}

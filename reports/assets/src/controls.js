// SPDX-License-Identifier: Apache-2.0
// The map's panel: which quantity, which statistic, which threshold; legend, hover, opacity.
import {createCellPanel} from './cell.js';
import {cellIndex, classOf, numberText, percentText, unpack, valueText, wilson} from './data.js';
import {createMap} from './map.js';
import {loadSources} from './sources.js';

const statisticNames = {
  probability: 'Probability', quantile: 'Quantile', source_quantile: 'Quantile of the worst source', mean: 'Mean', peak: 'Peak', value: 'Value',
};
const materialNames = {'': 'Whole flow', grains: 'Grains alone', liquid: 'Liquid alone'};
const boundNames = {lower: 'lower end', upper: 'upper end'};
const capital = (text) => text[0].toUpperCase() + text.slice(1);

export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

/** A row of buttons of which one is pressed; `entries` are {key, label, title, flag}. */
function chips(label, entries, active, pick) {
  const row = element('div', {class: 'chips', role: 'group', 'aria-label': label});
  for (const entry of entries) {
    const chip = element('button', {
      type: 'button', 'aria-pressed': String(entry.key === active), 'data-key': entry.key,
    }, entry.label);
    if (entry.title) chip.title = entry.title;
    if (entry.flag) chip.append(element('span', {class: 'flag'}, entry.flag));
    chip.addEventListener('click', () => pick(entry.key));
    row.append(chip);
  }
  return row;
}

/** The map is never turned: north is up. */
function northArrow() {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  for (const [name, value] of Object.entries(
           {viewBox: '0 0 24 36', width: '24', height: '36', class: 'north', role: 'img',
            'aria-label': 'North is up'}))
    svg.setAttribute(name, value);
  const part = (tag, attributes, text = '') => {
    const node = document.createElementNS(space, tag);
    for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
    node.textContent = text;
    svg.append(node);
  };
  part('path', {d: 'M12 1 19 23 12 18 5 23Z', fill: '#111', stroke: '#fff', 'stroke-width': '1.2'});
  part('text', {x: '12', y: '34', 'text-anchor': 'middle', 'font-size': '11', 'font-weight': '700',
                fill: '#111', stroke: '#fff', 'stroke-width': '2.4', 'paint-order': 'stroke'}, 'N');
  return svg;
}

/** All planes of a page as {layer, plane, values}, unpacked. */
async function loadPlanes(maps) {
  const jobs = [];
  for (const layer of maps.layers)
    for (const plane of layer.planes)
      jobs.push(unpack(plane, maps.cells.cols).then((values) => ({layer, plane, values})));
  return Promise.all(jobs);
}

export async function startMaps(page) {
  const maps = page.maps;
  const planes = await loadPlanes(maps);
  const sources = await loadSources(page.region, maps.cells.cols);
  const heights = maps.ground ? await unpack(maps.ground, maps.ground.grid.cols) : null;
  const app = document.getElementById('map-app');
  app.hidden = false;

  const pickers = element('div', {class: 'pickers'});
  const title = element('h3', {class: 'map-title'});
  const target = element('div', {id: 'map', class: 'map', tabindex: '0', 'aria-label': 'Map'});
  const hover = element('div', {class: 'hover', 'aria-live': 'off'});
  const wheelHint = element('div', {class: 'wheel-hint'}, 'Ctrl and the wheel zoom the map');
  wheelHint.hidden = true;
  const legendBox = element('div', {class: 'legend-box'});
  const comment = element('p', {class: 'note map-comment'});
  const cellBox = element('div', {class: 'cell-box'});
  const opacity = element('input', {
    type: 'range', min: '0', max: '100', value: '78', id: 'pick-opacity',
  });
  const contours = element('input', {type: 'checkbox', id: 'pick-contours'});
  contours.checked = true;
  const switches = element(
      'div', {class: 'switches'}, element('label', {for: 'pick-opacity'}, 'Opacity', opacity));
  if (heights)
    switches.append(element('label', {for: 'pick-contours'}, contours, 'Contours'));
  app.append(
      pickers,
      element('div', {class: 'map-grid'},
              element('div', {class: 'map-column'}, title,
                      element('div', {class: 'map-box'}, target, northArrow(), hover, wheelHint), comment),
              element('aside', {class: 'map-side'}, legendBox, switches, cellBox)));

  const cellPanel = createCellPanel(cellBox, page, planes, sources);
  const reached = planes.find((p) => p.layer.quantity === 'reached');
  let current = planes.find((p) => p.layer === maps.layers[maps.start]);
  let bound = 'value';

  const groundHeight = ([x, y]) => {
    const at = heights ? cellIndex(maps.ground.grid, x, y) : -1;
    return at < 0 ? NaN : heights[at];
  };
  const showHover = (coordinate) => {
    hover.replaceChildren();
    hover.hidden = coordinate === null;
    for (const item of legendBox.querySelectorAll('.on')) item.classList.remove('on');
    if (coordinate === null) return;
    const [x, y] = coordinate;
    const at = cellIndex(maps.cells, x, y);
    const value = at < 0 ? NaN : current.values[at];
    const legend = current.layer.legend;
    let text = at < 0 ? '–' : valueText(legend, value);
    if (legend.probability && value >= 0 && page.valid > 0) {
      const [low, high] = wilson(value, page.valid, page.z);
      text += ` (${percentText(low)} – ${percentText(high)})`;
    }
    if (at < 0 || (reached && !(reached.values[at] > 0))) text = 'not reached';
    hover.append(element('b', {}, text), ` x ${Math.round(x)} y ${Math.round(y)}`);
    const z = groundHeight(coordinate);
    if (Number.isFinite(z)) hover.append(` · ground ${numberText(Math.round(z))} m`);
    if (sources) {
      const list = sources.at(at);
      const shown = list.slice(0, 3).map(({name, p}) => `${name} ${percentText(p)}`);
      if (list.length > 3) shown.push(`${list.length} sources in all`);
      if (list.length > 0) hover.append(element('span', {class: 'hover-sources'}, shown.join(' · ')));
    }
    const k = at < 0 ? -1 : classOf(legend, value);
    if (k >= 0) legendBox.querySelector(`[data-class="${k}"]`)?.classList.add('on');
  };
  const left = planes.find((p) => p.layer.quantity === 'left') ?? null;
  let hintTimer = 0;
  const view = createMap(target, maps, heights, left?.values ?? null, {
    hover: showHover,
    plainWheel() {
      wheelHint.hidden = false;
      clearTimeout(hintTimer);
      hintTimer = setTimeout(() => { wheelHint.hidden = true; }, 1500);
    },
    click(coordinate) {
      const at = cellIndex(maps.cells, ...coordinate);
      view.mark(coordinate);
      cellPanel.show(at, coordinate, groundHeight(coordinate));
    },
  });
  hover.hidden = true;

  const drawLegend = (legend) => {
    const list = element('ul', {class: 'legend'});
    const listed = legend.nominal ? legend.classes.slice(0, 12) : legend.classes;
    listed.forEach((c, k) => {
      const swatch = element('span', {class: 'swatch'});
      swatch.style.background = c.colour;
      list.append(element('li', {'data-class': k}, swatch, c.label));
    });
    if (listed.length < legend.classes.length)
      list.append(element('li', {}, `… ${legend.classes.length} in all`));
    const marks = element('ul', {class: 'legend marks'});
    if (maps.release.length > 0)
      marks.append(element('li', {}, element('span', {class: 'swatch release'}), 'release'));
    if (maps.observed)
      marks.append(element('li', {}, element('span', {class: 'swatch observed'}),
                           maps.observed.label));
    if (maps.nearest)
      marks.append(element('li', {}, element('span', {class: 'swatch nearest'}),
                           maps.nearest.label));
    for (const front of maps.fronts)
      marks.append(element('li', {}, element('span', {class: `swatch front-${front.kind}`}),
                           front.label));
    if (left?.values.some((v) => v > 0))
      marks.append(element('li', {}, element('span', {class: 'swatch left'}),
                           'mass left the terrain here'));
    legendBox.replaceChildren(element('p', {class: 'legend-title'}, legend.title), list, marks);
  };

  const show = (next) => {
    current = next;
    const {layer, plane} = current;
    const shown = boundOf(current, bound);
    title.textContent = bound === 'value' || !layer.legend.probability
        ? plane.title : `${plane.title}: ${boundNames[bound]} of its 95 % interval`;
    comment.textContent = layer.comment ? `${capital(layer.comment)}.` : '';
    drawLegend(layer.legend);
    view.show(layer.legend, shown);
    cellPanel.follow(layer.quantity, layer.material);
    drawPickers();
  };

  /** A plane's probabilities, or one end of their interval where the flow came at all. */
  const boundOf = ({layer, values}, which) => {
    if (which === 'value' || !layer.legend.probability || !(page.valid > 0)) return values;
    const end = which === 'lower' ? 0 : 1;
    return values.map(
        (p, i) => reached && !(reached.values[i] > 0) ? p : wilson(p, page.valid, page.z)[end]);
  };

  /** Goes to a quantity and statistic; keeps what was chosen where it exists there. */
  const go = (quantity, statistic) => {
    const same = planes.filter((p) => p.layer.quantity === quantity);
    const wanted = same.filter((p) => p.layer.statistic === statistic);
    const from = wanted.length > 0 ? wanted : same.filter((p) => p.layer === same[0].layer);
    const kept = from.find((p) => p.plane.label === current.plane.label);
    const middle = from.find((p) => p.plane.label === 'median');
    show(kept ?? middle ?? from.find((p) => p.plane.resolved !== false) ?? from[0]);
  };

  const materials = [...new Set(planes.map((p) => p.layer.material))];
  /** Goes to another material, to the same quantity where it has that. */
  const goMaterial = (material) => {
    const own = planes.filter((p) => p.layer.material === material);
    const same = own.find((p) => p.layer.short === current.layer.short) ?? own[0];
    go(same.layer.quantity, current.layer.statistic);
  };

  const drawPickers = () => {
    const {quantity, statistic, material} = current.layer;
    const focused = document.activeElement?.dataset?.key;
    const own = planes.filter((p) => p.layer.material === material);
    const quantities = [...new Set(own.map((p) => p.layer.quantity))];
    const same = planes.filter((p) => p.layer.quantity === quantity);
    const statistics = [...new Set(same.map((p) => p.layer.statistic))];
    const choices = same.filter((p) => p.layer.statistic === statistic);
    const rows = [chips(
        'Quantity',
        quantities.map((key) => {
          const {short, quantityTitle} = own.find((p) => p.layer.quantity === key).layer;
          return {key, label: short, title: quantityTitle};
        }),
        quantity, (key) => go(key, statistic))];
    if (materials.length > 1)
      rows.unshift(chips(
          'Material',
          materials.map((key) => ({key: `material-${key}`, label: materialNames[key]})),
          `material-${material}`, (key) => goMaterial(key.slice('material-'.length))));
    if (statistics.length > 1)
      rows.push(chips(
          'Statistic', statistics.map((key) => ({key, label: statisticNames[key] ?? key})),
          statistic, (key) => go(quantity, key)));
    if (choices.length > 1)
      rows.push(chips(
          'Level',
          choices.map((p, k) => ({
                        key: `level-${k}`, label: p.plane.label,
                        flag: p.plane.resolved === false ? 'not resolved' : '',
                      })),
          `level-${choices.indexOf(current)}`, (key) => show(choices[Number(key.slice(6))])));
    if (current.layer.legend.probability && page.valid > 0)
      rows.push(chips(
          'End of the interval',
          [{key: 'value', label: 'Share'}, {key: 'lower', label: '95 % lower'},
           {key: 'upper', label: '95 % upper'}],
          bound, (key) => {
            bound = key;
            show(current);
          }));
    pickers.replaceChildren(...rows);
    if (focused) pickers.querySelector(`[data-key="${focused}"]`)?.focus();
  };

  opacity.addEventListener('input', () => view.setOpacity(Number(opacity.value) / 100));
  contours.addEventListener('change', () => view.setContours(contours.checked));
  show(current);
}

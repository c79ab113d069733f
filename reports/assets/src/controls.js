// SPDX-License-Identifier: Apache-2.0
// The map's panel: which quantity, which statistic, which threshold; legend, hover, tools.
import {createCellPanel} from './cell.js';
import {cellIndex, classOf, extentOf, numberText, percentText, unpack, valueText, wilson} from './data.js';
import {chips, element, northArrow} from './dom.js';
import {drawLegend, marksOf} from './legend.js';
import {createMap} from './map.js';
import {profileTool} from './profile.js';
import {nameOf, printWhatIsSeen, saveTools} from './save.js';
import {loadSources} from './sources.js';
import {swipeTool} from './swipe.js';
import {t} from './texts.js';
import {view3dTool} from './view3d.js';

const capital = (text) => text[0].toUpperCase() + text.slice(1);

const nothingYet = new Float32Array(0);

/** Whether values are shares with a Wilson interval; a difference of two shares has none. */
const hasEnds = ({legend}) => legend.probability && !legend.diverging;

/** All planes of a page as {layer, plane, values, ready}; values come one by one. */
function loadPlanes(maps, beside) {
  const entries = [];
  const add = (layers, ofB) => {
    for (const layer of layers)
      for (const plane of layer.planes) entries.push({layer, plane, ofB, values: nothingYet, ready: null});
  };
  add(maps.layers, false);
  if (beside) add(beside.layers, true);
  const load = (entry) => {
    entry.ready ??= unpack(entry.plane, maps.cells.cols).then((values) => { entry.values = values; });
    return entry.ready;
  };
  return {entries, load};
}

/** Opacity, contours, overlays: what is drawn how. */
function switchesOf(view, maps, heights) {
  const opacity = element('input', {type: 'range', min: '0', max: '100', value: '78', id: 'pick-opacity'});
  opacity.addEventListener('input', () => view.setOpacity(Number(opacity.value) / 100));
  const box = element('div', {class: 'switches'},
                      element('label', {for: 'pick-opacity'}, t('opacity'), opacity));
  const check = (id, label, on, change) => {
    const input = element('input', {type: 'checkbox', id});
    input.checked = on;
    input.addEventListener('change', () => change(input.checked));
    box.append(element('label', {for: id}, input, label));
  };
  if (heights) check('pick-contours', t('contours'), true, view.setContours);
  view.overlays.named.forEach(({name, layer, look}, k) => {
    const swatch = element('span', {class: 'swatch line'});
    swatch.style.borderColor = look.colour;
    if (look.dash) swatch.style.borderTopStyle = 'dashed';
    check(`pick-overlay-${k}`, element('span', {}, swatch, ' ', name), true,
          (on) => layer.setVisible(on));
  });
  if (view.overlays.photo)
    check('pick-photo', t('orthophoto'), false, (on) => view.overlays.photo.setVisible(on));
  return box;
}

/** The elements of the panel, put into the page. */
function buildApp() {
  const app = document.getElementById('map-app');
  app.hidden = false;
  const parts = {
    app,
    pickers: element('div', {class: 'pickers'}),
    title: element('h3', {class: 'map-title'}),
    tools: element('div', {class: 'tools', role: 'group', 'aria-label': t('tools')}),
    target: element('div', {id: 'map', class: 'map', tabindex: '0', 'aria-label': t('map_label')}),
    hover: element('div', {class: 'hover', 'aria-live': 'off'}),
    wheelHint: element('div', {class: 'wheel-hint'}, t('wheel_hint')),
    legendBox: element('div', {class: 'legend-box'}),
    panel: element('div', {class: 'map-panel'}),
    comment: element('p', {class: 'note map-comment'}),
    cellBox: element('div', {class: 'cell-box'}),
  };
  parts.wheelHint.hidden = parts.hover.hidden = true;
  parts.panel.append(parts.legendBox);
  parts.stage = element('div', {class: 'map-stage'}, parts.target, northArrow(),
                        element('span', {class: 'cross-hair', 'aria-hidden': 'true'}),
                        parts.hover, parts.wheelHint);
  app.append(parts.pickers,
             element('div', {class: 'map-head'}, parts.title, parts.tools),
             element('div', {class: 'map-area'}, parts.stage, parts.panel, parts.cellBox),
             parts.comment);
  return parts;
}

export async function startMaps(page) {
  const maps = page.maps;
  const {entries, load} = loadPlanes(maps, page.beside);
  const planes = entries.filter((p) => !p.ofB);
  const reachedB = entries.find((p) => p.ofB && p.layer.quantity === 'reached');
  const first = planes.find((p) => p.layer === maps.layers[maps.start]);
  // What the first map needs comes first; the others follow while it is looked at.
  const wanted = entries.filter(
      (p) => p === first || ['reached', 'left'].includes(p.layer.quantity));
  await Promise.all(wanted.map(load));
  const sources = await loadSources(page.region, maps.cells.cols);
  const heights = maps.ground ? await unpack(maps.ground, maps.ground.grid.cols) : null;
  const parts = buildApp();
  const {pickers, title, hover, wheelHint, legendBox, comment} = parts;

  const cellPanel = createCellPanel(parts.cellBox, page, planes, sources,
                                    () => view.point(null));
  const reached = planes.find((p) => p.layer.quantity === 'reached');
  let current = first;
  let bound = 'value';
  let seenValues = current.values;  // or one end of their interval

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
    let text = at < 0 ? '–' : valueText(legend, seenValues[at]);
    if (bound === 'value' && hasEnds(current.layer) && value >= 0 && page.trials > 0) {
      const [low, high] = wilson(value, page.trials, page.z);
      text += ` (${percentText(low)} – ${percentText(high)})`;
    }
    // Where A did not come B may have: their difference says so.
    if (at < 0 || (!legend.diverging && reached && !(reached.values[at] > 0))) text = t('not_reached');
    const there = at < 0 ? undefined : besideOf(current)?.values[at];
    if (there !== undefined)
      text = `A ${text} · B ${there > 0 ? valueText(legend, endOf(there, page.beside.valid)) : t('not_reached')}`;
    hover.append(element('b', {}, text), ` x ${Math.round(x)} y ${Math.round(y)}`);
    const z = groundHeight(coordinate);
    if (Number.isFinite(z)) hover.append(` · ${t('ground')} ${numberText(Math.round(z))} m`);
    if (sources) {
      const list = sources.at(at);
      const shown = list.slice(0, 3).map(({name, p}) => `${name} ${percentText(p)}`);
      if (list.length > 3) shown.push(t('sources_in_all', list.length));
      if (list.length > 0) hover.append(element('span', {class: 'hover-sources'}, shown.join(' · ')));
    }
    const k = at < 0 ? -1 : classOf(legend, value);
    if (k >= 0) legendBox.querySelector(`[data-class="${k}"]`)?.classList.add('on');
  };
  const left = planes.find((p) => p.layer.quantity === 'left') ?? null;
  const marks = marksOf(maps, left?.values);
  let hintTimer = 0;
  const view = createMap(parts.target, maps, heights, left?.values ?? null, {
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
    line: (coordinates) => profile.follow(coordinates),
  });
  parts.panel.append(switchesOf(view, maps, heights));

  /** What B has of a plane of A. */
  const besideOf = ({layer, plane}) => entries.find(
      (p) => p.ofB && p.layer.name === layer.name && p.plane.label === plane.label);

  /** A share, or the chosen end of its interval. */
  const endOf = (p, trials) => bound === 'value' || !hasEnds(current.layer) || !(trials > 0)
      ? p : wilson(p, trials, page.z)[bound === 'lower' ? 0 : 1];

  /** A plane's probabilities, or one end of their interval where the flow came at all. Where it did
   *  not, the upper end is no 0: it is that of the files, and left out here. */
  const boundOf = ({layer, values, ofB}, which) => {
    const trials = ofB ? page.beside.valid : page.trials;
    if (which === 'value' || !hasEnds(layer) || !(trials > 0)) return values;
    const end = which === 'lower' ? 0 : 1;
    const came = ofB ? reachedB : reached;
    return values.map(
        (p, i) => p > 0 || !came || came.values[i] > 0 ? wilson(p, trials, page.z)[end]
            : which === 'upper' ? NaN : p);
  };

  /** Goes to a quantity and statistic; keeps what was chosen where it exists there. */
  const go = (quantity, statistic) => {
    const same = planes.filter((p) => p.layer.quantity === quantity);
    const wanted = same.filter((p) => p.layer.statistic === statistic);
    const from = wanted.length > 0 ? wanted : same.filter((p) => p.layer === same[0].layer);
    const kept = from.find((p) => p.plane.label === current.plane.label);
    const middle = from.find((p) => p.layer.statistic === 'quantile' && p.plane.axis === 0.5);
    show(kept ?? middle ?? from.find((p) => p.plane.resolved !== false) ?? from[0]);
  };

  const materials = [...new Set(planes.map((p) => p.layer.material))];
  /** Goes to another material, to the same quantity where it has that. */
  const goMaterial = (material) => {
    const own = planes.filter((p) => p.layer.material === material);
    const same = own.find((p) => p.layer.short === current.layer.short) ?? own[0];
    go(same.layer.quantity, current.layer.statistic);
  };

  const pickRow = (label, keys, labelOf, active, pick) => chips(
      label, keys.map((key) => ({key, label: labelOf(key)})), active, pick);

  const drawPickers = () => {
    const {quantity, statistic, material} = current.layer;
    const focused = document.activeElement?.dataset?.key;
    const own = planes.filter((p) => p.layer.material === material);
    const quantities = [...new Set(own.map((p) => p.layer.quantity))];
    const same = planes.filter((p) => p.layer.quantity === quantity);
    const statistics = [...new Set(same.map((p) => p.layer.statistic))];
    const choices = same.filter((p) => p.layer.statistic === statistic);
    const rows = [chips(
        t('quantity'),
        quantities.map((key) => {
          const {short, quantityTitle} = own.find((p) => p.layer.quantity === key).layer;
          return {key, label: short, title: quantityTitle};
        }),
        quantity, (key) => go(key, statistic))];
    if (materials.length > 1)
      rows.unshift(chips(
          t('material'),
          materials.map((key) => ({key: `material-${key}`, label: t(`material.${key || 'all'}`)})),
          `material-${material}`, (key) => goMaterial(key.slice('material-'.length))));
    if (statistics.length > 1)
      rows.push(pickRow(t('statistic'), statistics, (key) => t(`statistic.${key}`), statistic,
                        (key) => go(quantity, key)));
    if (choices.length > 1)
      rows.push(chips(
          t('level'),
          choices.map((p, k) => ({
                        key: `level-${k}`, label: p.plane.label,
                        flag: p.plane.resolved === false ? t('not_resolved') : '',
                      })),
          `level-${choices.indexOf(current)}`, (key) => show(choices[Number(key.slice(6))])));
    if (hasEnds(current.layer) && page.trials > 0)
      rows.push(pickRow(t('end_of_interval'), ['value', 'lower', 'upper'], (key) => t(`end.${key}`),
                        bound, (key) => {
                          bound = key;
                          show(current);
                        }));
    pickers.replaceChildren(...rows);
    if (focused) pickers.querySelector(`[data-key="${focused}"]`)?.focus();
  };

  const fileName = () => (page.beside && !current.layer.legend.diverging ? 'A_' : '') + nameOf(current, bound);
  /** What a saved or printed picture holds. */
  const seen = () => ({
    view, name: fileName(),
    marks: [...marks, ...view.overlays.named.filter(({layer}) => layer.getVisible())
        .map(({name, look}) => ({kind: 'overlay', label: name, colour: look.colour, dash: look.dash}))],
    title: title.textContent, legend: current.layer.legend, values: seenValues,
    scene: document.querySelector('h1').textContent, system: maps.system, beside: swipe.beside(),
  });
  const profile = profileTool(
      view, maps.cells,
      () => ({layer: current.layer, values: seenValues, title: title.textContent,
              name: fileName()}),
      groundHeight);
  /** What is seen of a plane to the right: of B the same end as of A, of the page's own the value. */
  const endSeen = (p) => p.ofB && bound !== 'value' && hasEnds(p.layer)
      ? {values: boundOf(p, bound), title: t('title_of_end', p.plane.title, t(`end_in_title.${bound}`))}
      : {values: p.values, title: p.plane.title};
  const swipe = swipeTool(parts.stage, view, entries, load, page.beside, besideOf, endSeen);
  parts.panel.append(swipe.panel);
  parts.tools.append(profile.button);
  if (planes.length > 1) parts.tools.append(swipe.button);
  const solid = view3dTool(parts.stage, page, heights, () => ({...current, values: seenValues}));
  if (solid) parts.tools.append(solid.button);
  parts.tools.append(...saveTools(seen, maps.cells));
  comment.after(profile.box);
  parts.stage.append(element('span', {class: 'map-system'}, maps.system));

  let chosen = first;
  const show = async (next) => {
    chosen = next;
    await load(next);
    if (chosen !== next) return;  // another one was chosen meanwhile
    current = next;
    const {layer, plane} = current;
    seenValues = boundOf(current, bound);
    const own = page.beside && !layer.legend.diverging ? `A: ${plane.title}` : plane.title;
    title.textContent = bound === 'value' || !hasEnds(layer)
        ? own : t('title_of_end', own, t(`end_in_title.${bound}`));
    comment.textContent = layer.comment ? `${capital(layer.comment)}.` : '';
    drawLegend(legendBox, layer.legend, marks);
    view.show(layer.legend, seenValues);
    cellPanel.follow(layer.quantity, layer.material);
    profile.redraw();
    solid?.redraw();
    swipe.follow(current);
    drawPickers();
  };
  await show(first);
  if (page.beside) swipe.button.click();
  setTimeout(() => Promise.all(planes.map(load)).then(() => cellPanel.redraw()), 60);
  // A still figure has no overlays and is of A alone: where there is more, what is seen is printed.
  printWhatIsSeen(seen, () => current === first && bound === 'value' && view.overlays.named.length === 0 &&
                              swipe.beside() === null && !view.overlays.photo?.getVisible(), extentOf(maps.view));
}

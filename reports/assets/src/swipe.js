// SPDX-License-Identifier: Apache-2.0
// Two planes beside each other, with a handle between them that moves.
import {element, toggle} from './dom.js';
import {legendList} from './legend.js';
import {t} from './texts.js';

/** The choices of what is seen to the right; those of a second ensemble in a group of their own. */
function choicesOf(planes, names) {
  const options = (own) => planes.flatMap(
      (p, k) => Boolean(p.ofB) === own ? [new Option(p.plane.title, k)] : []);
  if (!names) return options(false);
  return [[true, `B: ${names.nameB}`], [false, `A: ${names.nameA}`]].map(([own, label]) => {
    const group = element('optgroup', {label});
    group.append(...options(own));
    return group;
  });
}

/**
 * @param {HTMLElement} stage that holds the map
 * @param {object} view of createMap
 * @param {Array} planes all {layer, plane, values}; `load` brings the values of one
 * @param {object} names {nameA, nameB} of two ensembles, or nothing
 * @param {Function} besideOf what B has of a plane of A
 * @param {Function} endSeen {values, title} of a plane as it is to be seen
 * @returns {{button, panel, beside, follow}} beside() is what is seen to the right, null while the
 *   tool is off; follow(plane) is told what is seen to the left, and goes to what B has of it
 */
export function swipeTool(stage, view, planes, load, names, besideOf, endSeen) {
  const handle = element('div', {
    class: 'swipe', role: 'slider', tabindex: '0', 'aria-label': t('swipe_handle'),
    'aria-valuemin': '0', 'aria-valuemax': '100',
  });
  const pick = element('select', {id: 'pick-beside', 'aria-label': t('swipe_right')});
  pick.append(...choicesOf(planes, names));
  const legend = element('div', {class: 'beside-legend'});
  const panel = element('div', {class: 'beside'},
                        element('label', {for: 'pick-beside'}, t('swipe_right')), pick, legend);
  if (names)
    handle.append(element('span', {class: 'side-a', title: names.nameA}, 'A'),
                  element('span', {class: 'side-b', title: names.nameB}, 'B'));
  let main = null;  // the legend of what is seen to the left
  handle.hidden = panel.hidden = true;
  stage.append(handle);

  const place = (share) => {
    const at = Math.min(1, Math.max(0, share));
    handle.style.left = `${100 * at}%`;
    handle.setAttribute('aria-valuenow', String(Math.round(100 * at)));
    view.setSwipe(at);
  };
  const show = async () => {
    const chosen = planes[Number(pick.value)];
    await load(chosen);
    if (chosen !== planes[Number(pick.value)]) return;  // another one was chosen meanwhile
    const {layer} = chosen;
    view.showBeside(layer.legend, endSeen(chosen).values);
    // The same classes need not be told twice.
    legend.hidden = JSON.stringify(main) === JSON.stringify(layer.legend);
    legend.replaceChildren(element('p', {class: 'legend-title'}, layer.legend.title),
                           legendList(layer.legend));
  };
  handle.addEventListener('pointerdown', (event) => {
    handle.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  handle.addEventListener('pointermove', (event) => {
    if (!handle.hasPointerCapture(event.pointerId)) return;
    const box = stage.getBoundingClientRect();
    place((event.clientX - box.left) / box.width);
  });
  handle.addEventListener('keydown', (event) => {
    const step = {ArrowLeft: -2, ArrowRight: 2}[event.key];
    if (!step) return;
    event.preventDefault();
    place((Number(handle.getAttribute('aria-valuenow')) + step) / 100);
  });
  pick.addEventListener('change', show);

  const {button} = toggle('tool-swipe', t('swipe'), (on) => {
    handle.hidden = panel.hidden = !on;
    if (!on) {
      view.setSwipe(null);
      return;
    }
    show();
    place(0.5);
  });
  const beside = () => {
    if (handle.hidden) return null;
    const chosen = planes[Number(pick.value)];
    const {title} = endSeen(chosen);
    return {title: names ? `${chosen.ofB ? 'B' : 'A'}: ${title}` : title, legend: chosen.layer.legend};
  };
  const follow = (current) => {
    main = current.layer.legend;
    const own = planes.indexOf(besideOf(current));
    if (own >= 0) pick.value = String(own);
    if (!handle.hidden) show();
  };
  return {button, panel, beside, follow};
}

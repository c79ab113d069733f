// SPDX-License-Identifier: Apache-2.0
// Two planes beside each other, with a handle between them that moves.
import {element, toggle} from './dom.js';
import {legendList} from './legend.js';
import {t} from './texts.js';

/**
 * @param {HTMLElement} stage that holds the map
 * @param {object} view of createMap
 * @param {Array} planes all {layer, plane, values}; `load` brings the values of one
 * @returns {{button: HTMLElement, panel: HTMLElement, beside: Function}} beside() is what is seen to
 *   the right, null while the tool is off
 */
export function swipeTool(stage, view, planes, load) {
  const handle = element('div', {
    class: 'swipe', role: 'slider', tabindex: '0', 'aria-label': t('swipe_handle'),
    'aria-valuemin': '0', 'aria-valuemax': '100',
  });
  const pick = element('select', {id: 'pick-beside', 'aria-label': t('swipe_right')});
  planes.forEach((p, k) => pick.append(new Option(p.plane.title, k)));
  const legend = element('div', {class: 'beside-legend'});
  const panel = element('div', {class: 'beside'},
                        element('label', {for: 'pick-beside'}, t('swipe_right')), pick, legend);
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
    view.showBeside(layer.legend, chosen.values);
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
    const {layer, plane} = planes[Number(pick.value)];
    return {title: plane.title, legend: layer.legend};
  };
  return {button, panel, beside};
}

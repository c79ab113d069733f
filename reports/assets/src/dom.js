// SPDX-License-Identifier: Apache-2.0
// Small builders of elements.
import {t} from './texts.js';

export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

export function svgElement(tag, attributes = {}, text = '') {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.textContent = text;
  return node;
}

/** A row of buttons of which one is pressed; `entries` are {key, label, title, flag}. */
export function chips(label, entries, active, pick) {
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

/** A button that stays pressed while its tool is on; `change(on)` is called. */
export function toggle(id, label, change) {
  const button = element('button', {type: 'button', id, class: 'tool', 'aria-pressed': 'false'}, label);
  const set = (on) => {
    if ((button.getAttribute('aria-pressed') === 'true') === on) return;
    button.setAttribute('aria-pressed', String(on));
    change(on);
  };
  button.addEventListener('click', () => set(button.getAttribute('aria-pressed') !== 'true'));
  return {button, set};
}

/** The map is never turned: north is up. */
export function northArrow() {
  const svg = svgElement('svg', {
    viewBox: '0 0 24 36', width: '24', height: '36', class: 'north', role: 'img',
    'aria-label': t('north'),
  });
  svg.append(
      svgElement('path', {d: 'M12 1 19 23 12 18 5 23Z', fill: '#111', stroke: '#fff',
                          'stroke-width': '1.2'}),
      svgElement('text', {x: '12', y: '34', 'text-anchor': 'middle', 'font-size': '11',
                          'font-weight': '700', fill: '#111', stroke: '#fff',
                          'stroke-width': '2.4', 'paint-order': 'stroke'}, 'N'));
  return svg;
}

/** Hands `blob` to the reader as a file. */
export function saveAs(name, blob) {
  const link = element('a', {href: URL.createObjectURL(blob), download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

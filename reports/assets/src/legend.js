// SPDX-License-Identifier: Apache-2.0
// What the colours and marks of the map mean.
import {element} from './dom.js';
import {t} from './texts.js';

const mostNames = 12;

/** Classes of one plane under its title. */
export function legendList(legend) {
  const list = element('ul', {class: 'legend'});
  const listed = legend.nominal ? legend.classes.slice(0, mostNames) : legend.classes;
  listed.forEach((c, k) => {
    const swatch = element('span', {class: 'swatch'});
    swatch.style.background = c.colour;
    list.append(element('li', {'data-class': k}, swatch, c.label));
  });
  if (listed.length < legend.classes.length)
    list.append(element('li', {}, t('in_all', legend.classes.length)));
  return list;
}

/** The marks that are drawn: {kind, label}; kind is that of a swatch in the style sheet. */
export function marksOf(maps, leftValues) {
  const marks = [];
  if (maps.release.length > 0) marks.push({kind: 'release', label: t('release')});
  if (maps.observed) marks.push({kind: 'observed', label: maps.observed.label});
  if (maps.nearest) marks.push({kind: 'nearest', label: maps.nearest.label});
  for (const front of maps.fronts) marks.push({kind: `front-${front.kind}`, label: front.label});
  if (leftValues?.some((v) => v > 0)) marks.push({kind: 'left', label: t('mass_left')});
  return marks;
}

export function drawLegend(box, legend, marks) {
  const list = element('ul', {class: 'legend marks'});
  for (const {kind, label} of marks)
    list.append(element('li', {}, element('span', {class: `swatch ${kind}`}), label));
  box.replaceChildren(element('p', {class: 'legend-title'}, legend.title), legendList(legend), list);
}

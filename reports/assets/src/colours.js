// SPDX-License-Identifier: Apache-2.0
// The page's colours for canvases, which do not follow style sheets by themselves.

let printing = false;
const listeners = [];

/** Calls `redraw` whenever the page's colours change: another scheme, or print. */
export function onColourChange(redraw) {
  listeners.push(redraw);
}
function changed() {
  for (const redraw of listeners) redraw();
}
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', changed);
addEventListener('beforeprint', () => {
  printing = true;
  changed();
});
addEventListener('afterprint', () => {
  printing = false;
  changed();
});

export function colours() {
  if (printing)
    return {
      ink: '#1b2228', muted: '#5b6770', line: '#dde1e4', accent: '#0f6674', warm: '#c2571a',
      band: 'rgba(15,102,116,0.18)', sheet: '#fff',
    };
  const style = getComputedStyle(document.documentElement);
  const of = (name) => style.getPropertyValue(name).trim();
  return {
    ink: of('--ink'), muted: of('--muted'), line: of('--line'), accent: of('--accent'),
    warm: of('--warm'), band: of('--band'), sheet: of('--sheet'),
  };
}

/** A colour of the style sheet by its name without the dashes. */
export function colourOf(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// SPDX-License-Identifier: Apache-2.0
// One pixel per cell, in the legend's colours.
import {classOf} from './data.js';

export function paint(canvas, legend, values) {
  const context = canvas.getContext('2d');
  const image = context.createImageData(canvas.width, canvas.height);
  const rgb = legend.classes.map((c) => Number.parseInt(c.colour.slice(1), 16));
  for (let i = 0; i < values.length; i++) {
    const k = classOf(legend, values[i]);
    if (k < 0) continue;
    image.data[4 * i] = rgb[k] >> 16;
    image.data[4 * i + 1] = (rgb[k] >> 8) & 255;
    image.data[4 * i + 2] = rgb[k] & 255;
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}

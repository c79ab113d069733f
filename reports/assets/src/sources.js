// SPDX-License-Identifier: Apache-2.0
// Which sources of a region reach a cell.
import {unpack} from './data.js';

/**
 * The lists of a page, unpacked; null where it has none.
 * `at(cell)` gives {name, p} of each source that reaches the cell, the most probable first.
 */
export async function loadSources(region, cols) {
  if (!region) return null;
  const [counts, sources, shares] = await Promise.all([
    unpack(region.counts, cols), unpack(region.sources, 1), unpack(region.shares, 1),
  ]);
  const begin = new Uint32Array(counts.length + 1);
  for (let i = 0; i < counts.length; i++) begin[i + 1] = begin[i] + counts[i];
  return {
    at(cell) {
      const list = [];
      if (cell < 0) return list;
      for (let k = begin[cell]; k < begin[cell + 1]; k++)
        list.push({name: region.names[sources[k]], p: shares[k] / region.steps});
      return list.sort((a, b) => b.p - a.p);
    },
  };
}

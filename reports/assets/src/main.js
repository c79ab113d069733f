// SPDX-License-Identifier: Apache-2.0
// Wakes the page up: sortable table, charts, and maps in place of the still pictures.
import 'ol/ol.css';
import 'uplot/dist/uPlot.min.css';
import '../page.css';
import '../map.css';
import '../print.css';

import {drawCharts} from './charts.js';
import {startMaps} from './controls.js';
import {drawMotion} from './motion.js';
import {makeSortable} from './table.js';
import {t, useTexts} from './texts.js';

const page = JSON.parse(document.getElementById('sturz-data').textContent);
useTexts(page.texts, document.documentElement.lang);

makeSortable(document.getElementById('member-table'));

for (const part of document.querySelectorAll('.needs-script')) part.hidden = false;
if (document.getElementById('spread')) drawCharts(page);
if (document.getElementById('motion')) {
  drawMotion(page.motion);
  document.documentElement.classList.add('live-motion');
}

if (page.maps) {
  startMaps(page).then(
      () => {
        document.documentElement.classList.add('live-maps');
        performance.mark('first-map');
      },
      (error) => {
        document.getElementById('map-app').hidden = true;
        document.getElementById('still-note').textContent =
            t('no_live_maps', error.message);
      });
}

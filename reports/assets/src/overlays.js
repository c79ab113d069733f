// SPDX-License-Identifier: Apache-2.0
// Layers that the scene brings along: roads, buildings, names; an orthophoto below the results.
import Feature from 'ol/Feature.js';
import LineString from 'ol/geom/LineString.js';
import Point from 'ol/geom/Point.js';
import Polygon from 'ol/geom/Polygon.js';
import ImageLayer from 'ol/layer/Image.js';
import VectorLayer from 'ol/layer/Vector.js';
import Static from 'ol/source/ImageStatic.js';
import VectorSource from 'ol/source/Vector.js';
import CircleStyle from 'ol/style/Circle.js';
import Fill from 'ol/style/Fill.js';
import Stroke from 'ol/style/Stroke.js';
import Style from 'ol/style/Style.js';
import Text from 'ol/style/Text.js';

/** Dark on a pale seam, told apart by dashes as well as by hue. */
const looks = [
  {colour: '#0b5345', dash: undefined}, {colour: '#34495e', dash: [7, 4]},
  {colour: '#4d5d00', dash: [2, 4]}, {colour: '#5e3370', dash: [10, 3, 2, 3]},
];
export const lookOf = (k) => looks[k % looks.length];

const geometries = {point: Point, line: LineString, polygon: Polygon};

function styleOf(look) {
  const stroke = new Stroke({color: look.colour, width: 1.8, lineDash: look.dash});
  return (feature) => [
    new Style({stroke: new Stroke({color: 'rgba(255,255,255,0.8)', width: 3.6})}),
    new Style({
      stroke,
      fill: new Fill({color: `${look.colour}26`}),
      image: new CircleStyle({radius: 4, fill: new Fill({color: look.colour}),
                              stroke: new Stroke({color: '#fff', width: 1.4})}),
      text: new Text({
        text: feature.get('name') ?? '', font: '500 11px system-ui, sans-serif',
        overflow: feature.get('kind') !== 'line', offsetY: feature.get('kind') === 'point' ? -11 : 0,
        placement: feature.get('kind') === 'line' ? 'line' : 'point',
        fill: new Fill({color: look.colour}), stroke: new Stroke({color: '#fff', width: 3}),
      }),
    }),
  ];
}

function vectorLayer(overlay, k) {
  const features = overlay.features.map(({kind, at, name}) => {
    const feature = new Feature(new geometries[kind](at));
    feature.set('kind', kind);
    if (name) feature.set('name', name);
    return feature;
  });
  return new VectorLayer({
    source: new VectorSource({features}), style: styleOf(lookOf(k)), declutter: true,
    updateWhileInteracting: true,
  });
}

/** {below, above: layers, named: [{name, layer, look, features}]} */
export function overlayLayers(maps, projection) {
  const named = (maps.overlays ?? []).map(
      (overlay, k) => ({name: overlay.name, layer: vectorLayer(overlay, k), look: lookOf(k),
                        features: overlay.features}));
  let photo = null;
  if (maps.orthophoto) {
    const {west, south, east, north, picture} = maps.orthophoto;
    photo = new ImageLayer({
      source: new Static({url: picture, imageExtent: [west, south, east, north], projection}),
      visible: false,
    });
  }
  return {below: photo ? [photo] : [], above: named.map((o) => o.layer), named, photo};
}

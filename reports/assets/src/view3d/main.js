// SPDX-License-Identifier: Apache-2.0
// The ground as a surface with a picture on it. A bundle of its own, unpacked when it is asked for.
import {
  BufferAttribute, BufferGeometry, CanvasTexture, DirectionalLight, HemisphereLight,
  LinearFilter, Mesh, MeshLambertMaterial, PerspectiveCamera, Scene, SRGBColorSpace, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

const mostVertices = 160000;

/** Every `step`-th known height as a vertex; quads with an unknown corner stay open. */
function surface(grid, heights) {
  const step = Math.max(1, Math.ceil(Math.sqrt(grid.cols * grid.rows / mostVertices)));
  const cols = Math.floor((grid.cols - 1) / step) + 1;
  const rows = Math.floor((grid.rows - 1) / step) + 1;
  const position = new Float32Array(3 * cols * rows);
  const uv = new Float32Array(2 * cols * rows);
  let low = Infinity;
  let high = -Infinity;
  for (const z of heights) {
    if (z < low) low = z;
    if (z > high) high = z;
  }
  const width = grid.cols * grid.cell;
  const length = grid.rows * grid.cell;
  const known = new Uint8Array(cols * rows);
  for (let r = 0; r < rows; r++)
    for (let c = 0; c < cols; c++) {
      const k = r * cols + c;
      const z = heights[r * step * grid.cols + c * step];
      known[k] = Number.isFinite(z) ? 1 : 0;
      const east = (c * step + 0.5) * grid.cell;
      const south = (r * step + 0.5) * grid.cell;
      position.set([east - width / 2, known[k] ? z - low : 0, south - length / 2], 3 * k);
      uv.set([east / width, 1 - south / length], 2 * k);
    }
  const index = [];
  for (let r = 0; r + 1 < rows; r++)
    for (let c = 0; c + 1 < cols; c++) {
      const k = r * cols + c;
      if (known[k] && known[k + 1] && known[k + cols] && known[k + cols + 1])
        index.push(k, k + cols, k + 1, k + 1, k + cols, k + cols + 1);
    }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('uv', new BufferAttribute(uv, 2));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return {geometry, width, length, relief: high - low};
}

/**
 * @param {HTMLElement} container that the view fills
 * @param {{cols, rows, cell}} grid of `heights` [m], row by row from the north-west
 * @param {HTMLCanvasElement} picture that lies on the ground, north up
 */
function create(container, grid, heights, picture) {
  const renderer = new WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setClearColor(0xdfe6ea);
  container.append(renderer.domElement);
  const {geometry, width, length, relief} = surface(grid, heights);
  const texture = new CanvasTexture(picture);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = LinearFilter;
  texture.generateMipmaps = false;
  texture.anisotropy = renderer.capabilities.getMaxAnisotropy();
  const material = new MeshLambertMaterial({map: texture});
  const scene = new Scene();
  scene.add(new Mesh(geometry, material));
  scene.add(new HemisphereLight(0xffffff, 0xb0a898, 2.2));
  const sun = new DirectionalLight(0xffffff, 1.2);
  sun.position.set(-1, 1.4, -1);
  scene.add(sun);
  const size = Math.max(width, length);
  const camera = new PerspectiveCamera(40, 1, size / 500, 20 * size);
  camera.position.set(0.1 * size, relief + 0.42 * size, 0.62 * size);
  const controls = new OrbitControls(camera, renderer.domElement);
  controls.target.set(0, relief / 3, 0);
  controls.maxPolarAngle = 0.49 * Math.PI;
  controls.listenToKeyEvents(container);
  controls.update();
  const render = () => renderer.render(scene, camera);
  const resize = () => {
    const {clientWidth, clientHeight} = container;
    if (clientWidth === 0 || clientHeight === 0) return;
    renderer.setSize(clientWidth, clientHeight);
    camera.aspect = clientWidth / clientHeight;
    camera.updateProjectionMatrix();
    render();
  };
  controls.addEventListener('change', render);
  const observer = new ResizeObserver(resize);
  observer.observe(container);
  resize();
  return {
    /** After the picture has changed. */
    update() {
      texture.needsUpdate = true;
      render();
    },
    dispose() {
      observer.disconnect();
      controls.dispose();
      geometry.dispose();
      texture.dispose();
      material.dispose();
      renderer.dispose();
      renderer.domElement.remove();
    },
  };
}

globalThis.sturzView3d = {create};

// SPDX-License-Identifier: Apache-2.0
// Bundles the page's script and style, and the 3-D view by itself, deflated as base64:
// node build.mjs OUT, where OUT holds node_modules.
import {readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {deflateSync} from 'node:zlib';

const out = resolve(process.argv[2]);
const source = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(out, 'package.json'))('esbuild');

const options = {
  outdir: out,
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2022',
  charset: 'utf8',
  legalComments: 'none',
  nodePaths: [join(out, 'node_modules')],
  logLevel: 'warning',
};

/** The licence texts of all packages that a first, unwritten bundle takes code from. */
async function licenceTexts(entryPoints) {
  const {metafile} = await esbuild.build({...options, entryPoints, write: false, metafile: true});
  const names = new Set();
  for (const path of Object.keys(metafile.inputs)) {
    const found = path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//g)?.at(-1);
    if (found) names.add(found.slice('node_modules/'.length, -1));
  }
  const texts = [...names].sort().map((name) => {
    const folder = join(out, 'node_modules', name);
    const file = readdirSync(folder).find((f) => /^licen[cs]e/i.test(f));
    if (!file) throw new Error(`${name} ships no licence text`);
    return `--- ${name} ---\n${readFileSync(join(folder, file), 'utf8').trim()}`;
  });
  return `/*\nThis page holds code of these packages:\n\n${texts.join('\n\n').replaceAll('*/', '* /')}\n*/`;
}

async function bundle(name, entry) {
  const entryPoints = {[name]: join(source, entry)};
  await esbuild.build({...options, entryPoints, banner: {js: await licenceTexts(entryPoints)}});
}

await bundle('report', 'src/main.js');
await bundle('view3d', 'src/view3d/main.js');
const drawing = readFileSync(join(out, 'view3d.js'));
writeFileSync(join(out, 'view3d.js.z64'), deflateSync(drawing, {level: 9}).toString('base64'));

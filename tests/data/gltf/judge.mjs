// Whether three.js reads out of the glTF files below this folder what their maker says: node judge.mjs FOLDER_OF_THREE. It shares nothing with
// the engine or with make.py. Triangles are compared in the world, whatever their order, with their colors and normals; lights and cameras by
// where they are. Ends with 1 where something differs, with 77 where three.js is not there.
import fs from 'node:fs';
import path from 'node:path';
import url from 'node:url';

const here = path.dirname(url.fileURLToPath(import.meta.url));
const folder = process.argv[2] ?? '';
if (!fs.existsSync(path.join(folder, 'build/three.module.js'))) {
  console.log('three.js is not in', folder);
  process.exit(77);
}
globalThis.self = globalThis;
globalThis.ProgressEvent = class extends Event {};
const fetchAnything = globalThis.fetch;
globalThis.fetch = (request) => {
  const address = typeof request === 'string' ? request : request.url;
  return address.startsWith('file:') ? Promise.resolve(new Response(fs.readFileSync(url.fileURLToPath(address)))) : fetchAnything(request);
};
// Its examples import it by the name that a package manager gives it.
const { registerHooks, register } = await import('node:module');
const source = url.pathToFileURL(path.join(path.resolve(folder), 'build/three.module.js')).href;
if (registerHooks)
  registerHooks({ resolve: (name, context, next) => (name === 'three' ? { url: source, shortCircuit: true } : next(name, context)) });
else
  register('data:text/javascript,' + encodeURIComponent(
    `export const resolve = (name, context, next) => name === 'three' ? { url: ${JSON.stringify(source)}, shortCircuit: true } : next(name, context);`));
const THREE = await import(source);
const { GLTFLoader } = await import(url.pathToFileURL(path.join(path.resolve(folder), 'examples/jsm/loaders/GLTFLoader.js')).href);

const near = (a, b) => Math.hypot(...a.map((x, k) => x - b[k])) <= 4e-6 * (1 + Math.hypot(...b));

function trianglesOf(mesh, matrix, out) {
  const { position, normal } = mesh.geometry.attributes;
  const index = mesh.geometry.index;
  const corners = index ? Array.from({ length: index.count }, (_, i) => index.getX(i)) : [...Array(position.count).keys()];
  const across = new THREE.Matrix3().getNormalMatrix(matrix);
  for (let i = 0; i + 2 < corners.length; i += 3) {
    const turned = matrix.determinant() < 0 ? [0, 2, 1] : [0, 1, 2];
    const at = turned.map((k) => corners[i + k]);
    out.push({
      corners: at.map((v) => new THREE.Vector3().fromBufferAttribute(position, v).applyMatrix4(matrix).toArray()),
      normals: normal && at.map((v) => new THREE.Vector3().fromBufferAttribute(normal, v).applyMatrix3(across).normalize().toArray()),
      color: mesh.material.name === '' && mesh.material.isDefault ? null : mesh.material.color.toArray(),
    });
  }
}

// What there is in a scene that was loaded.
function contentsOf(scene) {
  const out = { triangles: [], lights: [], cameras: [] };
  scene.updateMatrixWorld(true);
  scene.traverse((node) => {
    if (node.isInstancedMesh)
      for (let i = 0; i < node.count; ++i) {
        const local = new THREE.Matrix4();
        node.getMatrixAt(i, local);
        trianglesOf(node, local.premultiply(node.matrixWorld), out.triangles);
      }
    else if (node.isMesh) trianglesOf(node, node.matrixWorld, out.triangles);
    const place = new THREE.Vector3().setFromMatrixPosition(node.matrixWorld);
    if (node.isLight) {
      const to = node.target ? new THREE.Vector3().setFromMatrixPosition(node.target.matrixWorld).sub(place).normalize().toArray() : null;
      out.lights.push({ center: place.toArray(), to, color: node.color.toArray().map((c) => c * node.intensity) });
    }
    if (node.isPerspectiveCamera) {
      const to = new THREE.Vector3(0, 0, -1).transformDirection(node.matrixWorld).toArray();
      out.cameras.push({ eye: place.toArray(), to, fov: node.fov });
    }
  });
  return out;
}

function sameTriangle(found, corners, normals, color) {
  if (color && found.color && !near(found.color, color)) return false;
  return [0, 1, 2].some((k) => [0, 1, 2].every((c) => near(found.corners[(k + c) % 3], corners[c]) &&
    (!normals || (found.normals && near(found.normals[(k + c) % 3], normals[c])))));
}

function complaints(found, expected) {
  const out = [];
  const left = [...found.triangles];
  let missing = 0;
  for (const object of expected.objects)
    object.triangles.forEach((t, f) => {
      const color = object.colors ? object.colors[f] : object.albedo;
      const at = left.findIndex((c) => sameTriangle(c, [t.slice(0, 3), t.slice(3, 6), t.slice(6, 9)], object.normals?.[f], color));
      if (at < 0) ++missing;
      else left.splice(at, 1);
    });
  if (missing || left.length) out.push(`${missing} triangles are missing, ${left.length} are not expected`);
  for (const light of expected.lights ?? []) {
    if (light.extension) continue; // that three.js does not know
    const color = light.irradiance ?? light.radiance?.map((c) => c * Math.PI * light.radius ** 2);
    const fits = (l) => (!light.center || near(l.center, light.center)) && (!(light.direction ?? light.normal) || near(l.to, light.direction ?? light.normal)) &&
      (!color || near(l.color, color));
    if (!found.lights.some(fits)) out.push(`light ${light.name} is not there`);
  }
  const camera = expected.camera;
  if (camera && !found.cameras.some((c) => near(c.eye, camera.eye) && near(c.to, camera.towards) && Math.abs(c.fov - camera.fov_y_degrees) < 1e-4))
    out.push('the camera is not there');
  return out;
}

async function load(file) {
  const loader = new GLTFLoader();
  // Pictures need a browser.
  loader.register(() => ({ name: 'no_textures', loadTexture: () => Promise.resolve(new THREE.Texture()) }));
  const bytes = fs.readFileSync(file);
  return loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), url.pathToFileURL(path.dirname(file)).href + '/');
}

let count = 0, bad = 0;
for (const name of fs.readdirSync(here, { recursive: true }).filter((n) => /\.(gltf|glb)$/.test(n)).sort()) {
  const expected = JSON.parse(fs.readFileSync(path.join(here, name.replace(/\.\w+$/, '.expected.json')), 'utf8'));
  if (expected.refused) continue;
  const found = contentsOf((await load(path.join(here, name))).scene);
  const said = complaints(found, expected);
  ++count;
  bad += said.length > 0;
  console.log(`${name}: ${found.triangles.length} triangles ${said.length ? said.join('; ') : 'as expected'}`);
}
console.log(`${count} files, ${bad} differ`);
process.exit(bad ? 1 : 0);

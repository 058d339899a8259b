// Runs in headless Chromium: penumbra study --peers. Renders one scene by three.js with percentage-closer soft shadows (Fernando
// 2005), as three.js's example webgl_shadowmap_pcss adds them: instead of the filter of three.js's own shadow maps.
//
// THREE is the library; `given` is {scene (scene_export.h), settings: [{map, samples}], rounds}. Writes into an element "result" JSON:
// {revision, renderer, lit, results: [{times, shadowed}]}, or {error}. Pictures are one float32 a pixel, little-endian, in base64,
// from the bottom row up.
"use strict";

const MOST_MS = 4000;  // of the frames of one setting

/** Blocker search, width of the penumbra by similar triangles, and a filter of that width. Depths are linear, from the light. */
const pcss = samples => `
  #define PCSS_SAMPLES ${samples}
  uniform float pcssLight;  // radius in the map at the near plane; of a sun: for each unit of depth
  uniform float pcssNear, pcssFar, pcssBias;
  uniform bool pcssDistant;

  float pcssDepth(float stored) {
    return pcssDistant ? mix(pcssNear, pcssFar, stored) : pcssNear * pcssFar / (pcssFar - stored * (pcssFar - pcssNear));
  }
  // Vogel's spiral, of equal areas, turned.
  vec2 pcssPoint(int k, float turn) {
    return sqrt((float(k) + .5) / float(PCSS_SAMPLES)) * vec2(cos(2.3999632 * float(k) + turn), sin(2.3999632 * float(k) + turn));
  }
  float pcssVisibility(sampler2D map, vec3 coord) {
    float receiver = pcssDepth(coord.z), turn = 6.2831853 * rand(coord.xy);
    float search = pcssLight * (pcssDistant ? receiver - pcssNear : (receiver - pcssNear) / receiver);
    float sum = 0., count = 0.;
    for (int k = 0; k < PCSS_SAMPLES; ++k) {
      float depth = pcssDepth(unpackRGBAToDepth(texture2D(map, coord.xy + search * pcssPoint(k, turn))));
      if (depth < receiver - pcssBias) { sum += depth; count += 1.; }
    }
    if (count == 0.) return 1.;
    float blocker = sum / count;
    float width = pcssLight * (pcssDistant ? receiver - blocker : (receiver - blocker) / blocker * pcssNear / receiver);
    float lit = 0.;
    for (int k = 0; k < PCSS_SAMPLES; ++k) {
      vec2 offset = width * pcssPoint(k, turn);
      lit += step(receiver - pcssBias, pcssDepth(unpackRGBAToDepth(texture2D(map, coord.xy + offset))));
      lit += step(receiver - pcssBias, pcssDepth(unpackRGBAToDepth(texture2D(map, coord.xy - offset.yx))));
    }
    return lit / float(2 * PCSS_SAMPLES);
  }
`;

const bytesOf = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
const textOf = bytes => {
  let text = "";
  for (let k = 0; k < bytes.length; k += 32768) text += String.fromCharCode(...bytes.subarray(k, k + 32768));
  return btoa(text);
};
const vector = v => new THREE.Vector3(...v);

/** Every edge once each way: then the faces turned away from the light are what casts, as is three.js's habit. */
const isClosed = triangles => {
  const edges = new Set();
  for (let k = 0; k < triangles.length; k += 3)
    for (let i = 0; i < 3; ++i) {
      const key = triangles[k + i] * 4294967296 + triangles[k + (i + 1) % 3];
      if (edges.has(key)) return false;
      edges.add(key);
    }
  for (const key of edges)
    if (!edges.has((key % 4294967296) * 4294967296 + Math.floor(key / 4294967296))) return false;
  return true;
};

const meshOf = object => {
  const geometry = new THREE.BufferGeometry();
  const triangles = new Uint32Array(bytesOf(object.triangles).buffer);
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(bytesOf(object.positions).buffer), 3));
  geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
  geometry.computeVertexNormals();  // three.js's shadows have NaN without
  const closed = isClosed(triangles);
  const material = new THREE.MeshLambertMaterial({
    color: 0xffffff, flatShading: true, side: THREE.DoubleSide, shadowSide: closed ? THREE.BackSide : THREE.DoubleSide });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.castShadow = object.casts;
  mesh.receiveShadow = true;
  mesh.userData.closed = closed;
  mesh.frustumCulled = false;
  return mesh;
};

const cameraOf = ({ width, height, camera: c }) => {
  const camera = new THREE.PerspectiveCamera(c.fov_y_degrees, width / height, c.near, c.far);
  camera.matrixAutoUpdate = false;
  camera.matrix.makeBasis(vector(c.right), vector(c.up), vector(c.forward).negate()).setPosition(vector(c.eye));
  camera.updateMatrixWorld(true);
  return camera;
};

/** Depth along the light's direction from its center, and distance from that axis, of all corners. */
const eachCorner = (meshes, light, use) => {
  const center = vector(light.center), axis = vector(light.normal), p = new THREE.Vector3();
  for (const mesh of meshes) {
    const { array } = mesh.geometry.attributes.position;
    for (let k = 0; k < array.length; k += 3) {
      p.fromArray(array, k).sub(center);
      const depth = p.dot(axis);
      use(depth, Math.sqrt(Math.max(0, p.lengthSq() - depth * depth)));
    }
  }
};

/** A map that all casters fit in, with room for their penumbras, as far as 75 degrees around the light's axis. */
const fitDisk = (meshes, light) => {
  let far = 0, nearest = Infinity, slope = 0;
  eachCorner(meshes, light, depth => { far = Math.max(far, depth); });
  const casters = meshes.filter(mesh => mesh.castShadow);
  eachCorner(casters, light, depth => { if (depth > 0) nearest = Math.min(nearest, depth); });
  const near = Math.max(.9 * nearest, .05 * far);  // a map is of no use right under a lamp
  eachCorner(casters, light, (depth, aside) => { slope = Math.max(slope, aside / Math.max(depth, near)); });
  slope = Math.min(Math.tan(75 * Math.PI / 180), 1.02 * (slope + light.radius / near));
  return { near, far: 1.01 * far, slope, uniform: light.radius / (2 * near * slope) };
};
const fitDistant = (meshes, light) => {
  let low = Infinity, far = -Infinity, half = 0;
  eachCorner(meshes, light, depth => { far = Math.max(far, depth); });
  eachCorner(meshes.filter(mesh => mesh.castShadow), light, (depth, aside) => {
    low = Math.min(low, depth);
    half = Math.max(half, aside);
  });
  const tangent = Math.tan(light.angle_degrees / 360 * Math.PI);
  half = 1.02 * (half + tangent * (far - low));
  const back = .1 * (far - low);  // the light stands so far before the casters
  return { low: low - back, near: .5 * back, far: 1.01 * (far - low) + back, half, uniform: tangent / (2 * half) };
};

/** Whether casters stand around a near light: it then sees them from inside, and their far faces are the ones that are lit. */
const isAround = (meshes, light) => {
  let behind = false;
  if (light.kind === "disk") eachCorner(meshes.filter(mesh => mesh.castShadow), light, depth => { behind ||= depth < 0; });
  return behind;
};

const lightOf = (light, meshes) => {
  const distant = light.kind === "distant", fit = (distant ? fitDistant : fitDisk)(meshes, light);
  const made = distant ? new THREE.DirectionalLight(0xffffff, Math.PI) : new THREE.SpotLight(0xffffff, Math.PI, 0, Math.PI / 2, 0, 0);
  const { camera } = made.shadow, axis = vector(light.normal);
  made.position.copy(vector(light.center)).addScaledVector(axis, distant ? fit.low : 0);
  made.target.position.copy(made.position).add(axis);
  if (distant) Object.assign(camera, { left: -fit.half, right: fit.half, bottom: -fit.half, top: fit.half });
  else made.shadow.focus = Math.atan(fit.slope) / (Math.PI / 2);
  Object.assign(camera, { near: fit.near, far: fit.far });
  camera.updateProjectionMatrix();
  return { light: made, uniforms: { pcssLight: { value: fit.uniform }, pcssNear: { value: fit.near }, pcssFar: { value: fit.far },
                                    pcssBias: { value: 0 }, pcssDistant: { value: distant } } };
};

const replaced = (text, before, after) => {
  if (!text.includes(before)) throw new Error(`three.js ${THREE.REVISION} has no "${before}" in its shader of shadows`);
  return text.replace(before, () => after);
};

const usePcss = (meshes, uniforms, samples) => {
  for (const { material } of meshes) {
    material.onBeforeCompile = shader => {
      Object.assign(shader.uniforms, uniforms);
      let chunk = replaced(THREE.ShaderChunk.shadowmap_pars_fragment, "float getShadow(", `${pcss(samples)}\nfloat getShadow(`);
      chunk = replaced(chunk, "if ( frustumTest ) {", "if ( frustumTest ) { return pcssVisibility( shadowMap, shadowCoord.xyz );");
      shader.fragmentShader = replaced(shader.fragmentShader, "#include <shadowmap_pars_fragment>", chunk);
    };
    material.customProgramCacheKey = () => `pcss ${samples}`;
    material.needsUpdate = true;
  }
};

const run = () => {
  const { scene: source, settings, rounds } = given;
  const renderer = new THREE.WebGLRenderer({ antialias: false });
  renderer.shadowMap.enabled = true;
  const gl = renderer.getContext(), debug = gl.getExtension("WEBGL_debug_renderer_info");
  const target = new THREE.WebGLRenderTarget(source.width, source.height, { type: THREE.FloatType, colorSpace: THREE.LinearSRGBColorSpace });
  const scene = new THREE.Scene(), meshes = source.objects.map(meshOf), camera = cameraOf(source);
  const { light, uniforms } = lightOf(source.light, meshes);
  scene.add(light, light.target, ...meshes);
  if (meshes.some(mesh => mesh.castShadow && !mesh.userData.closed) || isAround(meshes, source.light))
    uniforms.pcssBias.value = .003 * (uniforms.pcssFar.value - uniforms.pcssNear.value);
  const pixels = new Float32Array(4 * source.width * source.height), one = new Float32Array(4);
  const draw = () => {
    const start = performance.now();
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, 1, 1, one);  // waits until it is drawn
    return performance.now() - start;
  };
  const picture = () => {
    renderer.readRenderTargetPixels(target, 0, 0, source.width, source.height, pixels);
    return textOf(new Uint8Array(pixels.filter((_, k) => k % 4 === 1).buffer));
  };
  light.castShadow = false;
  draw();
  const lit = picture();
  light.castShadow = true;
  const results = settings.map(({ map, samples }) => {
    usePcss(meshes, uniforms, samples);
    light.shadow.mapSize.set(map, map);
    light.shadow.map?.dispose();
    light.shadow.map = null;
    const first = draw();
    const times = Array.from({ length: Math.max(1, Math.min(rounds, Math.floor(MOST_MS / first))) }, draw);
    return { times, shadowed: picture() };
  });
  return { revision: THREE.REVISION, renderer: gl.getParameter(debug ? debug.UNMASKED_RENDERER_WEBGL : gl.RENDERER), lit, results };
};

{
  let result;
  try {
    result = run();
  } catch (error) {
    result = { error: String(error) };
  }
  const place = document.createElement("pre");
  place.id = "result";
  place.textContent = JSON.stringify(result);
  document.body.append(place);
}

#version 450 core
// Visibility of the disk from every visible surface point, by the D-buffer's entries. Everything is in the light's frame:
// the disk in z = 0 about the origin.
#include "disk_area.glsl"

const int kMaxTargets = 5;
const uint kEmpty = 0u;        // ids are stored plus one
const float kOnPlane = 1e-5;   // heights above the receiver that float cannot tell from 0, relative to depth

uniform sampler2D surface_position;   // scene frame; the fourth number is 1 + the face's number as bits, 0: nothing seen
uniform sampler2D surface_normal;     // world, unit, towards the viewer
uniform usampler2DArray occluder_face;    // the first surface
uniform sampler2DArray occluder_depth;
uniform sampler2DArray last_depth;        // the last surface that faces the light's center
uniform usampler2DArray penumbra_entry;   // nearest penumbra entries in front of the first surface
uniform sampler2DArray penumbra_depth;
uniform usampler2DArray above_entry;      // nearest umbra entries in front of the last surface
uniform sampler2DArray above_depth;
uniform usampler2DArray below_entry;      // and behind it
uniform sampler2DArray below_depth;
uniform usampler2DArray penumbra_second;  // the second nearest, where two are kept
uniform sampler2DArray penumbra_second_depth;
uniform usampler2DArray above_second;
uniform sampler2DArray above_second_depth;
uniform usampler2DArray below_second;
uniform sampler2DArray below_second_depth;
uniform samplerBuffer records;            // four points a facet: previous, a, b, next; .w of the outer: 1 + facet, as bits

const int kDistances = 1;                 // contents: the 2004 paper's distances instead of edges
const int kSmoothstep = 1, kSquareRoot = 2;
uniform int contents;
uniform int curve;                        // visibility of the parameter t: 0 exact, kSmoothstep, kSquareRoot
uniform bool two_entries;

uniform mat3 light_axes;
uniform vec3 light_offset;
uniform float radius;
uniform float near_depth;
uniform int target_count;
uniform mat3 target_axes[kMaxTargets];
uniform vec4 target_window[kMaxTargets];

layout(location = 0) out float visibility;

const float kBias = 0.75;       // in texels

struct Receiver {
  vec3 x;        // point
  vec3 n;        // normal towards the viewer
  uint face;     // 1 + number
  float weight;  // 1/z
};

struct Texel {
  ivec3 at;         // column, row, target; target < 0: none
  vec3 direction;   // of its centre from the light's center
  float forward;    // of that direction, along the target's axis
  float size;       // of a texel, as a tangent
};

Texel texel_of(vec3 x) {
  for (int i = 0; i < target_count; ++i) {
    vec3 d = target_axes[i] * x;
    if (d.z <= 0.0) continue;
    vec4 w = target_window[i];
    vec2 size = vec2(w.y - w.x, w.w - w.z);
    vec2 at = (d.xy / d.z - w.xz) / size;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) continue;
    vec2 count = vec2(textureSize(occluder_depth, 0).xy);
    ivec2 texel = ivec2(at * count);
    vec3 centre = vec3(w.xz + (vec2(texel) + 0.5) / count * size, 1.0);
    vec3 direction = transpose(target_axes[i]) * centre;
    return Texel(ivec3(texel, i), direction, 1.0, max(size.x, size.y) / count.x);
  }
  return Texel(ivec3(0, 0, -1), vec3(0.0), 1.0, 0.0);
}

// 1/z of what a depth texture holds at the texel. Depth is near · weight / forward with z = 1 at (u, v, 1): a texel's
// direction has forward 1 and z = direction.z.
float weight_of(sampler2DArray depth, Texel t) {
  return texelFetch(depth, t.at, 0).r / (near_depth * t.direction.z);
}

// The corner's other edge, if the facet's chain goes on there.
struct Neighbour {
  bool there;
  Chord chord;
  bool convex;  // the caster's corner is convex: it hides what both edges hide; else what either does
};

vec2 on_disk(vec3 v, vec3 x) { return (v.xy * x.z - x.xy * v.z) / (x.z - v.z); }

Neighbour nearer_neighbour(uint facet, vec3 a, vec3 b, vec3 plane, vec3 x) {
  vec2 pa = on_disk(a, x), pb = on_disk(b, x);
  bool at_a = dot(pa, pa) < dot(pb, pb);
  vec4 far = texelFetch(records, int(4u * facet) + (at_a ? 0 : 3));
  Neighbour out_ = Neighbour(floatBitsToUint(far.w) != 0u, Chord(vec2(1.0, 0.0), 1.0), false);
  if (!out_.there) return out_;
  vec3 n = at_a ? edge_plane(x, far.xyz, a) : edge_plane(x, b, far.xyz);
  out_.chord = chord_of_plane(n, x, radius);
  out_.convex = dot(plane, far.xyz - x) < 0.0;
  return out_;
}

Chord opposite(Chord c) { return Chord(-c.normal, -c.delta); }

// Area fraction of a half-plane, or one of the paper's approximations of it; t = (1 + δ)/2.
float curve_of(float delta) {
  float t = clamp(0.5 + 0.5 * delta, 0.0, 1.0);
  return curve == kSmoothstep ? t * t * (3.0 - 2.0 * t) : curve == kSquareRoot ? sqrt(t) : half_plane_area(delta);
}

struct Share {
  float visibility;  // -1: the entry says nothing about this receiver
  Chord chord;
};

const Chord kWholeDisk = Chord(vec2(1.0, 0.0), 1.0);

// Visibility by one edge and its neighbour at the nearer corner.
Share share_of_facet(uint facet, Receiver r, Chord horizon) {
  Share none = Share(-1.0, kWholeDisk);
  int first = int(4u * facet);
  vec3 a = texelFetch(records, first + 1).xyz, b = texelFetch(records, first + 2).xyz;
  if (max(dot(r.n, a - r.x), dot(r.n, b - r.x)) <= kOnPlane * r.x.z) return none;  // below the horizon: it hides nothing
  if (max(a.z, b.z) >= r.x.z) return none;
  vec3 plane = edge_plane(r.x, a, b);
  Chord chord = chord_of_plane(plane, r.x, radius);
  if (!(abs(chord.delta) < 1.0)) return none;
  if (horizon.delta < 1.0) return Share(two_half_planes_area(horizon, chord), chord);
  if (curve != 0) return Share(curve_of(chord.delta), chord);
  Neighbour other = nearer_neighbour(facet, a, b, plane, r.x);
  if (!other.there) return Share(half_plane_area(chord.delta), chord);
  return Share(other.convex ? 1.0 - two_half_planes_area(opposite(chord), opposite(other.chord))
                            : two_half_planes_area(chord, other.chord), chord);
}

// The 2004 paper, eq. 3, corrected: t = |cxs|(|cx|-|cxuv|) / (2|cxuv|(|cx|-|cxs|)) in the umbra branch, one minus the same
// with |cxpv| in the other; with every distance along one line written as 1/weight it is (entry - x) / (2 (edge - x)).
Share share_of_distances(float entry, float edge, Receiver r, bool umbra) {
  if (edge <= r.weight) return Share(-1.0, kWholeDisk);
  float t = (entry - r.weight) / (2.0 * (edge - r.weight));
  return Share(curve_of(umbra ? 2.0 * t - 1.0 : 1.0 - 2.0 * t), kWholeDisk);
}

// Whether a surface that the light's center sees at the texel lies above the receiver's face, as far as texels can tell.
bool is_above(sampler2DArray depth, Receiver r, Texel t) {
  float weight = weight_of(depth, t);
  if (weight <= r.weight) return false;
  vec3 o = t.direction / (weight * t.direction.z);
  // Bias: within a texel a surface may rise by about a texel's width above the plane of the receiver's face.
  return dot(r.n, o - r.x) > kBias * t.size / weight;
}

bool occluded(Receiver r, Texel t) {
  if (dot(r.n, r.x) >= 0.0) return false;  // the light's center is below the horizon: its texel says nothing about the rest
  uint face = texelFetch(occluder_face, t.at, 0).r;
  return face != kEmpty && face != r.face && is_above(occluder_depth, r, t);
}

// What the layer's entry leaves of the light, where the receiver is behind it.
Share share_of(usampler2DArray entries, sampler2DArray depth, Receiver r, Texel t, Chord horizon, bool umbra) {
  uint entry = texelFetch(entries, t.at, 0).r;
  if (entry == kEmpty) return Share(-1.0, kWholeDisk);
  float weight = weight_of(depth, t);
  if (contents == kDistances)
    return r.weight < weight ? share_of_distances(weight, uintBitsToFloat(entry), r, umbra) : Share(-1.0, kWholeDisk);
  float slack = t.size / radius;  // what a texel's width is worth on a boundary's slope
  return r.weight < weight + slack ? share_of_facet(entry - 1u, r, horizon) : Share(-1.0, kWholeDisk);
}

// Two penumbra entries are two occluders: what is hidden is the union of what each hides.
float both_hide(Share one, Share two) {
  if (two.visibility < 0.0) return one.visibility;
  float hidden1 = 1.0 - one.visibility, hidden2 = 1.0 - two.visibility;
  float common_ = min(two_half_planes_area(opposite(one.chord), opposite(two.chord)), min(hidden1, hidden2));
  return clamp(1.0 - hidden1 - hidden2 + common_, 0.0, 1.0);
}

// Two umbra entries are two sides of one occluder: what is seen is the union of what is seen past each.
float both_show(Share one, Share two) {
  if (two.visibility < 0.0) return one.visibility;
  float common_ = min(two_half_planes_area(one.chord, two.chord), min(one.visibility, two.visibility));
  return clamp(one.visibility + two.visibility - common_, 0.0, 1.0);
}

float visibility_of(Receiver r) {
  Chord horizon = chord_of_plane(r.n, r.x, radius);
  float open = half_plane_area(horizon.delta);
  if (open == 0.0) return 0.0;
  Texel t = texel_of(r.x);
  if (t.at.z < 0) return open;
  // The light's center decides which boundaries matter: those of the penumbra where it is seen, else those of the umbra.
  bool hidden = occluded(r, t);
  bool two = two_entries && horizon.delta >= 1.0;
  if (!hidden) {
    Share one = share_of(penumbra_entry, penumbra_depth, r, t, horizon, false);
    if (one.visibility >= 0.0)
      return two ? both_hide(one, share_of(penumbra_second, penumbra_second_depth, r, t, horizon, false)) : one.visibility;
    if (horizon.delta > 0.0) return open;
  }
  bool behind_last = is_above(last_depth, r, t);
  Share one = behind_last ? share_of(below_entry, below_depth, r, t, horizon, true)
                          : share_of(above_entry, above_depth, r, t, horizon, true);
  if (one.visibility < 0.0) return hidden ? 0.0 : open;
  if (!two) return one.visibility;
  return both_show(one, behind_last ? share_of(below_second, below_second_depth, r, t, horizon, true)
                                    : share_of(above_second, above_second_depth, r, t, horizon, true));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 p = texelFetch(surface_position, pixel, 0);
  uint face = floatBitsToUint(p.w);
  if (face == 0u) {
    visibility = 1.0;
    return;
  }
  Receiver r;
  r.x = light_axes * p.xyz + light_offset;
  r.n = light_axes * texelFetch(surface_normal, pixel, 0).xyz;
  r.face = face;
  r.weight = 1.0 / r.x.z;
  visibility = r.x.z <= 0.0 ? 0.0 : visibility_of(r);
}

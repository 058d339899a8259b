#version 450 core
// Visibility of the disk from every visible surface point, by the D-buffer's entries. Everything is in the light's frame:
// the disk in z = 0 about the origin.
#include "disk_area.glsl"

const int kMaxTargets = 5;
const uint kEmpty = 0u;        // ids are stored plus one
const float kOnPlane = 1e-5;   // heights above the receiver that float cannot tell from 0, relative to depth

uniform sampler2D surface_position;   // scene frame; the fourth number is 1 + the face's number as bits, 0: nothing seen
uniform sampler2D surface_normal;     // world, unit, towards the viewer
uniform usampler2DArray occluder_face;
uniform sampler2DArray occluder_depth;
uniform usampler2DArray penumbra_facet;
uniform sampler2DArray penumbra_depth;
uniform sampler2DArray last_depth;
uniform usampler2DArray above_facet;  // umbra entries in front of the last surface
uniform sampler2DArray above_depth;
uniform usampler2DArray below_facet;  // and behind it
uniform sampler2DArray below_depth;
uniform samplerBuffer records;        // four points a facet: previous, a, b, next

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
  Neighbour out_ = Neighbour(far.w > 0.5, Chord(vec2(1.0, 0.0), 1.0), false);
  if (!out_.there) return out_;
  vec3 n = at_a ? edge_plane(x, far.xyz, a) : edge_plane(x, b, far.xyz);
  out_.chord = chord_of_plane(n, x, radius);
  out_.convex = dot(plane, far.xyz - x) < 0.0;
  return out_;
}

Chord opposite(Chord c) { return Chord(-c.normal, -c.delta); }

// Visibility by one entry; -1 where it says nothing about this receiver.
float entry_visibility(uint facet, Receiver r, Chord horizon) {
  int first = int(4u * facet);
  vec3 a = texelFetch(records, first + 1).xyz, b = texelFetch(records, first + 2).xyz;
  if (max(dot(r.n, a - r.x), dot(r.n, b - r.x)) <= kOnPlane * r.x.z) return -1.0;  // below the horizon: it hides nothing
  if (max(a.z, b.z) >= r.x.z) return -1.0;
  vec3 plane = edge_plane(r.x, a, b);
  Chord chord = chord_of_plane(plane, r.x, radius);
  if (!(abs(chord.delta) < 1.0)) return -1.0;
  if (horizon.delta < 1.0) return two_half_planes_area(horizon, chord);
  Neighbour other = nearer_neighbour(facet, a, b, plane, r.x);
  if (!other.there) return half_plane_area(chord.delta);
  return other.convex ? 1.0 - two_half_planes_area(opposite(chord), opposite(other.chord))
                      : two_half_planes_area(chord, other.chord);
}

bool occluded(Receiver r, Texel t) {
  float slope = dot(r.n, r.x);
  if (slope >= 0.0) return false;  // the light's center is below the horizon: its texel says nothing about the rest
  uint face = texelFetch(occluder_face, t.at, 0).r;
  if (face == kEmpty || face == r.face) return false;
  float weight = weight_of(occluder_depth, t);
  vec3 o = t.direction / (weight * t.direction.z);
  // Bias: within a texel a surface may rise by about a texel's width above the plane of the receiver's face.
  return weight > r.weight && dot(r.n, o - r.x) > kBias * t.size / weight;
}

float by_layer(usampler2DArray facets, sampler2DArray depth, Receiver r, Texel t, Chord horizon) {
  uint facet = texelFetch(facets, t.at, 0).r;
  float slack = t.size / radius;  // what a texel's width is worth on a boundary's slope
  if (facet == kEmpty || r.weight > weight_of(depth, t) + slack) return -1.0;
  return entry_visibility(facet - 1u, r, horizon);
}

float visibility_of(Receiver r) {
  Chord horizon = chord_of_plane(r.n, r.x, radius);
  float open = half_plane_area(horizon.delta);
  if (open == 0.0) return 0.0;
  Texel t = texel_of(r.x);
  if (t.at.z < 0) return open;
  // The light's center decides which boundaries matter: those of the penumbra where it is seen, else those of the umbra.
  bool hidden = occluded(r, t);
  if (!hidden) {
    float v = by_layer(penumbra_facet, penumbra_depth, r, t, horizon);
    if (v >= 0.0) return v;
    if (horizon.delta > 0.0) return open;
  }
  bool behind_last = r.weight < weight_of(last_depth, t) * (1.0 - 1e-3);
  float v = behind_last ? by_layer(below_facet, below_depth, r, t, horizon)
                        : by_layer(above_facet, above_depth, r, t, horizon);
  if (v >= 0.0) return v;
  return hidden ? 0.0 : open;
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

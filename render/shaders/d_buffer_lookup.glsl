// The D-buffer seen from a receiver: which texel, whether the light's center is hidden, which entries apply. Everything is
// in the light's frame: the disk in z = 0 about the origin.

const int kMaxTargets = 5;
const uint kEmpty = 0u;        // ids are stored plus one
const float kOnPlane = 1e-5;   // heights above the receiver that float cannot tell from 0, relative to depth

uniform sampler2D surface_position;   // scene frame; the fourth number is 1 + the face's number, 0: nothing seen
uniform sampler2D surface_normal;     // world, unit, towards the viewer
uniform sampler2D first_cut;          // which part of the way from the light's center to the receiver is free; 1: all
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
uniform samplerBuffer records;            // four points a facet: previous, a, b, next; .w of the outer: 1 + facet

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

const float kBias = 0.75;       // in texels

struct Receiver {
  vec3 x;        // point
  vec3 n;        // normal towards the viewer
  uint face;     // 1 + number
  float weight;  // 1/z
  float cut;     // which part of the way from the light's center is free; 1: the center is seen
};

struct Texel {
  ivec3 at;         // column, row, target; target < 0: none
  vec3 direction;   // of its centre from the light's center, of length 1 along the target's axis
  float size;       // of a texel, at that distance
};

// The target whose axis is nearest to the direction; receivers outside of its window have none.
Texel texel_of(vec3 x) {
  int best = 0;
  vec3 d = target_axes[0] * x;
  for (int i = 1; i < target_count; ++i) {
    vec3 other = target_axes[i] * x;
    if (other.z > d.z) {
      best = i;
      d = other;
    }
  }
  vec4 w = target_window[best];
  vec2 size = vec2(w.y - w.x, w.w - w.z);
  vec2 at = (d.xy / d.z - w.xz) / size;
  vec2 count = vec2(textureSize(occluder_depth, 0).xy);
  vec2 slack = target_count > 1 ? 0.5 / count : vec2(0.0);  // where two targets meet, rounding must not fall between
  bool outside = target_count == 0 || any(lessThan(at, -slack)) || any(greaterThanEqual(at, 1.0 + slack));
  ivec2 texel = ivec2(clamp(at * count, vec2(0.0), count - 1.0));
  vec3 centre = vec3(w.xz + (vec2(texel) + 0.5) / count * size, 1.0);
  return Texel(ivec3(texel, outside ? -1 : best), transpose(target_axes[best]) * centre, max(size.x, size.y) / count.x);
}

// 1/z of what a depth texture holds at the texel: depth is near · weight / forward, and a texel's direction has forward 1
// and z = direction.z.
float weight_of(float depth, Texel t) { return depth / (near_depth * t.direction.z); }

// Whether a surface of the given 1/z at the texel lies above the receiver's face, as far as texels can tell: within a
// texel a surface may rise by about a texel's width above the plane of the receiver's face.
bool is_above(float weight, Receiver r, Texel t) {
  float forward = 1.0 / (weight * t.direction.z);
  return weight > r.weight && dot(r.n, t.direction * forward - r.x) > kBias * t.size * forward;
}

struct Entry {
  uint content;  // 1 + facet, or the bits of the edge's 1/z; kEmpty: none
  float weight;  // 1/z of the boundary
  bool umbra;
};

Entry entry_of(usampler2DArray contents_, sampler2DArray depths, Texel t, bool umbra) {
  return Entry(texelFetch(contents_, t.at, 0).r, weight_of(texelFetch(depths, t.at, 0).r, t), umbra);
}

// The light's center decides which boundaries matter: those of the penumbra where it is seen, else those of the umbra,
// which begin anew behind every surface that faces it.
Entry entry_at(int k, bool hidden, Receiver r, Texel t) {
  if (!hidden) {
    Entry e = k == 0 ? entry_of(penumbra_entry, penumbra_depth, t, false) : entry_of(penumbra_second, penumbra_second_depth, t, false);
    if (e.content != kEmpty || dot(r.n, r.x) < 0.0) return e;
  }
  if (is_above(weight_of(texelFetch(last_depth, t.at, 0).r, t), r, t))
    return k == 0 ? entry_of(below_entry, below_depth, t, true) : entry_of(below_second, below_second_depth, t, true);
  return k == 0 ? entry_of(above_entry, above_depth, t, true) : entry_of(above_second, above_second_depth, t, true);
}

// The receiver of a pixel; face 0: nothing seen.
Receiver receiver_at(ivec2 pixel) {
  vec4 p = texelFetch(surface_position, pixel, 0);
  Receiver r;
  r.face = uint(p.w + 0.5);
  r.x = light_axes * p.xyz + light_offset;
  r.n = light_axes * texelFetch(surface_normal, pixel, 0).xyz;
  r.weight = 1.0 / r.x.z;
  r.cut = texelFetch(first_cut, pixel, 0).r;
  return r;
}

// The D-buffer seen from a receiver: which texel, whether the light's center is hidden, which entries apply. Everything
// is in the light's frame: the disk in z = 0 about the origin. Needs TARGETS, the number of targets.

const int kMaxTargets = 5;
const uint kEmpty = 0u;        // ids are stored plus one
// Accuracy: heights above the receiver's plane that float cannot tell from 0, relative to depth
// (DBuffer.CastersOwnSurfaceIsClean).
const float kOnPlane = 1e-5;

uniform sampler2D surface_position;   // caster frame; the fourth number is 1 + the face's number, 0: nothing seen
uniform sampler2D surface_normal;     // world, unit, towards the viewer
uniform sampler2D center_seen;        // 1 where the receiver sees the light's center, else 0
uniform usampler2DArray occluder_face;    // the first surface
uniform sampler2DArray occluder_depth;
uniform sampler2DArray last_depth;        // the last surface that faces the light's center
uniform usampler2DArray first_entry;      // nearest entries; target_count layers of each kind
uniform sampler2DArray first_depth;
uniform usampler2DArray second_entry;     // the second nearest, where two are kept
uniform sampler2DArray second_depth;
uniform samplerBuffer records;            // four points a facet: previous, a, b, next; .w of the outer: 1 + facet

// Kinds of entries: of the penumbra, in front of the first surface; of the umbra, in front of the last surface or
// behind it.
const int kPenumbra = 0, kAbove = 1, kBelow = 2;

uniform mat3 light_axes;     // caster frame → light's frame
uniform vec3 light_offset;
uniform float radius;        // of the disk
uniform float near_depth;    // forward distance below which nothing was drawn
const int target_count = TARGETS;
uniform mat3 target_axes[kMaxTargets];
uniform vec4 target_window[kMaxTargets];

// Accuracy: a surface has to be so many texels above the receiver's plane to count as before it
// (DBuffer.CastersOwnSurfaceIsClean).
const float kBias = 0.75;

struct Receiver {
  vec3 x;        // point
  vec3 n;        // normal towards the viewer
  uint face;     // 1 + number
  float weight;  // 1/z
  bool hidden;   // it does not see the light's center
};

struct Texel {
  ivec3 at;         // column, row, target; target < 0: none
  vec3 direction;   // of its center from the light's center, of length 1 along the target's axis
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
  vec3 center = vec3(w.xz + (vec2(texel) + 0.5) / count * size, 1.0);
  return Texel(ivec3(texel, outside ? -1 : best), transpose(target_axes[best]) * center, max(size.x, size.y) / count.x);
}

// 1/z of what a depth texture holds at the texel: depth is near · weight / forward, and a texel's direction has forward
// 1 and z = direction.z.
float weight_of(float depth, Texel t) { return depth / (near_depth * t.direction.z); }

// Whether a surface of the given 1/z at the texel lies above the receiver's face, as far as texels can tell: within a
// texel a surface may rise by about a texel's width above the plane of the receiver's face.
bool is_above(float weight, Receiver r, Texel t) {
  float forward = 1.0 / (weight * t.direction.z);
  return weight > r.weight && dot(r.n, t.direction * forward - r.x) > kBias * t.size * forward;
}

ivec3 layer_of(int kind, Texel t) { return t.at + ivec3(0, 0, kind * target_count); }

// The light's center decides which boundaries matter: those of the penumbra where it is seen, else those of the umbra,
// which begin anew behind every surface that faces it.
int kind_of_entries(Receiver r, Texel t) {
  bool any_penumbra = texelFetch(first_entry, layer_of(kPenumbra, t), 0).r != kEmpty;
  if (!r.hidden && (any_penumbra || dot(r.n, r.x) < 0.0)) return kPenumbra;
  return is_above(weight_of(texelFetch(last_depth, t.at, 0).r, t), r, t) ? kBelow : kAbove;
}

// The receiver of a pixel; face 0: nothing seen.
Receiver receiver_at(ivec2 pixel) {
  vec4 p = texelFetch(surface_position, pixel, 0);
  Receiver r;
  r.face = uint(p.w + 0.5);
  r.x = light_axes * p.xyz + light_offset;
  r.n = light_axes * texelFetch(surface_normal, pixel, 0).xyz;
  r.weight = 1.0 / r.x.z;
  r.hidden = texelFetch(center_seen, pixel, 0).r < 0.5;
  return r;
}

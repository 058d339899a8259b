// The D-buffer seen from a receiver: which texel, whether the light's center is hidden, which entries apply. Everything
// is in light space (render/d_buffer/view/light_space.h). Needs TARGETS, the number of targets.

const int kMaxTargets = 5;
const uint kEmpty = 0u;        // ids are stored plus one
// Accuracy: what rounding leaves of a point's height above a plane that it lies in, relative to what the height is the
// sum of (DBuffer.CastersOwnSurfaceIsClean).
const float kRounding = 5e-7;

uniform sampler2D surface_position;   // (u, v, h); then 1 + the face's number, 0: nothing seen, negative: behind the light
uniform sampler2D surface_plane;      // of the horizon: its height above x is this · the difference of (u, v, h)
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

uniform float depth_scale;   // what is stored as depth is depth_scale · h · weight / forward
const int target_count = TARGETS;
uniform mat3 target_axes[kMaxTargets];     // (u, v, 1) → right, up, forward
uniform vec4 target_window[kMaxTargets];   // left, right, bottom, top at forward distance 1

// Accuracy: a surface has to be so many texels above the receiver's plane to count as before it
// (DBuffer.CastersOwnSurfaceIsClean).
const float kBias = 0.75;

struct Receiver {
  vec3 x;
  vec3 n;        // plane of the horizon
  uint face;     // 1 + number
  bool behind;   // not in front of the light
  bool hidden;   // it does not see the light's center
};

struct Texel {
  ivec3 at;       // column, row, target; target < 0: none
  vec2 uv;        // of its center
  float forward;  // of (uv, 1)
  float width;    // of a texel, in (u, v)
};

// The target whose axis is nearest to the direction; receivers outside of its window have none.
Texel texel_of(vec3 x) {
  int best = 0;
  vec3 d = target_axes[0] * vec3(x.xy, 1.0);
  for (int i = 1; i < target_count; ++i) {
    vec3 other = target_axes[i] * vec3(x.xy, 1.0);
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
  // Of length 1 along the target's axis; (u, v) is where it has the weight 1.
  vec3 center = transpose(target_axes[best]) * vec3(w.xz + (vec2(texel) + 0.5) / count * size, 1.0);
  float forward = 1.0 / center.z;
  return Texel(ivec3(texel, outside ? -1 : best), center.xy * forward, forward, max(size.x, size.y) / count.x * forward);
}

// The height of what a depth texture holds at the texel.
float height_of(float depth, Texel t) { return depth * t.forward / depth_scale; }

// Whether a surface of the given height at the texel lies above the receiver's face, as far as texels can tell: within a
// texel a surface may rise by about a texel's width above the plane of the receiver's face.
bool is_above(float height, Receiver r, Texel t) {
  return height > r.x.z && dot(r.n, vec3(t.uv, height) - r.x) > kBias * t.width;
}

ivec3 layer_of(int kind, Texel t) { return t.at + ivec3(0, 0, kind * target_count); }

// The light's center decides which boundaries matter: those of the penumbra where it is seen, else those of the umbra,
// which begin anew behind every surface that faces it.
int kind_of_entries(Receiver r, Texel t) {
  bool any_penumbra = texelFetch(first_entry, layer_of(kPenumbra, t), 0).r != kEmpty;
  if (!r.hidden && (any_penumbra || r.n.z > 0.0)) return kPenumbra;
  return is_above(height_of(texelFetch(last_depth, t.at, 0).r, t), r, t) ? kBelow : kAbove;
}

// The receiver of a pixel; face 0: nothing seen.
Receiver receiver_at(ivec2 pixel) {
  vec4 p = texelFetch(surface_position, pixel, 0);
  Receiver r;
  r.x = p.xyz;
  r.n = texelFetch(surface_plane, pixel, 0).xyz;
  r.face = uint(abs(p.w) + 0.5);
  r.behind = p.w < 0.0;
  r.hidden = texelFetch(center_seen, pixel, 0).r < 0.5;
  return r;
}

// How much of the disk chords leave. The twin of render/light/disk_area.h: the same formulas in float and, where there are
// points, in light space. gl_test.cpp runs both on the same points.

const float kPi = 3.14159265358979;

struct Chord {
  vec2 normal;  // unit, into the half-plane
  float delta;  // signed distance of the disk's center, in radii; positive: the center is inside
};

// In light space (render/d_buffer/view/light_space.h) the way from a receiver to the point d of the unit disk runs along (d,
// 1). A plane through the receiver cuts the chord n · (d, 1) = 0 from the disk.
Chord chord_of_plane(vec3 n) {
  float size = length(n.xy);
  return Chord(size > 0.0 ? n.xy / size : vec2(1.0, 0.0), n.z / size);
}

// The plane through receiver x and the edge a → b. Light space is a mirror image of the world, so that this is the
// opposite of disk_area.h's. By the end that is nearer to x: the other one may be so far away that rounding it matters.
vec3 edge_plane(vec3 x, vec3 a, vec3 b) {
  vec3 from_a = a - x, from_b = b - x;
  return cross(b - a, dot(from_a, from_a) < dot(from_b, from_b) ? from_a : from_b);
}

// asin and acos by a series good to about 2e-7 (Abramowitz and Stegun 4.4.46): the built-in ones promise much less.
float accurate_acos(float x) {
  float s = abs(x);
  float p = ((((((-0.0012624911 * s + 0.0066700901) * s - 0.0170881256) * s + 0.0308918810) * s - 0.0501743046) * s +
              0.0889789874) * s - 0.2145988016) * s + 1.5707963050;
  float angle = sqrt(max(0.0, 1.0 - s)) * p;
  return x < 0.0 ? kPi - angle : angle;
}

float half_plane_area(float delta) {
  if (!(delta > -1.0)) return 0.0;
  if (delta >= 1.0) return 1.0;
  // acos(-δ) is π/2 + asin δ; near -1 it keeps the digits that asin would lose.
  return (accurate_acos(-delta) + delta * sqrt((1.0 - delta) * (1.0 + delta))) / kPi;
}

float half_plane_area_fast(float delta) {
  float s = min(abs(delta), 1.0);
  float tail = (1.0 - s) * sqrt(1.0 - s) * (0.5 + s * (0.11275 - 0.01345 * s));
  return delta > 0.0 ? 1.0 - tail : tail;
}

float kept_length(float d, float other, float cosine, float sine) {
  float reach = sqrt(max(0.0, (1.0 - d) * (1.0 + d)));
  // (d cos - other) / sin, arranged so that rounding drops out where the chords nearly coincide (see disk_area.cpp).
  float s = max(sine, 1e-30);
  float start = cosine > 0.0 ? (d - other) / s - d * sine / (1.0 + cosine) : d * sine / (1.0 - cosine) - (d + other) / s;
  return reach - clamp(start, -reach, reach);
}

float overlap(float p, float at, float q) { return max(0.0, min(p, at + q) - max(-p, at - q)); }

float two_half_planes_area(Chord one, Chord two) {
  if (one.delta >= 1.0) return half_plane_area(two.delta);
  if (two.delta >= 1.0) return half_plane_area(one.delta);
  if (!(one.delta > -1.0) || !(two.delta > -1.0)) return 0.0;
  float cosine = dot(one.normal, two.normal);
  float sine = abs(one.normal.x * two.normal.y - one.normal.y * two.normal.x);
  float angle = sine < 0.7 ? (cosine > 0.0 ? kPi / 2.0 - accurate_acos(sine) : kPi / 2.0 + accurate_acos(sine))
                           : accurate_acos(clamp(cosine, -1.0, 1.0));
  float reach1 = accurate_acos(-one.delta), reach2 = accurate_acos(-two.delta);
  float arc = overlap(reach1, angle, reach2) + overlap(reach1, angle - 2.0 * kPi, reach2);
  float twice = one.delta * kept_length(one.delta, two.delta, cosine, sine) +
                two.delta * kept_length(two.delta, one.delta, cosine, sine) + arc;
  return clamp(0.5 * twice / kPi, 0.0, 1.0);
}

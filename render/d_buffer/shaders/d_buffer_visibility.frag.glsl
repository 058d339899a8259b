#version 450 core
// D-buffer step 7, second pass: visibility of the disk by the D-buffer's entries, at the pixels that the first pass
// marked. "Umbra and penumbra volumes" (2004), section 4.
//
// Defined from outside (visibility_pass.cpp):
//   TARGETS   number of targets
//   CONTENTS  what a texel keeps: 0 edges, kDistances the paper's distances
//   CURVE     visibility of the parameter t: 0 exact, kSmoothstep, kSquareRoot
//   ENTRIES   1 or 2 are kept
#include "disk_area.glsl"
#include "d_buffer_lookup.glsl"
#include "d_buffer_boundary.glsl"

const int kDistances = 1;
const int kSmoothstep = 1, kSquareRoot = 2;

layout(early_fragment_tests) in;
layout(location = 0) out float visibility;
layout(location = 1) out uvec2 uses;  // the entries that it is from, see EntryUse (seen_boundary.h); 0: none

// Area fraction of a half-plane, or one of the paper's approximations of it; t = (1 + δ)/2.
float curve_of(float delta) {
  float t = clamp(0.5 + 0.5 * delta, 0.0, 1.0);
  return CURVE == kSmoothstep ? t * t * (3.0 - 2.0 * t) : CURVE == kSquareRoot ? sqrt(t) : half_plane_area(delta);
}

const Chord kWholeDisk = Chord(vec2(1.0, 0.0), 1.0);

Chord opposite(Chord c) { return Chord(-c.normal, -c.delta); }

// The side of a chord that the disk's center is known to be on: a chord that contradicts it is moved to the center.
float agreeing(float delta, bool hidden) { return hidden ? min(delta, 0.0) : max(delta, 0.0); }

struct Entry {
  uint content;  // 1 + facet, or the bits of the edge's height; kEmpty: none
  float height;  // of the boundary
  bool umbra;
};

Entry first_of(int kind, Texel t) {
  ivec3 at = layer_of(kind, t);
  return Entry(texelFetch(first_entry, at, 0).r, height_of(texelFetch(first_depth, at, 0).r, t), kind != kPenumbra);
}

Entry second_of(int kind, Texel t) {
  ivec3 at = layer_of(kind, t);
  return Entry(texelFetch(second_entry, at, 0).r, height_of(texelFetch(second_depth, at, 0).r, t), kind != kPenumbra);
}

struct Share {
  float visibility;  // -1: the entry says nothing about this receiver
  Chord chord;
  bool has_other;    // edge: it is part of the same boundary
  uint use;          // but for the bit of umbra
};
const Share kNoShare = Share(-1.0, kWholeDisk, false, 0u);
const uint kFollowed = 1u, kEdgeAlone = 2u, kUmbra = 4u, kUncertain = 8u;
const int kFacetShift = 4;

// Whether a point is above the receiver's horizon by more than rounding explains.
bool is_above_plane(vec3 p, Receiver r) {
  vec3 way = p - r.x;
  return dot(r.n, way) > kRounding * dot(abs(r.n), abs(way) + abs(r.x));
}

// Visibility by an edge and those that go on from it, or by the edge and the horizon. A boundary that contradicts what
// is known of the disk's center is not the only one there: its edge alone is taken, moved to the center.
Share share_of_facet(uint facet, uint other, Receiver r, Chord horizon) {
  int first = int(4u * facet);
  vec3 a = texelFetch(records, first + 1).xyz, b = texelFetch(records, first + 2).xyz;
  Chord chord = chord_of_plane(edge_plane(r.x, a, b));
  bool below = !is_above_plane(a, r) && !is_above_plane(b, r);  // the receiver's own plane hides it
  if (below || max(a.z, b.z) <= r.x.z || !(abs(chord.delta) < 1.0)) return kNoShare;
  if (CURVE != 0) return Share(min(curve_of(chord.delta), half_plane_area(horizon.delta)), chord, false, 0u);
  if (horizon.delta >= 1.0) {
    Past past = past_boundary(facet, other, a, b, chord, r.x);
    bool agrees = past.center != r.hidden && abs(past.area) < 2.0;  // and is a number
    if (agrees) return Share(clamp(past.area, 0.0, 1.0), chord, past.met, facet << kFacetShift | kFollowed);
  }
  float agreed = agreeing(chord.delta, r.hidden);
  uint use = facet << kFacetShift | kEdgeAlone | (agreed != chord.delta ? kUncertain : 0u);
  chord.delta = agreed;
  return Share(two_half_planes_area(chord, horizon), chord, false, use);
}

// The 2004 paper, eq. 3, corrected: t = |cxs|(|cx|-|cxuv|) / (2|cxuv|(|cx|-|cxs|)) in the umbra branch, one minus the
// same with |cxpv| in the other; with every distance along one line written as a height it is (entry - x) / (2 (edge -
// x)).
Share share_of_distances(Entry e, Receiver r, Chord horizon) {
  float edge = uintBitsToFloat(e.content);
  if (r.x.z >= e.height || edge <= r.x.z) return kNoShare;
  float t = (e.height - r.x.z) / (2.0 * (edge - r.x.z));
  return Share(min(curve_of(e.umbra ? 2.0 * t - 1.0 : 1.0 - 2.0 * t), half_plane_area(horizon.delta)), kWholeDisk, false, 0u);
}

Share share_of(Entry e, uint other, Receiver r, Texel t, Chord horizon) {
  if (CONTENTS == kDistances) return share_of_distances(e, r, horizon);
  // What a texel's width is worth on a boundary's slope of 1.
  float slack = t.width * (1.0 + dot(t.uv, t.uv));
  return r.x.z < e.height + slack ? share_of_facet(e.content - 1u, other, r, horizon) : kNoShare;
}

// Two penumbra entries are two occluders: hidden is what either hides. Two umbra entries are two sides of one occluder:
// seen is what is seen past either. Both are a union of two areas with a known common part.
float union_of(Share one, Share two, bool umbra) {
  float a = umbra ? one.visibility : 1.0 - one.visibility, b = umbra ? two.visibility : 1.0 - two.visibility;
  float common_ = two_half_planes_area(umbra ? one.chord : opposite(one.chord), umbra ? two.chord : opposite(two.chord));
  float both = clamp(a + b - min(common_, min(a, b)), 0.0, 1.0);
  return umbra ? both : 1.0 - both;
}

void main() {
  Receiver r = receiver_at(ivec2(gl_FragCoord.xy));
  Chord horizon = chord_of_plane(r.n);
  Texel t = texel_of(r.x);
  int kind = kind_of_entries(r, t);
  bool umbra = kind != kPenumbra;
  Entry one = first_of(kind, t);
  Share second = kNoShare;
#if ENTRIES > 1
  Entry two = second_of(kind, t);
  Share first = share_of(one, two.content - 1u, r, t, horizon);
  if (two.content != kEmpty && horizon.delta >= 1.0 && !first.has_other)
    second = share_of(two, kNoEdge, r, t, horizon);
  if (first.visibility < 0.0) {
    first = second;
    second = kNoShare;
  }
#else
  Share first = share_of(one, kNoEdge, r, t, horizon);
#endif
  if (first.visibility < 0.0)
    visibility = r.hidden ? 0.0 : half_plane_area(horizon.delta);
  else
    visibility = second.visibility < 0.0 ? first.visibility : union_of(first, second, umbra);
  uses = uvec2(first.use, second.use);
  if (umbra) uses |= mix(uvec2(0u), uvec2(kUmbra), notEqual(uses, uvec2(0u)));
}

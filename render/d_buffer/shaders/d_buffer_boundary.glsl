// D-buffer step 7: a boundary of the shadow as the receiver sees it on the disk.
//
// In: the facet of an entry and the receiver. Out: the area of the disk on the boundary's lit side. The boundary is
// followed from the entry's edge to its neighbors' edges, as far as they lie in the disk. Exact for one line of edges,
// convex or not, and for one that closes within the disk. Not in the 2004 paper, which takes the boundary for one
// straight line (section 2.3). Needs disk_area.glsl and d_buffer_lookup.glsl.

float cross2(vec2 p, vec2 q) { return p.x * q.y - p.y * q.x; }

// Where v is seen from x, on the disk. A v that is not clearly higher than x gives way to a point on the way from w to
// v which is: it is seen far outside of the disk, in the same direction.
vec2 on_disk(vec3 v, vec3 w, vec3 x) {
  v -= x;
  w -= x;
  float least = max(0.001 * (abs(v.x) + abs(v.y)), 1e-9 * w.z);
  if (v.z < least)
    v = w.z > least ? vec3(mix(w.xy, v.xy, (w.z - least) / (w.z - v.z)), least) : w.z > v.z ? w : v;
  return v.xy / v.z;
}

// From a point in the unit circle along d to the circle.
vec2 leave(vec2 p, vec2 d) {
  d = normalize(d);
  float along = dot(p, d);
  return p + d * (sqrt(max(0.0, along * along + 1.0 - dot(p, p))) - along);
}

// A boundary on the disk, followed from one of its edges to where it leaves.
struct Walk {
  vec2 at;
  float twice_area;  // between it and the center, on its left
  bool odd;          // it crosses the ray from the center along the first axis an odd number of times
  bool closed;       // it came back to where it began
  uint last;         // edge
  bool met;          // the other edge that was asked for
  // Past a corner outside of the disk the next edge may come back into it: a convex corner's adds to what is lit, the
  // caster hiding only what both edges hide; another's takes from it.
  uint next;  // edge, or kNoEdge
  float more;
  bool lights, hides;  // the center
};
const uint kNoEdge = ~0u;

void step_to(inout Walk w, vec2 q) {
  float area = cross2(w.at, q);
  w.twice_area += area;
  if ((w.at.y > 0.0) != (q.y > 0.0) && (area > 0.0) == (q.y > w.at.y)) w.odd = !w.odd;
  w.at = q;
}

// Whether the segment from p, outside of the unit circle, to q meets it.
bool meets_disk(vec2 p, vec2 q) {
  vec2 d = q - p;
  float along = -dot(p, d), area = cross2(p, d), length2 = dot(d, d);
  return along > 0.0 && area * area < length2 && (along < length2 || dot(q, q) < 1.0);
}

// Speed and accuracy: edges that are followed to either side; from there on the boundary is taken for a straight line
// (DBufferBoundary, DBufferScenes).
const int kMostSteps = 16;

// From p, in the disk and on the edge's line, past its end b, `pb` on the disk; `side` of its record is what comes
// then: 3, or 0 where b is the edge's begin.
Walk walk_past(uint facet, uint other, int side, vec2 p, vec2 way, vec3 a, vec3 b, vec2 pb, vec3 x) {
  Walk w = Walk(p, 0.0, false, false, facet, false, kNoEdge, 0.0, false, false);
  vec4 far = texelFetch(records, int(4u * facet) + side);
  for (int i = 0; i < kMostSteps && far.w > 0.5 && dot(pb, pb) < 1.0; ++i) {
    step_to(w, pb);
    w.last = uint(far.w - 0.5);
    w.met = w.met || w.last == other;
    w.closed = w.last == facet;
    if (w.closed) return w;
    a = b;
    b = far.xyz;
    pb = on_disk(b, a, x);
    way = pb - w.at;
    far = texelFetch(records, int(4u * w.last) + side);
  }
  if (far.w > 0.5 && dot(pb, pb) >= 1.0 && meets_disk(pb, on_disk(far.xyz, b, x))) {
    // The lines of both edges meet outside of the disk: it is cut into three.
    bool on = side == 3;
    Chord next = chord_of_plane(on ? edge_plane(x, b, far.xyz) : edge_plane(x, far.xyz, b));
    bool convex = dot(on ? edge_plane(x, a, b) : edge_plane(x, b, a), far.xyz - x) < 0.0;
    float cap = half_plane_area(convex ? next.delta : -next.delta);
    w.next = uint(far.w - 0.5);
    w.met = w.met || w.next == other;
    w.more = convex ? cap : -cap;
    w.lights = convex && next.delta >= 0.0;
    w.hides = !convex && next.delta < 0.0;
  }
  step_to(w, leave(w.at, way));
  return w;
}

// Whether p lies on the arc from one point of the circle counter-clockwise to the other.
bool on_arc(vec2 from, vec2 to, vec2 p) {
  return cross2(from, to) >= 0.0 ? cross2(from, p) >= 0.0 && cross2(p, to) >= 0.0
                                 : !(cross2(to, p) > 0.0 && cross2(p, from) > 0.0);
}

struct Past {
  float area;   // fraction of the disk on the lit side of a boundary
  bool center;  // the disk's center is on that side
  bool met;     // it has the other edge that was asked for
};

// By Green's theorem round what is lit: along the boundary, then along the circle back to where it came in.
Past past_boundary(uint facet, uint other, vec3 a, vec3 b, Chord chord, vec3 x) {
  vec2 pa = on_disk(a, b, x), pb = on_disk(b, a, x), way = pb - pa, foot = -chord.delta * chord.normal;
  bool left_is_lit = cross2(way, chord.normal) > 0.0;
  Walk on = walk_past(facet, other, 3, foot, way, a, b, pb, x);
  if (on.closed) {
    step_to(on, foot);
    float inside = on.twice_area / (2.0 * kPi);  // positive where it is on the left
    return (inside > 0.0) == left_is_lit ? Past(abs(inside), on.odd, on.met)
                                          : Past(1.0 - abs(inside), !on.odd, on.met);
  }
  Walk back = walk_past(facet, other, 0, foot, -way, b, a, pa, x);
  float angle = accurate_acos(clamp(dot(on.at, back.at), -1.0, 1.0));
  if (cross2(on.at, back.at) < 0.0) angle = 2.0 * kPi - angle;
  float left = (on.twice_area - back.twice_area + angle) / (2.0 * kPi);
  bool center = on_arc(on.at, back.at, vec2(1.0, 0.0)) != (on.odd != back.odd);
  if (!left_is_lit) {
    left = 1.0 - left;
    center = !center;
  }
  bool meet = on.next == back.last;  // round a corner outside of the disk
  bool twice = on.next == back.next;
  if (on.next != kNoEdge && !meet) {
    left += on.more;
    center = (center || on.lights) && !on.hides;
  }
  if (back.next != kNoEdge && !meet && !twice) {
    left += back.more;
    center = (center || back.lights) && !back.hides;
  }
  return Past(left, center, on.met || back.met);
}

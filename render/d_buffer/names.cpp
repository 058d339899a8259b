// The words for a D-buffer's options.
#include "render/d_buffer/d_buffer.h"

namespace penumbra {

std::span<const NamedValue<DBufferContents>> d_buffer_contents() {
  static constexpr NamedValue<DBufferContents> kNames[] = {{DBufferContents::kEdge, "edge"},
                                                           {DBufferContents::kDistances, "distances"}};
  return kNames;
}

std::span<const NamedValue<VisibilityCurve>> visibility_curves() {
  static constexpr NamedValue<VisibilityCurve> kNames[] = {{VisibilityCurve::kExact, "exact"},
                                                           {VisibilityCurve::kSmoothstep, "smoothstep"},
                                                           {VisibilityCurve::kSquareRoot, "sqrt"}};
  return kNames;
}

std::span<const NamedValue<CenterTest>> center_tests() {
  static constexpr NamedValue<CenterTest> kNames[] = {{CenterTest::kRay, "ray"},
                                                      {CenterTest::kDepth, "depth"}};
  return kNames;
}

std::span<const NamedValue<EntryCheck>> entry_checks() {
  static constexpr NamedValue<EntryCheck> kNames[] = {{EntryCheck::kRays, "rays"},
                                                      {EntryCheck::kNone, "none"}};
  return kNames;
}

std::span<const NamedValue<Conflict>> conflicts() {
  static constexpr NamedValue<Conflict> kNames[] = {{Conflict::kNearest, "nearest"},
                                                    {Conflict::kFurthest, "furthest"}};
  return kNames;
}

}  // namespace penumbra

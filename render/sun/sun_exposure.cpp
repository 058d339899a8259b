#include "penumbra/render/sun/sun_exposure.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

constexpr float kSome = 1e-5f, kAll = 1.0f - 1e-5f;

/// Some of the receivers, with arrays of their own.
class SomeReceivers {
 public:
  SomeReceivers(const Receivers& all, std::span<const std::uint32_t> which) {
    const auto gather = [&](const auto& from, auto& to) {
      if (from.empty()) return;
      for (const std::uint32_t i : which) to.push_back(from[i]);
    };
    gather(all.points, points_);
    gather(all.normals, normals_);
    gather(all.objects, objects_);
    gather(all.faces, faces_);
  }
  Receivers receivers() const {
    return {.points = points_, .normals = normals_, .objects = objects_, .faces = faces_};
  }

 private:
  std::vector<Vec3> points_, normals_;
  std::vector<std::int32_t> objects_;
  std::vector<std::uint32_t> faces_;
};

/// A change of one receiver between two times, and which side of it the earlier time is on.
struct Change {
  std::uint32_t receiver;
  bool full;    ///< of V = 1, else of V = 0
  bool rising;  ///< V grows
  double from, to;

  bool is_past(float seen) const { return (full ? seen >= kAll : seen > kSome) == rising; }
  SunContactKind kind() const {
    if (full) return rising ? SunContactKind::kFullLight : SunContactKind::kFirstShade;
    return rising ? SunContactKind::kFirstLight : SunContactKind::kLastLight;
  }
};

std::vector<Change> changes_between(double from, std::span<const float> before, double to,
                                    std::span<const float> after) {
  std::vector<Change> changes;
  for (std::uint32_t i = 0; i < before.size(); ++i) {
    if ((before[i] > kSome) != (after[i] > kSome)) changes.push_back({i, false, after[i] > kSome, from, to});
    if ((before[i] >= kAll) != (after[i] >= kAll)) changes.push_back({i, true, after[i] >= kAll, from, to});
  }
  return changes;
}

}  // namespace

const char* name_of(SunContactKind kind) {
  switch (kind) {
    case SunContactKind::kFirstLight:
      return "first light";
    case SunContactKind::kFullLight:
      return "full light";
    case SunContactKind::kFirstShade:
      return "first shade";
    case SunContactKind::kLastLight:
      return "last light";
  }
  return "";
}

SunExposure::SunExposure(const Casters& casters, const Receivers& receivers, const SunSky& sky,
                         VisibilityOptions options)
    : casters_(casters), receivers_(receivers), sky_(sky), options_(std::move(options)), exact_(options_) {
  sun_light({}, sky.axes);
  if (receivers_.revision == 0) receivers_.revision = new_revision();
  const auto& known = method_named(exact_.method).options;
  constexpr const char* kTolerance = "silhouette-tolerance";
  if (std::ranges::find(known, kTolerance, &OptionSchema::name) != known.end())
    exact_.options.try_emplace(kTolerance, 0.0);
}

std::vector<float> SunExposure::seen(double time) {
  return seen_by(receivers_, time, options_);
}

std::vector<float> SunExposure::seen_by(const Receivers& receivers, double time,
                                        const VisibilityOptions& options) {
  const SunPosition sun = sun_position(time, sky_.site);
  ++counts_.times;
  if (sun.elevation <= -sun.radius) {
    ++counts_.nights;
    return std::vector<float>(receivers.size(), 0.0f);
  }
  counts_.receivers += receivers.size();
  const DistantLight light = sun_light(sun, sky_.axes);
  std::vector<float> seen = visibility(casters_, light, receivers, options).visibility;
  if (sun.elevation >= sun.radius) return seen;
  // Some may be asked twice: there can be more than receivers.
  const std::vector<Vec3> ups(receivers.size(), glm::normalize(sky_.axes.up));
  Receivers level = receivers;
  level.normals = ups;
  level.revision = 0;
  const std::vector<float> above = visibility(casters_, light, level, options).visibility;
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = std::min(seen[i], above[i]);
  return seen;
}

std::vector<SunContact> SunExposure::contacts(double from, std::span<const float> before, double to,
                                              std::span<const float> after, double precision) {
  if (before.size() != receivers_.size() || after.size() != receivers_.size())
    throw UsageError("contacts: give what each receiver sees at both times");
  if (!(to > from && precision > 0.0))
    throw UsageError("contacts: give times in order and a precision above 0");
  std::vector<Change> changes = changes_between(from, before, to, after);
  // All that wait for the same time are asked at once: at first all are.
  for (double span = to - from; span > 2.0 * precision; span *= 0.5) {
    std::map<double, std::vector<std::uint32_t>> waiting;
    for (std::uint32_t k = 0; k < changes.size(); ++k)
      waiting[0.5 * (changes[k].from + changes[k].to)].push_back(k);
    for (const auto& [time, which] : waiting) {
      std::vector<std::uint32_t> receivers;
      for (const std::uint32_t k : which) receivers.push_back(changes[k].receiver);
      const std::vector<float> seen = seen_by(SomeReceivers(receivers_, receivers).receivers(), time, exact_);
      for (std::size_t i = 0; i < which.size(); ++i) {
        Change& change = changes[which[i]];
        (change.is_past(seen[i]) ? change.to : change.from) = time;
      }
    }
  }
  std::vector<SunContact> out;
  for (const Change& change : changes)
    out.push_back({change.receiver, 0.5 * (change.from + change.to), change.kind()});
  std::ranges::sort(out, {}, [](const SunContact& c) { return std::tuple(c.receiver, c.time, c.kind); });
  return out;
}

}  // namespace penumbra

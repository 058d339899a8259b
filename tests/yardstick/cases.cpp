#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>

#include "tests/yardstick/judging.h"
#include "tests/yardstick/parts.h"

namespace penumbra::yardstick {
namespace {

/// The scene of the same family at unit scale. `comparable`: the object of which it shows the same.
/// `is_pattern`: rows measure it, and areas are as good as those of patterns.cpp.
struct Family {
  std::string prefix, base;
  std::optional<int> comparable{};
  bool is_pattern = false;
};
const std::array<Family, 6> kFamilies{{{"blinds", "blinds", {}, true},
                                       {"ground_", "ground_2e1"},
                                       {"stray", "ground_2e1"},
                                       {"sheet_", "sheet_1e-1"},
                                       // From afar the light grazes two sides of the box.
                                       {"sun_", "sun_1e1", 0},
                                       {"lamp_in_wall_plane_", "lamp_in_wall_plane_1e-1"}}};

std::vector<std::string> names_of_cases() {
  std::vector<std::string> names;
  const auto folder = std::filesystem::path(PENUMBRA_DATA) / "regressions" / "scenes";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

const Family& family_of(const std::string& name) {
  const auto family =
      std::ranges::find_if(kFamilies, [&](const Family& f) { return name.starts_with(f.prefix); });
  if (family == kFamilies.end()) throw std::runtime_error("the case " + name + " has no family");
  return *family;
}

std::vector<Contender> contenders_for(const Family& family) {
  std::vector<Contender> all = contenders();
  if (family.is_pattern) std::ranges::find(all, "silhouette", &Contender::method)->limits = kPatternLimits;
  return all;
}

}  // namespace

void judge_cases(Report& report) {
  std::map<std::string, JudgedScene> bases;
  for (const std::string& name : names_of_cases()) {
    if (!report.wants("cases/" + name)) continue;
    const Family& family = family_of(name);
    JudgedScene& base =
        bases.try_emplace(family.base, scene_named(family.base), family.comparable).first->second;
    if (name == family.base) {
      judge_all(report, "cases/" + name, base, &base, contenders_for(family));
    } else {
      JudgedScene scene(scene_named(name), family.comparable);
      judge_all(report, "cases/" + name, scene, &base, contenders_for(family));
    }
  }
}

}  // namespace penumbra::yardstick

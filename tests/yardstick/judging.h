// Methods, each with what it is held to, and their pictures of one scene judged by the oracle.
#pragma once

#include <compare>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/compare/comparison.h"
#include "penumbra/render/renderer.h"
#include "tests/yardstick/report.h"

namespace penumbra::yardstick {

struct PictureSize {
  int width = 640, height = 480;

  auto operator<=>(const PictureSize&) const = default;
};

/// The largest errors of V that count as right. Its own noise is taken out of the oracle's figures, not that
/// of the method.
struct Limits {
  /// Over true penumbra, and over all pixels.
  double rmse = 0.0;
  /// Of any pixel.
  double most = 1.0;
};
/// Of `silhouette` where regular patterns are measured by rows.
inline constexpr Limits kPatternLimits{0.003, 0.03};

struct Contender {
  std::string method;
  OptionValues options{};
  Limits limits{};
  /// It keeps its own error: at most 1.5 times that of a base scene, and .001. `limits` say nothing then.
  bool is_relative = false;
  /// It is judged as if the light were its center.
  bool is_hard = false;
  PictureSize size{};
};

/// Every method but `none`, and `auto`, which is one of the others.
std::vector<Contender> contenders();
/// One of them.
Contender contender(const std::string& method);

/// What was found of one picture.
struct Verdict {
  std::size_t penumbra = 0;  ///< pixels
  double rmse = 0.0, rmse_of_all = 0.0, most = 0.0;
  std::size_t certified = 0, contradicted = 0;
  /// Why there are no figures: what is seen is not the scene.
  std::string trouble{};
};
std::string text_of(const Verdict& verdict);

/// One scene's pictures. Judged with twice 1,024 rays at up to 8,000 pixels where sixteen rays find a change,
/// or beside, and at 2,000 others.
class JudgedScene {
 public:
  /// `relative_on`: relative contenders are judged by pixels of this object alone, where the others of the
  /// base scene are not to be compared.
  explicit JudgedScene(Scene scene, std::optional<int> relative_on = {});

  const Scene& scene() const { return renderer_.scene(); }
  bool takes(const Contender& contender) const;
  RenderResult draw(const Contender& contender);
  /// Of each method once.
  const Verdict& verdict(const Contender& contender);

 private:
  struct Kind {
    PictureSize size;
    bool is_hard;
    std::optional<int> object;

    auto operator<=>(const Kind&) const = default;
  };
  apps::SceneComparison& judge_for(const Contender& contender);

  Renderer renderer_;
  std::optional<int> relative_on_;
  Scene with_point_light_;
  std::map<Kind, std::unique_ptr<apps::SceneComparison>> judges_;
  std::map<std::string, Verdict> verdicts_;
};

/// `base` is asked where the contender is relative. No certificate may be wrong, and no object missing.
bool is_right(const Contender& contender, const Verdict& verdict, JudgedScene* base);

/// Adds a finding NAME/METHOD for each contender that takes the scene's light and is wanted.
void judge_all(Report& report, const std::string& name, JudgedScene& scene, JudgedScene* base,
               const std::vector<Contender>& methods);

/// Of data/regressions/scenes or data/scenes.
Scene scene_named(const std::string& name);

}  // namespace penumbra::yardstick

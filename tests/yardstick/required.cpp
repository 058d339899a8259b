#include "tests/yardstick/report.h"

namespace penumbra::yardstick {

const std::vector<std::string>& required() {
  static const std::vector<std::string> kRequired = {
      "cases/sun_1e1/silhouette",
      "cases/sun_1e1/reference",
  };
  return kRequired;
}

}  // namespace penumbra::yardstick

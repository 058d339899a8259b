#include "apps/cli/study/peers/temporary_folder.h"

#include <stdlib.h>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {

TemporaryFolder::TemporaryFolder(const std::string& name) {
  std::string pattern = (std::filesystem::temp_directory_path() / ("penumbra-" + name + "-XXXXXX")).string();
  if (!mkdtemp(pattern.data())) throw SystemError(pattern + ": cannot be made");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace penumbra::apps

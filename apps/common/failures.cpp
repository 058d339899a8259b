#include "apps/common/failures.h"

#include <new>
#include <string_view>

#include "apps/common/messages.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr const char* kNoMemory = "not enough memory; try a smaller --size or mesh";

}  // namespace

int fail(ExitCode code, const std::string& message) {
  complain(message);
  return code;
}

int run_guarded(const std::function<int()>& work) {
  try {
    return work();
  } catch (const UsageError& e) {
    return fail(kBadUsage, e.what());
  } catch (const MeshError& e) {
    return fail(kBadInput, e.what());
  } catch (const SceneError& e) {
    return fail(kBadInput, e.what());
  } catch (const Error& e) {
    return fail(kFailed, e.what());
  } catch (const std::bad_alloc&) {
    return fail(kFailed, kNoMemory);
  } catch (const std::exception& e) {
    // So oneTBB says that there is no memory for the stack of a thread.
    if (std::string_view(e.what()).find("pthread_create") != std::string_view::npos)
      return fail(kFailed, kNoMemory);
    return fail(kFailed,
                std::string("unexpected: ") + e.what() + "; please report this with the command line");
  }
}

}  // namespace penumbra::apps

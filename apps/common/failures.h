// What becomes of errors, in every program: one line on standard error and an exit code.
#pragma once

#include <functional>
#include <string>

namespace penumbra::apps {

/// Exit codes. Scripts rely on them.
enum ExitCode : int {
  kFine = 0,
  kFailed = 1,    ///< something outside: an output cannot be written, no OpenGL context, no memory
  kBadUsage = 2,  ///< unknown option or method, size 0x0
  kBadInput = 3,  ///< a mesh or scene that cannot be used
};

/// Says `message` and returns `code`.
int fail(ExitCode code, const std::string& message);

/// Runs `work` and returns what it returns, or the exit code of what it throws.
int run_guarded(const std::function<int()>& work);

}  // namespace penumbra::apps

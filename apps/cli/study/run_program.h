// study: other programs, run to their end.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace penumbra::apps {

enum class Stream { kOutput = 1, kError = 2 };

/// What the program writes to that stream; to the other one it writes nothing that is seen. `words` begin
/// with the program's name; `program` is a path, or a name that is looked for as a shell does. Nothing where
/// it cannot be started, fails, or takes more than so many seconds: it is then killed. It is killed as well
/// where this program is interrupted (apps/common/interrupts.h). One at a time.
std::optional<std::string> run_program(const std::string& program, std::vector<std::string> words,
                                       Stream stream, double most_seconds = 600.0);

}  // namespace penumbra::apps

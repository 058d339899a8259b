// The program `penumbra`: subcommands, and what becomes of errors.
#pragma once

namespace penumbra::apps {

/// Exit codes. Scripts rely on them.
enum ExitCode : int {
  kFine = 0,
  kFailed = 1,    ///< something outside: an output cannot be written, no OpenGL context, no memory
  kBadUsage = 2,  ///< unknown option or method, size 0x0
  kBadInput = 3,  ///< a mesh or scene that cannot be used
};

/// Parses the command line and runs the subcommand. Every failure ends in one line on standard error.
int run_command_line(int argc, char** argv);

}  // namespace penumbra::apps

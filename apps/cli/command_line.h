// The program `penumbra`: subcommands, and what becomes of errors.
#pragma once

namespace penumbra::apps {

/// Parses the command line and runs the subcommand. Every failure ends in one line on standard error.
int run_command_line(int argc, char** argv);

}  // namespace penumbra::apps

#include "apps/common/interrupts.h"

#include <signal.h>

#include "mesh/io/write_file.h"

namespace penumbra::apps {
namespace {

/// Its own disposition is the default again (SA_RESETHAND) when it is raised a second time.
void clean_up(int signal) {
  remove_unfinished_files();
  raise(signal);
}

}  // namespace

void clean_up_when_interrupted() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = clean_up;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
  signal(SIGXFSZ, SIG_IGN);
}

}  // namespace penumbra::apps

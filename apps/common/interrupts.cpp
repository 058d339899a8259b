#include "apps/common/interrupts.h"

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "apps/common/failures.h"
#include "mesh/io/write_file.h"

namespace penumbra::apps {
namespace {

std::atomic<void (*)()> also{nullptr};

/// Its own disposition is the default again (SA_RESETHAND) when it is raised a second time.
void clean_up(int signal) {
  if (void (*const first)() = also) first();
  remove_unfinished_files();
  raise(signal);
}

/// Crashes count as for want of memory where not even this much of it can be reserved.
constexpr std::size_t kLittle = std::size_t{256} << 20;

bool is_memory_used_up() {
  void* place = mmap(nullptr, kLittle, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) return true;
  munmap(place, kLittle);
  return false;
}

/// Nothing in it asks for memory.
[[noreturn]] void end_without_memory() {
  constexpr std::string_view kLine = "penumbra: not enough memory; try a smaller --size or mesh\n";
  remove_unfinished_files();
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kLine.data(), kLine.size());
  _exit(kFailed);
}

void end_crashed(int signal) {
  if (is_memory_used_up()) end_without_memory();
  raise(signal);
}

void end_uncaught() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (...) {
  }
  std::abort();
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

void do_when_interrupted(void (*also_do)()) {
  also = also_do;
}

void say_where_memory_is_used_up() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT}) {
    struct sigaction action = {};
    action.sa_handler = end_crashed;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
  std::set_terminate(end_uncaught);
}

}  // namespace penumbra::apps

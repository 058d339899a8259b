// The processes of `mpirun -n K penumbra study` or `bake`. MPI is optional when Penumbra is built, and its
// libraries are opened where mpirun has started the program, nowhere else.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace penumbra::apps {

struct MpiLibrary;

struct RankMessage {
  int from = 0, tag = 0;
  std::string bytes;
};

/// Any thread may call its functions.
class Ranks {
 public:
  /// Null where the program was not started by mpirun, or alone. Throws UsageError where it was, and cannot
  /// do it: built without MPI.
  static std::unique_ptr<Ranks> of_this_run();
  /// Ends MPI; where `abandon` was called it ends the process instead, with exit code 1 if an exception is on
  /// its way.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  void send(int to, int tag, const std::string& bytes = {});
  /// A message that has come, whole; nothing where none has. It never waits for a rank, which may be killed
  /// while it sends.
  std::optional<RankMessage> poll();
  /// Ends all processes, with exit code 1.
  [[noreturn]] void abort();
  /// Others are gone: MPI cannot be ended with them.
  void abandon() { abandoned_ = true; }
  bool is_abandoned() const { return abandoned_; }

 private:
  struct Receiving {
    RankMessage message;
    void* receipt = nullptr;  // MPI's, while bytes are on their way into the message
  };

  Ranks(const MpiLibrary& library, int rank, int size)
      : library_(library), rank_(rank), size_(size), receiving_(static_cast<std::size_t>(size)) {}

  /// Whether the next message of this rank is there, whole.
  bool receive(Receiving& next, int from);

  const MpiLibrary& library_;
  const int rank_, size_;
  std::vector<Receiving> receiving_;  // by rank
  bool abandoned_ = false;
  std::mutex mutex_;
};

}  // namespace penumbra::apps

// Units of work shared by the ranks of an MPI run. Rank 0 is the only one that has the plan and writes; it
// also works. The others ask for a unit, do it, send the result, and say every second that they live. One
// that has said nothing for some time is taken for gone, and its unit is done again.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "apps/cli/ranks/ranks.h"
#include "penumbra/mesh/progress.h"

namespace penumbra::apps {

/// What is left to do, and what comes of it. Units and results are bytes; a worker is a rank. Called by one
/// thread at a time.
class WorkPlan {
 public:
  virtual ~WorkPlan() = default;
  /// The next unit for a worker. Nothing where no unit is left; others may still be at work.
  virtual std::optional<std::string> next(int worker) = 0;
  /// The result of the unit that the worker got last.
  virtual void finish(int worker, const std::string& result) = 0;
  /// The worker is gone: its unit is done again.
  virtual void lose(int worker) = 0;
  /// Whether all is done.
  virtual bool done() const = 0;
  virtual double fraction() const = 0;
};

/// From a unit to its result.
using DoUnit = std::function<std::string(const std::string& unit)>;

/// Rank 0, until all is done and the others have been sent home.
void lead(Ranks& ranks, WorkPlan& plan, const DoUnit& work, const Progress& progress);

/// Any other rank, until rank 0 has no more to do.
void follow(Ranks& ranks, const DoUnit& work);

/// What `work` throws is said and ends all ranks: the others would wait for this one.
void or_abort(Ranks& ranks, const std::function<void()>& work);

/// What `work` throws is said and ends the process where a rank is gone, since `ranks` ends it before the
/// caller could say it. Else it is thrown on. `ranks` may be null.
void or_abort_where_lost(Ranks* ranks, const std::function<void()>& work);

/// One process alone.
void work_alone(WorkPlan& plan, const DoUnit& work, const Progress& progress);

}  // namespace penumbra::apps

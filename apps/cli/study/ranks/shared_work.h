// study: units shared by the ranks of an MPI run. Rank 0 is the only one that has the plan and writes; it also measures. The others
// ask for a unit, measure it, send the result, and say every second that they live. One that has said nothing for some time is taken
// for gone, and its unit is done again.
#pragma once

#include <functional>

#include "apps/cli/study/ranks/ranks.h"
#include "apps/cli/study/study_plan.h"

namespace penumbra::apps {

using MeasureUnit = std::function<UnitResult(const StudyUnit&)>;
/// Called by one thread at a time. The number is the unit's case.
using TakeResult = std::function<void(std::size_t case_number, const UnitResult&)>;

/// Rank 0, until all is done and the others have been sent home.
void lead(Ranks& ranks, StudyPlan& plan, const MeasureUnit& measure, const TakeResult& take,
          const Progress& progress);

/// Any other rank, until rank 0 has no more to do.
void follow(Ranks& ranks, const MeasureUnit& measure);

}  // namespace penumbra::apps

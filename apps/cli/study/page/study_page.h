// study, step 5: DIR/index.html, one page that needs nothing else: numbers, pictures, styles, scripts and the
// plotting library (uPlot, MIT license) are in it.
#pragma once

#include <string>
#include <string_view>

#include "apps/cli/study/study_record.h"

namespace penumbra::apps {

/// A file of apps/cli/study/page by its name.
std::string_view page_text(std::string_view name);

/// Pictures are those that rows and cases name, from DIR/pictures; what is missing is left out.
std::string make_page(const StudyRecord& record);

void write_page(const StudyRecord& record);

}  // namespace penumbra::apps

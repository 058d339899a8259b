// What an interrupt leaves: no temporary file.
#pragma once

namespace penumbra::apps {

/// From here on an interrupt, a hang-up or a request to end removes the temporary files of outputs under way before it
/// ends the program as it would have. Signals that are ignored stay so. A file that grows beyond the limit of its size is
/// an error of writing.
void clean_up_when_interrupted();

}  // namespace penumbra::apps

// The mouse and all keys, from the table of commands.
#pragma once

namespace penumbra::viewer {

/// `shown` becomes false where it is closed.
void draw_help(bool& shown);

}  // namespace penumbra::viewer

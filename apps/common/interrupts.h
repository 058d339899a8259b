// How a program ends early: without temporary files, and with a line where there is no memory.
#pragma once

namespace penumbra::apps {

/// From here on an interrupt, a hang-up or a request to end removes the temporary files of outputs under way
/// before it ends the program as it would have. Signals that are ignored stay so. A file that grows beyond
/// the limit of its size is an error of writing.
void clean_up_when_interrupted();

/// Calls this first when that happens: what a signal handler may do. One at a time; null: nothing.
void do_when_interrupted(void (*also_do)());

/// From here on a crash where memory is used up (drivers of OpenGL do not ask whether they got it), and an
/// exception for want of memory that nothing catches, end the program with one line and the exit code of a
/// failure. Other crashes stay as they are.
void say_where_memory_is_used_up();

}  // namespace penumbra::apps

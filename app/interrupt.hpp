/// Ctrl-C.
#pragma once

namespace vicus::app {

/// From now on the first Ctrl-C (or a polite request to end) only sets the mark that `interrupted` reads, so that what
/// is running can end cleanly; a second one ends the program at once.
void catchInterrupts();
bool interrupted();

}  // namespace vicus::app

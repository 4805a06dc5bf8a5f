#pragma once

namespace couloir {

// From now on Ctrl-C, SIGTERM, SIGHUP and SIGUSR1 (which mpirun hands on to its ranks) are noted here; a second one ends the program at
// once.
void note_stop_signals();
bool told_to_stop();

}  // namespace couloir

#pragma once
// How HDF5 reaches the disk: as its own driver does, but what is written over goes through a journal first.

#include <hdf5.h>

#include "coupling/records/undo_journal.hpp"

namespace couloir::h5 {

// Has files that are opened with this access list use the driver. The journal must outlive them.
herr_t use_journal(hid_t access, UndoJournal&);

}  // namespace couloir::h5

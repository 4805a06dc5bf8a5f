// Compiled once for each instruction set, with that set's name of the table.

#include "continuum/scheme/kernels.hpp"

namespace couloir {

extern "C" {
extern const Kernels COULOIR_TABLE;
const Kernels COULOIR_TABLE{begin_step,  run_stage,   find_velocity,   mobilise,    find_earth_pressure,
                            find_locked, find_shocks, reconstruct_all, face_fluxes, update};
}

}  // namespace couloir

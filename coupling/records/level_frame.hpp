#pragma once
// Points and velocities as ParaView shall see them: the level frame, X horizontal and Z up.
#include <vector>

#include "continuum/solver.hpp"
#include "coupling/engine/grain_engine.hpp"

namespace couloir {

// Cell corners on the reference surface, [ny + 1][nx + 1][3] in m.
std::vector<float> level_nodes(const Grid&, const ReferenceSurface&);
// Points above the cell centres at the height bed + h along the normal, [ny][nx][3] in m.
std::vector<float> level_free_surface(const Grid&, const ReferenceSurface&, const std::vector<double>& bed,
                                      const std::vector<double>& h);
// Depth-averaged velocity, tangential to the reference surface, [ny][nx][3] in m/s; 0 up to the depth `thin`.
std::vector<float> level_velocity(const Grid&, const ReferenceSurface&, const std::vector<double>& h,
                                  const std::vector<double>& hu, const std::vector<double>& hv, double thin);
// Grain centres [N][3] in m and velocities [N][3] in m/s.
std::vector<float> level_positions(const ReferenceSurface&, const Grains&);
std::vector<float> level_velocities(const ReferenceSurface&, const Grains&);

}  // namespace couloir

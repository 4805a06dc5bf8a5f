#pragma once
// Makes a Fix of ours known to an engine instance at run time, and finds it again.

#include "coupling/workers/engine_headers.hpp"

namespace couloir {

// Modify::fix_map is private, but an explicit template instantiation may name any member.
using FixMap = std::map<std::string, LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS*, int, char**)>;
template <FixMap* LAMMPS_NS::Modify::*member>
struct FixMapAccess {
  friend FixMap& fix_map(LAMMPS_NS::Modify& modify) { return *(modify.*member); }
};
FixMap& fix_map(LAMMPS_NS::Modify&);
template struct FixMapAccess<&LAMMPS_NS::Modify::fix_map>;

// After this, "fix ID all STYLE ..." makes an F.
template <class F>
void register_fix(LAMMPS_NS::LAMMPS* engine, const std::string& style) {
  fix_map(*engine->modify)[style] = [](LAMMPS_NS::LAMMPS* lmp, int n, char** words) -> LAMMPS_NS::Fix* {
    return new F(lmp, n, words);
  };
}

template <class F>
F* find_fix(LAMMPS_NS::LAMMPS* engine, const std::string& id) {
  const int index = engine->modify->find_fix(id.c_str());
  F* fix = index < 0 ? nullptr : dynamic_cast<F*>(engine->modify->fix[index]);
  if (!fix) throw std::logic_error("the engine has no fix " + id);
  return fix;
}

}  // namespace couloir

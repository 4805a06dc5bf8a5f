#include "continuum/scheme/level_faces.hpp"

#include "continuum/flow/flux.hpp"

namespace couloir {

void give_to_coarser(const std::vector<GivenFace>& faces, const Block& b, const Axis& axis, const FaceValues& v,
                     std::vector<LevelFluxes>& to) {
  constexpr double share = 0.125;  // two stages, two steps, two faces
  const FaceFluxes& f = *axis.fluxes;
  for (const GivenFace& g : faces) {
    if (g.along_x != axis.along_x) continue;
    LevelFlux& sum = to[g.block][g.slot];
    sum.mass += share * f.mass[g.face];
    sum.tangent += share * f.tangent[g.face];
    sum.normal += share * f.normal[g.face];
    const int below = g.face - axis.step;
    const bool same_top = b.top[below] == b.top[g.face];
    if (!b.relief && same_top) continue;
    const double seen = g.coarser_below ? f.normal_below[g.face] : f.normal_above[g.face];
    const bool level = same_top && b.bed[below] == b.bed[g.face] && seen == f.normal[g.face];
    if (level) continue;  // no push: what passes is all
    const double weight = axis.weight[g.face % b.row()];
    const double own =
        g.coarser_below ? pressure(v.h_hi[below], axis.k[below] * weight) : pressure(v.h_lo[g.face], axis.k[g.face] * weight);
    sum.push += share * (seen - f.normal[g.face] - own);
    sum.bed += share;
  }
}

void take_from_finer(const std::vector<TakenFace>& faces, const Block& b, const Axis& axis, const FaceValues& v,
                     const LevelFluxes& from) {
  FaceFluxes& f = *axis.fluxes;
  for (const TakenFace& t : faces) {
    if (t.along_x != axis.along_x) continue;
    const LevelFlux& sum = from[t.slot];
    const int below = t.face - axis.step;
    const double weight = axis.weight[t.face % b.row()];
    const double own =
        t.finer_above ? pressure(v.h_hi[below], axis.k[below] * weight) : pressure(v.h_lo[t.face], axis.k[t.face] * weight);
    f.mass[t.face] = sum.mass;
    f.tangent[t.face] = sum.tangent;
    f.normal[t.face] = f.normal_below[t.face] = f.normal_above[t.face] = sum.normal;
    (t.finer_above ? f.normal_below : f.normal_above)[t.face] = sum.normal + sum.push + sum.bed * own;
  }
}

}  // namespace couloir

#pragma once
// Models and settings of one scene, from a mass point to the finest grains: what each is off by, and what it costs.
//
// A rung's run is off by its bias and by the scatter of its packings:
//
//   bias = (mean - reference) / |reference|,   scatter = standard deviation of a sample / |reference|,
//   error = sqrt(bias^2 + scatter^2): root mean square over the runs that this rung would give
//
// The reference is a rung, whose own scatter is the floor below which one run tells nothing, or a value known otherwise (exact,
// measured), whose floor is 0. The mean of n packings is off by sqrt(bias^2 + scatter^2 / n). Bias is known to
// `doubt` = sqrt(scatter^2 / n + floor^2 / n_reference) only, n the packings that were run.
//
// Coarse cells may hit the reference by chance, a mass point too, or a short zone. `step` is how far any rung of the same mode
// with smaller cells or grains, that sets nothing else that this one does not, is away at most (from a mass point: any cells);
// choices take the larger of bias and step for the bias.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "coupling/study/study_run.hpp"

namespace couloir {

struct RungFigures {  // of one quantity; NaN: the rung has none
  double value = 0;   // in the quantity's unit, mean over packings
  double bias = 0, scatter = 0, error = 0, doubt = 0;
  double step = 0;     // over the reference; 0: there are no finer ones
  bool front = false;  // no other rung is both cheaper and better
};

struct RungCost {
  int packings = 0;  // done
  double cpu = 0;    // [s] of one run
};

// What to take where this error is wanted.
struct LadderChoice {
  double wanted = 0;
  int rung = -1;     // -1: none
  int packings = 1;  // whose mean
  double error = 0, cpu = 0;
};

struct LadderFigures {
  double reference = 0, floor = 0;    // in the unit; share of it
  std::vector<RungFigures> rungs;     // as Ladder::rungs
  std::vector<LadderChoice> choices;  // as Ladder::errors
};

// Of each rung, over its rows that are done.
std::vector<RungCost> rung_costs(const Study&, const std::vector<StudyResult>&);
// As Ladder::quantities. The study must have a ladder.
std::vector<LadderFigures> ladder_figures(const Study&, const std::vector<StudyResult>&);

// Whether a rung's key is the size of cells or of grains, which goes by its number in the depth.
bool is_size(const std::string& key);

// What its bias may be, as far as finer rungs tell; NaN: it has none.
double trusted_bias(const RungFigures&);

// The cheapest way to an error: a rung, and the mean of how many of its packings (at most `most_packings`).
inline constexpr int most_packings = 30;
LadderChoice choose(double wanted, const std::vector<RungFigures>&, const std::vector<RungCost>&);

// For each quantity the rungs with value, error and cost, and the choices.
std::string ladder_text(const Study&, const std::vector<StudyResult>&);
// ladder.json, which `couloir advise` reads: the same with what the scene is like (likeness.hpp).
nlohmann::ordered_json ladder_json(const Study&, const std::vector<StudyResult>&);

}  // namespace couloir

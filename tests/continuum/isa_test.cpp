#include "continuum/isa/isa.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "scenes.hpp"

namespace couloir::test {
namespace {

// COULOIR_ISA as given while it lives.
struct Asked {
  explicit Asked(const std::string& word) { setenv("COULOIR_ISA", word.c_str(), 1); }
  ~Asked() {
    if (before.empty()) {
      unsetenv("COULOIR_ISA");
    } else {
      setenv("COULOIR_ISA", before.c_str(), 1);
    }
  }
  std::string before = std::getenv("COULOIR_ISA") ? std::getenv("COULOIR_ISA") : "";
};

// Friction, active and passive earth pressure, curvature, hills, a step, dry bed; odd block edges, so that rows end anywhere.
Solver everything(Limiter limiter) {
  SolverSettings s;
  s.grid = {61, 43, 0.02, 0.02, 0, -0.43};
  s.closure = quartz();
  s.limiter = limiter;
  s.sides = sides(Side::Kind::outflow, Side::Kind::wall);
  s.block = 21;
  StepBed bed;
  bed.obstacles.push_back({"block", 0.7, 0.8, -0.12, 0.2, 0.06});
  for (int j = 0; j < s.grid.ny; ++j) {
    for (int i = 0; i < s.grid.nx; ++i) bed.elevation.push_back(0.004 * std::sin(20 * s.grid.x(i)) * std::cos(15 * s.grid.y(j)));
  }
  Solver solver(s, ReferenceSurface::chute(degrees(35), 0.6, 0.3, 0.3), bed);
  solver.set([](double x, double y) {
    const double r2 = ((x - 0.3) * (x - 0.3) + y * y) / 0.04, h = r2 < 1 ? 0.12 * (1 - r2) : 0.0;
    return FlowState{h, 1.5 * h, 0.1 * h};
  });
  return solver;
}

TEST(InstructionSets, AllGiveTheSameBits) {
  for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee}) {
    const auto run = [&](Isa isa) {
      const Asked asked(to_string(isa));
      Solver s = everything(limiter);
      s.advance_to(0.4);
      return s.checkpoint();  // the state and all sums
    };
    const auto baseline = run(Isa::baseline);
    for (Isa isa : usable_isas()) EXPECT_EQ(run(isa), baseline) << to_string(isa);
  }
}

TEST(InstructionSets, TheWidestUsableIsChosenUnlessAnotherIsAskedFor) {
  for (Isa isa : usable_isas()) {
    const Asked asked(to_string(isa));
    EXPECT_EQ(chosen_isa(), isa);
  }
  const Asked nothing("");
  EXPECT_EQ(chosen_isa(), usable_isas().back());
}

TEST(InstructionSets, AWrongWordIsRefusedBySentence) {
  const Asked wrong("sse9");
  try {
    everything(Limiter::minmod);
    FAIL() << "a solver was made";
  } catch (const IsaError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("COULOIR_ISA is 'sse9', which is no instruction set; use baseline, avx2 or avx512"));
  }
}

}  // namespace
}  // namespace couloir::test

#include "continuum/errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "scenes.hpp"

namespace couloir::test {
namespace {

TEST(Errors, NotANumberIsReportedWithItsCell) {
  Solver solver(basin(20, 10, 0.1), ReferenceSurface::flat(2), {});
  solver.set([](double, double) { return FlowState{0.1, 0, 0}; });
  solver.set(12, 5, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  try {
    solver.step(0.01);
    FAIL() << "no error";
  } catch (const NumericsError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("cell (12, 5) at x = 1.25 m, y = 0.05 m"));
    EXPECT_THAT(e.what(), testing::HasSubstr("h = nan"));
  }
}

TEST(Errors, InfiniteFluxThroughTheRimIsReported) {
  Solver solver(basin(20, 10, 0.1), ReferenceSurface::flat(2), {});
  solver.set([](double, double) { return FlowState{0.1, 0, 0}; });
  solver.cover({10, 20, 0, 10});
  solver.impose(0, SideName::upstream, 4, {0, std::numeric_limits<double>::infinity(), 0});
  EXPECT_THROW(solver.step(0.01), NumericsError);
}

TEST(Errors, WrongSettingsAreRefused) {
  const auto build = [](auto change) {
    SolverSettings s = basin(8, 8, 0.1);
    change(s);
    Solver(s, ReferenceSurface::flat(1), {});
  };
  EXPECT_THROW(build([](auto& s) { s.cfl = 0.6; }), std::invalid_argument);
  EXPECT_THROW(build([](auto& s) { s.grid.nx = 0; }), std::invalid_argument);
  EXPECT_THROW(build([](auto& s) { s.threads = 0; }), std::invalid_argument);
  EXPECT_THROW(build([](auto& s) { s.dry_depth = 0; }), std::invalid_argument);
  Solver solver(basin(8, 8, 0.1), ReferenceSurface::flat(1), {});
  EXPECT_THROW(solver.at(8, 0), std::out_of_range);
  EXPECT_THROW(solver.step(-1), std::invalid_argument);
  EXPECT_THROW(solver.add_gauge(9, 0, 8), std::out_of_range);
}

}  // namespace
}  // namespace couloir::test
